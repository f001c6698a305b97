// What a random frame is made of: axes that vary by themselves, each with a simplest value.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>
#include <string>
#include <vector>

namespace stress {

enum class Axis {
  Size,        ///< of the picture
  Viewport,    ///< whole textures, or rectangles of larger ones
  Lens,        ///< projection, depth convention
  Pose,        ///< eye and orientation
  World,       ///< scale and offset of everything
  Surface,     ///< what the scene depth holds
  DepthForm,   ///< format of the scene depth
  Lights,      ///< how many of which kind
  Places,      ///< where they are, seen from the camera
  Cones,       ///< angles of spots, ranges of lamps
  Views,       ///< projections of the shadow maps
  MapSize,     ///< their texels
  Texels,      ///< what the shadow maps hold
  OddTexels,   ///< not numbers, infinite or outside [0, 1]
  Layout,      ///< arrays, atlases, cubes; formats
  Filter,      ///< of shadows
  Medium,      ///< coefficients, phases
  FarDistance, ///< where rays to the sky end
  Radiance,    ///< of the lights
  Glass,
  Settings,  ///< of the frame that is drawn by any settings
  Relation,  ///< by which change the picture must stay
  Layers,    ///< of the medium, that thin out with height
  Ambient,   ///< light of the surroundings
  Lookup,    ///< Frame::lookup
  EyeCurves, ///< Frame::eyeCurves
};
inline constexpr int kAxes = static_cast<int>(Axis::EyeCurves) + 1;

const char* nameOf(Axis axis);

/// A set of axes; written as names between commas.
class AxisSet {
public:
  AxisSet() = default;
  AxisSet(std::initializer_list<Axis> axes) {
    for (const Axis axis : axes)
      add(axis);
  }
  bool has(Axis axis) const { return (bits_ >> static_cast<int>(axis) & 1U) != 0; }
  void add(Axis axis) { bits_ |= std::uint32_t{1} << static_cast<int>(axis); }
  AxisSet with(Axis axis) const {
    AxisSet more = *this;
    more.add(axis);
    return more;
  }
  bool isEmpty() const { return bits_ == 0; }
  std::string text() const;
  /// Throws std::invalid_argument that names what is no axis.
  static AxisSet parse(const std::string& text);

private:
  std::uint32_t bits_ = 0;
};

/// What decides on shaders, which take a driver longer to compile than many frames take, is the same for so many seeds
/// in a row, and comes again after so many such families.
inline constexpr std::uint64_t kFamilySize = 1024, kFamilies = 128;

/// Numbers that depend on a seed and an axis alone: whatever the other axes do, the same ones.
class Random {
public:
  Random(std::uint64_t seed, Axis axis);
  /// The same for all seeds of a family.
  static Random ofFamily(std::uint64_t seed, Axis axis) { return {~(seed / kFamilySize % kFamilies), axis}; }

  std::uint64_t bits();
  double uniform(double low = 0, double high = 1);
  double logUniform(double low, double high); ///< both > 0
  int integer(int low, int high);             ///< both included
  bool chance(double probability) { return uniform() < probability; }
  glm::dvec3 direction(); ///< unit length, any
  template <typename T>
  T pick(std::initializer_list<T> values) {
    return values.begin()[integer(0, static_cast<int>(values.size()) - 1)];
  }

private:
  std::uint64_t state_;
};

} // namespace stress
