#include "StrandLight.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <stdexcept>

namespace reference {
namespace {

thread_local std::vector<unsigned> found; // by the ray that is on its way

void collect(const RTCFilterFunctionNArguments* arguments) {
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit); // N is 1
  found.push_back(hit->primID);
  arguments->valid[0] = 0; // and on
}

/// Squared, of the nearest points of two lines between ends (Ericson, Real-Time Collision Detection, 5.1.9).
double distance2(const glm::dvec3& p, const glm::dvec3& toP, const glm::dvec3& q, const glm::dvec3& toQ) {
  const glm::dvec3 d1 = toP - p, d2 = toQ - q, r = p - q;
  const double a = glm::dot(d1, d1), e = glm::dot(d2, d2), f = glm::dot(d2, r), c = glm::dot(d1, r);
  double s = 0, t = 0;
  if (e > 0) {
    const double b = glm::dot(d1, d2), area = a * e - b * b;
    s = area > 0 ? std::clamp((b * f - c * e) / area, 0.0, 1.0) : 0;
    t = (b * s + f) / e;
  }
  t = std::clamp(t, 0.0, 1.0);
  s = a > 0 ? std::clamp((t * glm::dot(d1, d2) - c) / a, 0.0, 1.0) : 0;
  const glm::dvec3 apart = r + s * d1 - t * d2;
  return glm::dot(apart, apart);
}

} // namespace

StrandLight::StrandLight(const host::Strands& strands) : device_(rtcNewDevice(nullptr)) {
  if (!device_) throw std::runtime_error("reference: Embree has no device");
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const host::StrandPoint& point : strands.points)
    low = glm::min(low, point.position), high = glm::max(high, point.position);
  if (!strands.points.empty()) centre_ = 0.5 * (low + high);
  for (std::size_t i = 0; i < strands.segments.size(); ++i) {
    const host::StrandPoint& a = strands.points[strands.segments[i].x];
    const host::StrandPoint& b = strands.points[strands.segments[i].y];
    segments_.push_back({a.position, b.position, 0.25 * (a.strand.width + b.strand.width),
                         1 - 0.5 * (a.strand.opacity + b.strand.opacity),
                         i > 0 && strands.segments[i - 1].y == strands.segments[i].x});
  }
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  if (!segments_.empty()) {
    constexpr double kWider = 1.02; // what floats make of a radius
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    const std::size_t count = segments_.size();
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 2 * count));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), count));
    for (std::size_t i = 0; i < count; ++i) {
      for (const glm::dvec3& end : {segments_[i].a, segments_[i].b}) {
        const glm::vec3 place(end - centre_);
        for (int k = 0; k < 3; ++k)
          *vertices++ = place[k];
        *vertices++ = static_cast<float>(kWider * segments_[i].radius);
      }
      indices[i] = static_cast<unsigned>(2 * i);
    }
    rtcSetGeometryIntersectFilterFunction(geometry, collect);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene_.get());
}

double StrandLight::transmittance(const glm::dvec3& place, const glm::dvec3& lamp, int own) const {
  RTCRayHit hit{};
  hit.ray = embreeRay(place - centre_, glm::normalize(lamp - place), 0, glm::length(lamp - place));
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  found.clear();
  intersect(scene_.get(), hit);
  std::sort(found.begin(), found.end());
  double passed = 1;
  // Segments of a strand that follow one another are one crossing.
  for (std::size_t i = 0; i < found.size();) {
    bool isCrossed = false, isOwn = false;
    const unsigned first = found[i];
    unsigned last = first;
    for (; i < found.size() && (found[i] == last || (found[i] == last + 1 && segments_[found[i]].continues)); ++i) {
      last = found[i];
      const Segment& segment = segments_[last];
      isCrossed = isCrossed || distance2(place, lamp, segment.a, segment.b) <= segment.radius * segment.radius;
      isOwn = isOwn || static_cast<int>(last) == own;
    }
    if (isCrossed && !isOwn) passed *= segments_[first].passed;
  }
  return passed;
}

double StrandLight::meanTransmittance(const glm::dvec3& place, const glm::dvec3& lamp, int own, double diameter,
                                      int rays) const {
  if (!(diameter > 0)) return transmittance(place, lamp, own);
  const glm::dvec3 towards = glm::normalize(lamp - place);
  const glm::dvec3 aside = std::abs(towards.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(towards, aside)), v = glm::cross(towards, u);
  double sum = 0;
  for (int i = 0; i < rays; ++i) { // Vogel's spiral
    const double radius = 0.5 * diameter * std::sqrt((i + 0.5) / rays),
                 angle = i * glm::pi<double>() * (3 - std::sqrt(5.0));
    sum += transmittance(place + radius * (std::cos(angle) * u + std::sin(angle) * v), lamp, own);
  }
  return sum / rays;
}

} // namespace reference
