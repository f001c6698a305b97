#include "reference/Curves.h"

#include "reference/CameraRays.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace reference {

double transmittanceAt(const std::vector<Segment>& segments, double depth) {
  double passed = 1;
  for (const Segment& s : segments) {
    if (depth < s.entry || (depth == s.entry && s.exit > s.entry)) continue;
    const double share = s.exit > s.entry ? std::min((depth - s.entry) / (s.exit - s.entry), 1.0) : 1.0;
    passed *= std::pow(s.transmittance, share);
  }
  return passed;
}

namespace {

double onCurve(const std::vector<glm::dvec2>& curve, double depth) {
  glm::dvec2 before(0, 1);
  for (const glm::dvec2& node : curve) {
    if (depth < node.x)
      return &node == &curve.front() ? 1 : before.y + (node.y - before.y) * (depth - before.x) / (node.x - before.x);
    before = node;
  }
  return before.y;
}

// Place in a view, from 0 to 1 in x and y, and depth from the near to the far plane, linear in the world; none if
// outside or before the near plane.
std::optional<glm::dvec3> placeIn(const glm::dmat4& clipFromWorld, bool zeroToOne, bool bounded,
                                  const glm::dvec3& point) {
  const glm::dvec4 clip = clipFromWorld * glm::dvec4(point, 1);
  const double low = zeroToOne ? 0 : -1;
  if (!(clip.w > 0) || std::max(std::abs(clip.x), std::abs(clip.y)) > clip.w) return {};
  const double z = clip.z / clip.w;
  if (z < low || (bounded && z > 1)) return {};
  // Between the points of the planes on this very light ray.
  const glm::dmat4 inverse = glm::inverse(clipFromWorld);
  const auto unproject = [&](double depth) {
    const glm::dvec4 p = inverse * glm::dvec4(clip.x / clip.w, clip.y / clip.w, depth, 1);
    return glm::dvec3(p) / p.w;
  };
  const glm::dvec3 near = unproject(low), far = unproject(1);
  const double depth = glm::dot(point - near, far - near) / glm::dot(far - near, far - near);
  return glm::dvec3(0.5 * clip.x / clip.w + 0.5, 0.5 * clip.y / clip.w + 0.5, depth);
}

} // namespace

double dimming(const CurveMap& map, const tyndall::Light& light, const glm::dvec3& point, const glm::dvec3& direction) {
  const std::size_t count = light.shadow.views.size();
  const bool zeroToOne = light.shadow.clipDepth == tyndall::ClipDepth::ZeroToOne;
  for (std::size_t v = 0; v < count; ++v) {
    const glm::dmat4 clipFromWorld = toMat4(light.shadow.views[v].clipFromWorld);
    const bool bounded = light.kind == tyndall::LightKind::Directional && v + 1 < count;
    const auto place = placeIn(clipFromWorld, zeroToOne, bounded, point);
    if (!place) continue;
    const glm::dvec4 a = clipFromWorld * glm::dvec4(point, 1),
                     b = clipFromWorld * glm::dvec4(point + 1e-4 * direction, 1);
    const glm::dvec2 moved = glm::abs(glm::dvec2(b) / b.w - glm::dvec2(a) / a.w);
    const int main = moved.x >= moved.y ? 0 : 1;
    const auto curveAt = [&](int across) {
      glm::ivec2 at;
      at[main] = std::clamp(static_cast<int>((*place)[main] * map.size), 0, map.size - 1);
      at[1 - main] = std::clamp(across, 0, map.size - 1);
      const auto size = static_cast<std::size_t>(map.size);
      return onCurve(map.curves[(v * size + static_cast<std::size_t>(at.y)) * size + static_cast<std::size_t>(at.x)],
                     place->z);
    };
    const double at = (*place)[1 - main] * map.size - 0.5, low = std::floor(at);
    return curveAt(static_cast<int>(low)) * (1 - (at - low)) + curveAt(static_cast<int>(low) + 1) * (at - low);
  }
  return 1;
}

EyeDimming::EyeDimming(const EyeCurveMap& map, double x, double y, double advance) : map_(map), advance_(advance) {
  const int size = map.map.size;
  const glm::dvec2 at(x * size - 0.5, y * size - 0.5), low = glm::floor(at), f = at - low;
  for (int k = 0; k < 4; ++k) {
    const glm::ivec2 step(k & 1, k >> 1);
    const glm::ivec2 texel = glm::clamp(glm::ivec2(low) + step, glm::ivec2(0), glm::ivec2(size - 1));
    texels_.push_back(static_cast<std::size_t>(texel.y * size + texel.x));
    weights_.push_back((step.x ? f.x : 1 - f.x) * (step.y ? f.y : 1 - f.y));
    for (const glm::dvec2& node : map.map.curves[texels_.back()])
      bends_.push_back((map.near + node.x * (map.far - map.near)) / advance);
  }
  std::sort(bends_.begin(), bends_.end());
}

template <typename OnCurve>
double EyeDimming::meanAt(double s, const OnCurve& onCurve) const {
  const double depth = (s * advance_ - map_.near) / (map_.far - map_.near);
  double sum = 0;
  for (std::size_t k = 0; k < texels_.size(); ++k)
    sum += weights_[k] * onCurve(map_.map.curves[texels_[k]], depth);
  return sum;
}

double EyeDimming::at(double s) const { return meanAt(s, onCurve); }

double EyeDimming::inFogAt(double s) const {
  constexpr double kLeast = 1e-6; // of an even medium, which would let nothing through
  return meanAt(s, [](const std::vector<glm::dvec2>& curve, double depth) {
    glm::dvec2 before(-1e9, 1);
    for (const glm::dvec2& node : curve) {
      if (depth <= node.x) {
        const double share = node.x > before.x ? (depth - before.x) / (node.x - before.x) : 1;
        return node.y > kLeast ? before.y * std::pow(node.y / before.y, share) : before.y + (node.y - before.y) * share;
      }
      before = node;
    }
    return before.y;
  });
}

} // namespace reference
