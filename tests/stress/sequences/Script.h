// What an engine shows in each frame of a sequence: numbers alone, decided by the recipe.
#pragma once

#include "Recipe.h"

#include <array>
#include <glm/glm.hpp>
#include <tyndall/tyndall.h>

namespace stress {

/// GL's names of formats, as numbers: a script knows no GL.
using Format = unsigned;

constexpr int kEyes = 6; ///< more than the effect keeps

struct CameraState {
  glm::dvec3 place = {0, 2, 0};
  double turn = 0, tilt = 0; ///< radians
  double size = 0.5;         ///< tangent of half the field of view, or half the height over 6
  bool orthographic = false, reversed = false, infinite = false, zeroToOne = false;
};

/// A box of half extents `size`; as a mesh, the cube of half extent `shape` in its own coordinates.
struct MoverState {
  bool present = false, mesh = false, versioned = true;
  glm::dvec3 place = {0, 2, -4}, size = {0.4, 0.3, 0.3};
  double angle = 0, shape = 1;
};

/// How a light's views lie in its texture.
enum class MapLayout { Plain, Layers, Atlas };

struct LightState {
  int id = 0; ///< of the engine's light, whatever its index in a frame
  tyndall::LightKind kind = tyndall::LightKind::Directional;
  int cascades = 1;
  double turn = 0;
  tyndall::Rgb colour = {1, 1, 1};
  bool hasMap = true, glass = false, litOutside = true;
  int mapSize = 12;
  MapLayout layout = MapLayout::Plain;
  Format format = 0; ///< 0: a float depth format
};

enum class DepthLayout { Plain, Rectangle, Layer, Double };

/// How a frame fails, if it does.
enum class Failure { None, Invalid, Memory, Framebuffer, Shader, Abandoned };
constexpr int kFailures = 6;

struct FailureState {
  Failure kind = Failure::None;
  int at = 1;           ///< the call that fails
  bool again = true;    ///< the frame is drawn once more
  bool counted = false; ///< as a frame that the eye has shown
};

struct ScriptState {
  int width = 22, height = 15;
  int left = 0, bottom = 0, right = 0, top = 0; ///< pixels around the viewport
  int eye = 0;
  std::array<CameraState, kEyes> cameras;
  std::array<double, 2> jitter = {0, 0};
  std::array<MoverState, 3> movers;
  std::vector<LightState> lights = {LightState()};
  int nextLight = 1;
  tyndall::Medium medium;
  tyndall::Settings settings;
  tyndall::Changes changes = tyndall::Changes::Detect;
  int versions = 0; ///< 0: none; 1: of the content; 2: another in each frame
  int refreshFrames = 0;
  float fullShare = 0.35F;
  bool colour = true, inscatter = true, transmittance = true;
  Format colourFormat = 0, outputFormat = 0; ///< 0: RGBA32F
  DepthLayout depthLayout = DepthLayout::Plain;
  Format depthFormat = 0; ///< 0: R32F
  bool renew = false;     ///< all textures are made anew before this frame
  bool jumps = false;     ///< Reuse::frame leaves one out
  bool prepares = false;
  bool namesResting = false; ///< also objects that rest are named
  double margin = 1;         ///< of an object's box around it, a factor
  FailureState failure;
};

/// Goes through a sequence frame by frame.
class Script {
public:
  explicit Script(const Recipe& recipe);
  const ScriptState& advance(); ///< the next frame, first the one of index 0
  int frame() const { return frame_; }

private:
  using Change = void (*)(ScriptState&, Random&);
  void vary(Ingredient ingredient, Change change);
  void varyAll();

  Recipe recipe_;
  ScriptState state_;
  std::array<double, static_cast<std::size_t>(Ingredient::Count)> rates_{}; ///< of changes a frame
  int frame_ = -1;
};

} // namespace stress
