#include "SceneExact.h"

#include "Ambient.h"
#include "CameraRays.h"
#include "LightSlice.h"
#include "Optics.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace reference {
namespace {

struct TintedInterval {
  Interval shadow;
  Rgb tint;
};

/// What the sorted, possibly overlapping dark intervals leave of [s0, s1].
std::vector<Interval> gapsBetween(std::vector<Interval>& dark, double s0, double s1) {
  std::sort(dark.begin(), dark.end(), [](const Interval& l, const Interval& r) { return l.begin < r.begin; });
  std::vector<Interval> gaps;
  double reached = s0;
  for (const Interval& shadow : dark) {
    if (shadow.begin > reached) gaps.push_back({reached, shadow.begin});
    reached = std::max(reached, shadow.end);
  }
  if (reached < s1) gaps.push_back({reached, s1});
  return gaps;
}

/// Cuts a lit stretch where glass begins and ends; each piece has the product of the tints that cover it.
void tintSpans(const Interval& lit, const std::vector<TintedInterval>& glass, std::vector<LitSpan>& spans) {
  std::vector<TintedInterval> here;
  std::vector<double> ends = {lit.begin, lit.end};
  for (const TintedInterval& pane : glass) {
    if (pane.shadow.end <= lit.begin || pane.shadow.begin >= lit.end) continue;
    here.push_back(pane);
    ends.push_back(std::max(pane.shadow.begin, lit.begin));
    ends.push_back(std::min(pane.shadow.end, lit.end));
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (ends[i + 1] <= ends[i]) continue;
    const double middle = 0.5 * (ends[i] + ends[i + 1]);
    Rgb tint{1};
    for (const TintedInterval& pane : here)
      if (pane.shadow.begin <= middle && middle < pane.shadow.end) tint *= pane.tint;
    if (tint != Rgb(0)) spans.push_back({ends[i], ends[i + 1], tint});
  }
}

} // namespace

std::vector<Triangle> trianglesOf(const host::Scene& scene, const std::vector<glm::dmat4>& worldFromNode) {
  std::vector<Triangle> triangles;
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].mesh < 0) continue;
    for (const host::Primitive& primitive : scene.meshes[static_cast<std::size_t>(scene.nodes[n].mesh)].primitives) {
      const host::Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
      const bool blended = material.alphaMode == host::AlphaMode::Blend;
      const bool glass = material.isGlass() || (blended && material.baseColour.a < 1);
      const bool clear = material.alphaMode == host::AlphaMode::Mask && material.baseColour.a < material.alphaCutoff;
      if (primitive.topology != host::Topology::Triangles || material.unlit || (clear && !glass)) continue;
      const double covered = blended ? material.baseColour.a : 1;
      const Rgb tint = 1 - covered + covered * (Rgb(material.baseColour) * static_cast<double>(material.transmission));
      const auto corner = [&](std::size_t i) {
        return glm::dvec3(worldFromNode[n] * glm::dvec4(primitive.vertices[primitive.indices[i]].position, 1));
      };
      for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
        triangles.push_back({corner(i), corner(i + 1), corner(i + 2), glass, glass ? tint : Rgb(0)});
    }
  }
  return triangles;
}

SceneExact::SceneExact(const std::vector<Triangle>& triangles) : device_(rtcNewDevice(nullptr)) {
  if (!device_) throw std::runtime_error("reference: Embree has no device");
  glm::dvec3 low(kInfinity), high(-kInfinity);
  for (const Triangle& t : triangles) {
    Part& part = t.glass ? glass_ : opaque_;
    part.corners.push_back({t.a, t.b, t.c});
    part.tints.push_back(t.tint);
    low = glm::min(low, glm::min(t.a, glm::min(t.b, t.c)));
    high = glm::max(high, glm::max(t.a, glm::max(t.b, t.c)));
  }
  if (!triangles.empty()) centre_ = 0.5 * (low + high);
  build(opaque_);
  build(glass_);
}

