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

/// Which mistakes would bring a map to agree with surfaces that it does not have where its matrices say
/// (lib/inputs.glsl).
enum class Hint { Biased, WholeLayer, FromTop, OtherView, Turned };
inline constexpr std::size_t kHints = 5;

/// Points of a grid, by what they found.
struct InputCounts {
  int nothing = 0, agree = 0, hidden = 0, missing = 0, empty = 0, outside = 0;
  int quarter = 0, atNear = 0; ///< of these (lib/inputs.glsl)
  std::array<int, kHints> hints = {};

  int compared() const { return agree + hidden + missing + empty; }
  int impossible() const { return missing + empty; }
};

/// A light whose map is compared, and what its mistakes are called by.
struct CheckedLight {
  std::size_t index = 0;
  bool isSun = false;  ///< whose light is everywhere
  bool isHazy = false; ///< with Light::curves: what the camera shows may be in them, not in the map
  bool isCube = false;
  bool hasRectangles = false;
  bool hasDistances = false; ///< in place of window depths
  std::size_t views = 1;
};

/// What was found of it.
struct LightChecks {
  CheckedLight light;
  InputCounts surfaces;                 ///< of the camera's picture, looked up in the map
  InputCounts casters;                  ///< of the map, looked up in the camera's picture
  std::vector<InputCounts> byView = {}; ///< of the surfaces, those that a view should have
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

  /// Has the texture (Resource::InputChecks) copied, of some of the frame's lights, unless the GPU is behind. Binds a
  /// framebuffer to be read.
  void ask(gl::Uint texture, const Frame& frame, const std::vector<std::size_t>& lights, StateMode state);

  /// The frame has nothing to be checked: what is under way is of others.
  void forget(const Frame& frame);

  /// Looks at what has come. Binds to the uniform target.
  void receive();

  /// Of the last frame of that camera which is known.
  const std::vector<std::string>& warnings(const Frame& frame) const;

  /// GL memory held.
  std::uint64_t bytes() const;

private:
  // Frames of which results belong together: those of one camera of the engine's.
  struct Key {
    explicit Key(const Frame& frame);
    bool operator==(const Key& other) const;
    std::uint64_t eye;
    Rectangle viewport;
    std::array<std::uint32_t, 3> targets; // colour and outputs
    std::array<int, 2> layers;
  };
  struct Batch {
    gl::Buffer buffer; // null until it is first needed
    gl::Sync sync = nullptr;
    Key frame{{}};
    std::vector<CheckedLight> lights;
    std::uint64_t number = 0;
  };
  struct Camera {
    Key frame;
    std::uint64_t known = 0; // the last batch whose results it has
    std::vector<std::string> warnings = {};
  };
  Batch* freeBatch();
  void take(const Batch& batch);
  Camera& cameraOf(const Key& frame);

  const gl::Functions& gl_;
  gl::Framebuffer reader_;       // null likewise
  std::array<Batch, 4> batches_; // as many frames as an engine has under way
  std::uint64_t asked_ = 0;
  std::vector<Camera> cameras_; // the last one used at the end
};

} // namespace tyndall
