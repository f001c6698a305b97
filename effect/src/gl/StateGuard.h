// What becomes of the engine's GL state (StateMode). Construction sets what a full-screen pass expects; before that it
// saves what it and the passes change, and destruction gives that back, or it saves nothing and destruction leaves GL
// as the comment of tyndall::Effect says. The rows are the names in the last column of gl/Functions.h.
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"
#include "gl/LegacyState.h"

#include <array>
#include <optional>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall::gl {

inline constexpr int kUniformBindings = 3; ///< uniform buffer bindings 0..2 likewise
inline constexpr Uint kDrawBuffers = 3;    ///< draw buffers 0..2 are those that passes draw into

/// Kinds of textures that units may hold, beside GL_TEXTURE_2D.
struct TextureKinds {
  bool arrays = false, multisampled = false, cubes = false, cubeArrays = false;
};

/// Saved are texture unit 0, where textures are checked and made, and all rows but those that have a function of their
/// own, which is to be called before they change.
class StateGuard {
public:
  StateGuard(const Functions& gl, StateMode mode);
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

  /// Units 1 to count - 1: GL_TEXTURE_2D and the kinds that will be bound there.
  void saveUnits(int count, const TextureKinds& kinds);
  /// Function, operation and mask of the stencil; its test is off in any case.
  void saveStencil();
  /// The read framebuffer.
  void saveReadFramebuffer();
  /// Of viewport 0; its test is off in any case.
  void saveScissorBox();

private:
  static constexpr std::size_t kTargetCount = 6;
  struct Unit {
    std::array<Int, kTargetCount> textures{}; // one per target of kTargets
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
  struct StencilFace {
    Int function = 0, reference = 0, valueMask = 0, writeMask = 0, fail = 0, depthFail = 0, pass = 0;
  };

  bool restores() const { return mode_ == StateMode::Restore; }
  void save();
  void saveUnit(int index, const std::array<bool, kTargetCount>& targets);
  void saveUniformBindings();
  void saveDrawBuffers();
  void saveViewport();
  void clearSaved() const;
  void restore() const;
  void restoreUnits() const;
  void restoreUniformBindings() const;
  void restoreDrawBuffers() const;
  void restoreStencil() const;
  void setDefaults() const;
  void leave() const;
  void emptyUnits() const;
  bool isBoundIn(int unit, std::size_t target) const;

  const Functions& gl_;
  StateMode mode_;
  Int program_ = 0;
  Int vertexArray_ = 0;
  Int framebuffer_ = 0;
  Int renderbuffer_ = 0;
  Int unpackBuffer_ = 0;
  Int uniformBuffer_ = 0;
  Int activeUnit_ = 0;
  std::array<Int, 2> polygonMode_{FILL, FILL}; // where the context has it
  std::array<Int, 2> clipControl_{};           // origin, depth mode; where the context has them
  std::array<Int, 5> unpacking_{};
  std::array<Float, 4> viewport_{};
  Boolean scissor_ = 0;
  std::optional<std::array<Int, 4>> scissorBox_;
  std::vector<Enum> capabilities_; // that are on
  std::array<UniformBinding, kUniformBindings> uniformBindings_;
  std::array<DrawBuffer, kDrawBuffers> drawBuffers_;
  int unitCount_ = 1;                                // units 0 to unitCount_ - 1
  std::array<bool, kTargetCount> unitTargets_{true}; // of units from 1 on
  std::vector<Unit> units_;
  bool savesStencil_ = false, savesReadFramebuffer_ = false;
  Int readFramebuffer_ = 0;
  std::array<StencilFace, 2> stencil_;
  LegacyState legacy_;
};

/// How pixels are packed, and where to: around a read-back of pixels.
class PackGuard {
public:
  PackGuard(const Functions& gl, StateMode mode);
  ~PackGuard();
  PackGuard(const PackGuard&) = delete;
  PackGuard& operator=(const PackGuard&) = delete;

private:
  const Functions& gl_;
  StateMode mode_;
  Int buffer_ = 0;
  std::array<Int, 5> packing_{};
};

/// Sets the viewport of index 0 alone, where the context has several.
void setViewport(const Functions& gl, Int x, Int y, Sizei width, Sizei height);

/// Draws into viewport 0 only where the box is: x, y, width, height; while the test is on.
void setScissor(const Functions& gl, const std::array<Int, 4>& box);
void setScissorTest(const Functions& gl, bool on);

struct BlendFactors {
  Enum source = ONE, destination = ZERO, sourceAlpha = ONE, destinationAlpha = ZERO;
};

/// Blending of draw buffers 0 to count - 1, by GL_FUNC_ADD. Where the context has no functions for one buffer (OpenGL
/// 3.3), the factors are those of all.
void setBlending(const Functions& gl, Uint count, bool on, const BlendFactors& factors = {});

} // namespace tyndall::gl
