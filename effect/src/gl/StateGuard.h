// Gives the engine's GL state back. Construction saves every row that a function of gl/Functions.h can change and sets
// what a full-screen pass expects; destruction restores. The rows are the names in the table's last column.
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"

#include <array>
#include <vector>

namespace tyndall::gl {

inline constexpr int kTextureUnits = 23;   ///< units 0..22 (gl::Unit) are ours during a render
inline constexpr int kUniformBindings = 3; ///< uniform buffer bindings 0..2 likewise

class StateGuard {
public:
  explicit StateGuard(const Functions& gl);
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

private:
  struct Unit {
    std::array<Int, 3> textures{}; // one per target of kTargets
    Int sampler = 0;
  };
  struct UniformBinding {
    Int buffer = 0;
    Int64 start = 0;
    Int64 size = 0;
  };
  struct DrawBuffer {
    Boolean blend = 0;
    std::array<Boolean, 4> mask{};
    std::array<Int, 4> factors{};   // source rgb, destination rgb, source alpha, destination alpha
    std::array<Int, 2> equations{}; // rgb, alpha
  };
  struct View {
    std::array<Float, 4> rectangle{};
    Boolean scissor = 0;
  };

  struct StencilFace {
    Int function = 0, reference = 0, valueMask = 0, writeMask = 0, fail = 0, depthFail = 0, pass = 0;
  };

  void saveTextures();
  void saveDrawBuffers();
  void saveViewports();
  void saveStencil();
  void setDefaults() const;
  void restoreTextures() const;
  void restoreDrawBuffers() const;
  void restoreViewports() const;
  void restoreStencil() const;

  const Functions& gl_;
  Int program_ = 0;
  Int vertexArray_ = 0;
  Int framebuffer_ = 0;
  Int renderbuffer_ = 0;
  Int packBuffer_ = 0;
  Int unpackBuffer_ = 0;
  std::array<Int, 16> pixelStorage_{};
  std::array<StencilFace, 2> stencil_;
  Int uniformBuffer_ = 0;
  Int activeUnit_ = 0;
  std::array<Int, 2> polygonMode_{};
  std::array<Int, 2> clipControl_{}; // origin, depth mode; where the context has them
  std::array<Unit, kTextureUnits> units_;
  std::array<UniformBinding, kUniformBindings> uniformBindings_;
  std::vector<DrawBuffer> drawBuffers_;
  std::vector<View> views_;
  std::vector<Boolean> capabilities_;
};

} // namespace tyndall::gl
