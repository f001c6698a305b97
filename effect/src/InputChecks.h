// Config::checkInputs: what the GPU found where scene depth and shadow maps are compared (glsl/lib/inputs.glsl), known
// some frames later, and what it says of the inputs. Nothing waits.
#pragma once

#include "gl/Objects.h"

#include <array>
#include <cstdint>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

/// Points of a grid, by what they found.
struct InputCounts {
  int nothing = 0, agree = 0, hidden = 0, missing = 0, empty = 0, outside = 0;
  int special = 0, atNear = 0; ///< of these (lib/inputs.glsl)

  int compared() const { return agree + hidden + missing + empty; }
  int impossible() const { return missing + empty; }
};

/// Of a light and its map.
struct LightChecks {
  std::size_t light = 0;
  bool isSun = false;   ///< whose light is everywhere
  bool isHazy = false;  ///< with Light::curves: what the camera shows may be in them, not in the map
  InputCounts surfaces; ///< of the camera's picture, looked up in the map
  InputCounts casters;  ///< of the map, looked up in the camera's picture
};

/// Which lights have a map to be compared, and which of them are suns or have curves: a bit each.
struct CheckedLights {
  std::uint32_t all = 0, suns = 0, hazy = 0;
};

/// Lines as Statistics::warnings has them; none for inputs that can show one scene.
std::vector<std::string> judge(const std::vector<LightChecks>& lights);

class InputChecks {
public:
  explicit InputChecks(const gl::Functions& gl) : gl_(gl) {}
  ~InputChecks();
  InputChecks(const InputChecks&) = delete;
  InputChecks& operator=(const InputChecks&) = delete;

  /// Has room for what a frame asks for.
  Status reserve(StateMode state);

  /// Has the texture (Resource::InputChecks) copied, of these lights, unless the GPU is behind. Binds a
  /// framebuffer to be read.
  void ask(gl::Uint texture, CheckedLights lights, StateMode state);

  /// A frame has nothing to be checked: what is under way is of others.
  void forget();

  /// Looks at what has come. Binds to the uniform target.
  void receive();

  /// Of the last frame that is known.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// GL memory held.
  std::uint64_t bytes() const;

private:
  struct Batch {
    gl::Buffer buffer; // null until it is first needed
    gl::Sync sync = nullptr;
    CheckedLights lights;
    std::uint64_t number = 0;
  };
  Batch* freeBatch();
  void take(const Batch& batch);

  const gl::Functions& gl_;
  gl::Framebuffer reader_;       // null likewise
  std::array<Batch, 3> batches_; // as many frames as an engine has under way
  std::uint64_t asked_ = 0, known_ = 0;
  std::vector<std::string> warnings_;
};

} // namespace tyndall
