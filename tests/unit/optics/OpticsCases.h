// Cameras, lights and shadow views for the tests of the effect's mathematics, from seeds where they are random.
#pragma once

#include <glm/glm.hpp>
#include <random>
#include <scene/Projection.h>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace tests {

/// Numbers from a seed, the same with every library.
class Random {
public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double within(double low, double high) { return low + (high - low) * (static_cast<double>(bits_()) / 4294967296.0); }
  glm::dvec3 inCube(double half) {
    const double x = within(-half, half), y = within(-half, half);
    return {x, y, within(-half, half)};
  }
  glm::dvec3 direction(); ///< unit, even over the sphere

private:
  std::mt19937 bits_;
};

inline const host::ClipConvention kConventions[] = {{false, tyndall::ClipDepth::NegativeOneToOne},
                                                    {false, tyndall::ClipDepth::ZeroToOne},
                                                    {true, tyndall::ClipDepth::NegativeOneToOne},
                                                    {true, tyndall::ClipDepth::ZeroToOne}};

/// A projection and what is known of it.
struct Projection {
  std::string name;
  host::ClipConvention convention;
  bool orthographic = false;
  double nearPlane = 0, farPlane = 0; ///< distances along -z; the far one may be infinite
  glm::dmat4 clipFromView{1};
};

/// In all conventions: perspective, also with a far plane at infinity and off centre, and orthographic; lengths times
/// `scale`.
std::vector<Projection> projections(double scale = 1);

tyndall::Camera cameraOf(const Projection& projection, const glm::dvec3& eye, const glm::dvec3& direction,
                         const glm::dvec3& up = {0, 1, 0});

/// An image of a camera; a little fog, without lights.
tyndall::Frame frameOf(const tyndall::Camera& camera, int width, int height);

/// Window position in pixels and depth in [0, 1] of a world point, and the clip w, which is negative behind the eye.
struct Seen {
  glm::dvec2 window{0};
  double depth = 0, w = 0;
};
Seen seenAt(const tyndall::Frame& frame, const glm::dvec3& point);

tyndall::Light sun(const glm::dvec3& direction);
tyndall::Light lamp(const glm::dvec3& position);
tyndall::Light spot(const glm::dvec3& position, const glm::dvec3& direction, double outerConeAngle);

/// Gives the light views: cascades of a directional light around `middle`, a spot's one, a lamp's cube.
void addViews(tyndall::Light& light, const host::ClipConvention& convention, const glm::dvec3& middle, double size);

glm::dvec3 vec(const tyndall::Vec3& v);
tyndall::Vec3 vec(const glm::dvec3& v);

/// The same scene after x -> scale * rotation x + offset.
struct Placement {
  glm::dmat3 rotation{1};
  double scale = 1;
  glm::dvec3 offset{0};
  glm::dmat4 matrix() const;
};
tyndall::Frame placed(tyndall::Frame frame, const Placement& placement);

glm::dmat3 turned(Random& random); ///< any rotation

} // namespace tests
