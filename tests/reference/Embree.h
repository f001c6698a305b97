// Embree 3 (Debian 12) or 4 (Debian 13), which differ in how a ray is traced.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <glm/glm.hpp>
#include <memory>
#include <type_traits>

namespace reference {

struct EmbreeRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePointer = std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeRelease>;
using ScenePointer = std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeRelease>;

/// From Embree's origin.
inline RTCRay embreeRay(const glm::vec3& origin, const glm::vec3& direction, double nearest, double farthest) {
  RTCRay result{};
  result.org_x = origin.x;
  result.org_y = origin.y;
  result.org_z = origin.z;
  result.dir_x = direction.x;
  result.dir_y = direction.y;
  result.dir_z = direction.z;
  result.tnear = static_cast<float>(nearest);
  result.tfar = static_cast<float>(farthest);
  result.mask = 0xFFFFFFFFU;
  return result;
}

inline void intersect(RTCScene scene, RTCRayHit& hit) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &hit);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &hit);
#endif
}

/// The ray's tfar is negative afterwards if something is in its way.
inline void occlude(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
}

} // namespace reference