void SceneExact::build(Part& part) const {
  part.bvh = std::make_unique<TriangleBvh>(device_.get(), part.corners);
  part.embree.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(part.embree.get(), RTC_SCENE_FLAG_ROBUST);
  if (!part.corners.empty()) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t count = part.corners.size();
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
    for (const TriangleBvh::Corners& corners : part.corners)
      for (const glm::dvec3& corner : corners)
        for (int i = 0; i < 3; ++i)
          *vertices++ = static_cast<float>((corner - centre_)[i]);
    for (unsigned i = 0; i < 3 * count; ++i)
      indices[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(part.embree.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(part.embree.get());
}

RTCRay SceneExact::embreeRay(const Ray& ray, double nearest, double farthest) const {
  return reference::embreeRay(ray.origin - centre_, ray.direction, nearest, farthest);
}

double SceneExact::firstHit(const Ray& ray, double nearest, double farthest) const {
  RTCRayHit hit{};
  hit.ray = embreeRay(ray, nearest, farthest);
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  intersect(opaque_.embree.get(), hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kInfinity;
  const TriangleBvh::Corners& corners = opaque_.corners[hit.hit.primID];
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double refined = glm::dot(corners[0] - ray.origin, normal) / glm::dot(ray.direction, normal);
  return std::isfinite(refined) ? std::max(refined, 0.0) : static_cast<double>(hit.ray.tfar);
}

std::vector<LitSpan> SceneExact::litSpans(const Ray& ray, const tyndall::Light& light, double s0, double s1) const {
  std::vector<LitSpan> spans;
  if (s0 >= s1) return spans;
  const LightSlice slice(light, ray, s0, s1);
  std::vector<Interval> dark;
  opaque_.bvh->forEachNear(slice.region(), [&](const TriangleBvh::Corners& corners, std::uint32_t) {
    if (const auto shadow = slice.shadowOf(corners)) dark.push_back(*shadow);
  });
  std::vector<TintedInterval> glass;
  glass_.bvh->forEachNear(slice.region(), [&](const TriangleBvh::Corners& corners, std::uint32_t index) {
    if (const auto shadow = slice.shadowOf(corners)) glass.push_back({*shadow, glass_.tints[index]});
  });
  for (const Interval& lit : gapsBetween(dark, s0, s1))
    tintSpans(lit, glass, spans);
  return spans;
}

Rgb SceneExact::visibilityAt(const glm::dvec3& point, const tyndall::Light& light) const {
  glm::dvec3 toLight = -toVec3(light.direction);
  double distance = kInfinity;
  if (light.kind != tyndall::LightKind::Directional) {
    toLight = toVec3(light.position) - point;
    distance = glm::length(toLight);
  }
  const Ray ray{point, glm::normalize(toLight)};
  RTCRay shadowRay = embreeRay(ray, 0, distance);
  occlude(opaque_.embree.get(), shadowRay);
  if (shadowRay.tfar < 0) return Rgb(0);
  Rgb tint{1};
  double nearest = 0;
  for (std::size_t i = 0; i < glass_.corners.size(); ++i) {
    RTCRayHit hit{};
    hit.ray = embreeRay(ray, nearest, distance);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(glass_.embree.get(), hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
    tint *= glass_.tints[hit.hit.primID];
    nearest = std::nextafter(hit.ray.tfar, std::numeric_limits<float>::infinity()) * (1 + 1e-6);
  }
  return tint;
}

PixelAnswer SceneExact::pixel(const SceneView& view, const CameraRays& rays, int x, int y) const {
  const Ray ray = rays.ray(x, y);
  const Interval visible = rays.nearToFar(x, y);
  const double hit = firstHit(ray, visible.begin, visible.end);
  const double end = std::isinf(hit) ? view.medium.farDistance : hit;
  PixelAnswer answer{Rgb(0), transmittance(view.medium, ray, end)};
  if (!view.medium.dimsBackground) answer.transmittance = Rgb(1);
  if (isLit(view.ambient)) answer.inscatter += ambientLight(view.medium, view.ambient, ray, end);
  for (const tyndall::Light& light : view.lights) {
    const Airlight airlight(view.medium, light, ray);
    const Interval reach = airlight.support();
    for (const LitSpan& span : litSpans(ray, light, std::max(0.0, reach.begin), std::min(end, reach.end)))
      answer.inscatter += span.tint * airlight.span(span.begin, span.end);
  }
  return answer;
}

ImageAnswer SceneExact::render(const SceneView& view) const {
  const CameraRays rays(view.camera, view.width, view.height);
  ImageAnswer answer{Image(view.width, view.height), Image(view.width, view.height)};
  parallelFor(view.height, [&](int y) {
    for (int x = 0; x < view.width; ++x) {
      const PixelAnswer one = pixel(view, rays, x, y);
      answer.inscatter.set(x, y, one.inscatter);
      answer.transmittance.set(x, y, one.transmittance);
    }
  });
  return answer;
}

std::vector<PixelAnswer> SceneExact::render(const SceneView& view, const std::vector<glm::ivec2>& pixels) const {
  const CameraRays rays(view.camera, view.width, view.height);
  std::vector<PixelAnswer> answers(pixels.size());
  parallelFor(static_cast<int>(pixels.size()), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    answers[k] = pixel(view, rays, pixels[k].x, pixels[k].y);
  });
  return answers;
}

} // namespace reference
