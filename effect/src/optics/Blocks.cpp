#include "optics/Blocks.h"

#include "optics/EngineDepth.h"
#include "optics/EyeLight.h"
#include "optics/HeightFog.h"
#include "optics/Matrices.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

namespace tyndall::optics {

namespace {

constexpr double kEndless = 1e30;      // a ray without end; float32 holds it, and exp(-sigma_t 1e30) is 0 or 1
constexpr double kInvisibleDepth = 40; // optical depth behind which light counts for less than 5e-18
constexpr double kLongestMarch = 1e15; // its square is a float32
constexpr double kBrightest = 3e38;    // float32 holds it: colours, places and extinctions end there
constexpr double kShortest = 1e-30;    // as float32 not 0, which would mean that there is no limit

// Each constituent's share of the scattering, per channel; where a channel does not scatter, that of the one that does
// most.
std::vector<glm::dvec3> sharesOf(const Medium& medium) {
  const glm::dvec3 sum = scatteringOf(medium);
  const int most = sum.x >= sum.y && sum.x >= sum.z ? 0 : sum.y >= sum.z ? 1 : 2;
  std::vector<glm::dvec3> shares;
  for (const Constituent& constituent : medium.constituents) {
    const glm::dvec3 scattering = toGlm(constituent.scattering);
    glm::dvec3 share(sum[most] > 0 ? scattering[most] / sum[most] : 0);
    for (int c = 0; c < 3; ++c)
      if (sum[c] > 0) share[c] = scattering[c] / sum[c];
    shares.push_back(share);
  }
  return shares;
}

glm::vec4 phaseNormAndShape(const Constituent& c, double& norm) {
  constexpr double kPi = glm::pi<double>();
  const double g = c.g, a = (1 - std::abs(g)) * (1 - std::abs(g)), b = 2 * std::abs(g), side = g < 0 ? -1 : 1;
  switch (c.phase) {
  case Phase::Isotropic:
    norm = 1 / (4 * kPi);
    return {1, 0, 0, 1};
  case Phase::Rayleigh:
    norm = 3 / (16 * kPi);
    return {1, 0, 1, 1};
  case Phase::HenyeyGreenstein:
    norm = (1 - g * g) / (4 * kPi);
    return {a, b, 0, side};
  case Phase::CornetteShanks:
    norm = 3 * (1 - g * g) / (8 * kPi * (2 + g * g));
    return {a, b, 1, side};
  }
  norm = 0;
  return {1, 0, 0, 1};
}

// How far along a ray curves before the eye reach.
double fogReach(const Frame& frame, const blocks::FrameBlock& block) {
  if (block.isOrthographic != 0) return frame.eyeCurves.farDistance;
  const glm::dvec3 forward =
      glm::normalize(glm::dvec3(eyeDepth(frame.camera, frame.eyeCurves.nearDistance, frame.eyeCurves.farDistance)));
  double least = 1; // cosine, at the corners
  for (const glm::dvec2 corner : {glm::dvec2(-0.5), glm::dvec2(0.5, -0.5), glm::dvec2(-0.5, 0.5), glm::dvec2(0.5)}) {
    const glm::dvec2 p = corner * glm::dvec2(block.frameSize);
    const glm::dvec3 point =
        glm::dvec3(block.farPoint[0]) + p.x * glm::dvec3(block.farPoint[1]) + p.y * glm::dvec3(block.farPoint[2]);
    least = std::min(least, glm::dot(glm::normalize(point), forward));
  }
  return frame.eyeCurves.farDistance / std::max(least, 1e-3);
}

// Distance behind which no channel that scatters shows anything, whatever layers add to what is everywhere.
// Where only fog scatters, it ends with its curves.
double visibleDistance(const Frame& frame, const blocks::FrameBlock& block) {
  const glm::dvec3 extinction = extinctionOf(frame.medium, kEverywhere), scattering = scatteringOf(frame.medium);
  const glm::dvec3 fog = fogAlbedo(frame);
  double distance = 0;
  for (int c = 0; c < 3; ++c) {
    if (scattering[c] > 0) distance = std::max(distance, kInvisibleDepth / extinction[c]);
    if (fog[c] > 0) distance = std::max(distance, std::min(kInvisibleDepth / extinction[c], fogReach(frame, block)));
  }
  return std::min(distance, kLongestMarch);
}

void setCameraRays(blocks::FrameBlock& block, const Frame& frame) {
  const Camera& camera = frame.camera;
  const glm::dmat4 depthClipFromWorld =
      depthFromClip(camera.clipDepth) * toGlm(camera.clipFromView) * toGlm(camera.viewFromWorld);
  const glm::dmat4 depthClipFromCamera = glm::translate(depthClipFromWorld, cameraOrigin(camera));
  const glm::dmat4 cameraFromDepthClip = glm::inverse(depthClipFromCamera);
  const bool orthographic = isOrthographic(depthClipFromWorld);
  // Depth is reversed if it falls with the distance to the eye (clip w), or along the view's -z if orthographic.
  const glm::dvec4 row3 = glm::transpose(depthClipFromWorld)[3];
  const glm::dvec3 forward =
      orthographic ? -glm::dvec3(glm::transpose(toGlm(camera.viewFromWorld))[2]) : glm::dvec3(row3);
  const bool reversed = isReversed(depthClipFromWorld, forward);
  const double far = reversed ? 0 : 1, near = 1 - far;
  glm::dvec4 corner = cameraFromDepthClip * glm::dvec4(0, 0, far, 1);
  glm::dvec4 stepX = cameraFromDepthClip[0] * (2.0 / frame.viewport.width);
  glm::dvec4 stepY = cameraFromDepthClip[1] * (2.0 / frame.viewport.height);
  glm::dvec4 step = cameraFromDepthClip[2] * (near - far);
  // Any common factor cancels; this one makes float32's range irrelevant. The clip w of what is seen must be positive.
  double scale = glm::length(glm::dvec3(corner));
  if (orthographic)
    scale = corner.w;
  else if (corner.w + step.w < 0)
    scale = -scale;
  block.farPoint[0] = corner / scale;
  block.farPoint[1] = stepX / scale;
  block.farPoint[2] = stepY / scale;
  block.nearStep = step / scale;
  if (!orthographic) block.nearStep = glm::vec4(0, 0, 0, step.w / scale); // xyz is 0 but for rounding
  block.depthOffset = reversed ? 0 : 1;
  block.depthScale = reversed ? 1 : -1;
  block.isOrthographic = orthographic ? 1 : 0;
  block.skyEnd = static_cast<float>(std::min(frame.medium.farDistance, kEndless));
}

void setLayers(blocks::FrameBlock& block, const Frame& frame) {
  if (!isLayered(frame.medium)) return;
  block.layerCount = static_cast<int>(frame.medium.layers.size());
  const glm::dvec3 origin = cameraOrigin(frame.camera);
  for (int i = 0; i < block.layerCount; ++i) {
    const Density density = densityOf(frame.medium, i, origin);
    block.layerUp[i] = glm::clamp(glm::dvec4(density.gradient, density.offset), -kEndless, kEndless);
    block.layerExtinction[i] =
        glm::dvec4(glm::min(extinctionOf(frame.medium, i), kBrightest), std::min(density.ground, kEndless));
  }
}

void setLookup(blocks::FrameBlock& block, const Lookup& lookup, const glm::ivec3& size) {
  if (size.z < 2) return;
  block.lookupSize = glm::ivec2(size);
  block.lookupDepths = size.z;
  block.lookupNear = static_cast<float>(lookup.nearDistance);
  block.lookupGrowth = static_cast<float>(std::log2(lookup.farDistance / lookup.nearDistance) / (size.z - 1));
}

int texelsOf(const AvsmCurves& curves) { return curves.nodes / (curves.packed ? 4 : 2); }

// What fog scatters of a light, as a part of what `lit` does.
void setFog(blocks::FrameBlock& block, const Frame& frame, const Medium& lit) {
  const glm::dvec3 own = scatteringOf(frame.medium), told = scatteringOf(lit), albedo = fogAlbedo(frame);
  double norm = 0;
  block.fogShape = phaseNormAndShape(fogConstituent(frame), norm);
  for (int c = 0; c < 3; ++c) {
    block.mediumScatters[c] = own[c] > 0 ? 1 : 0;
    block.fogScattering[c] = static_cast<float>(albedo[c] > 0 ? std::min(norm * albedo[c] / told[c], kBrightest) : 0);
  }
  block.isFogLit = isFogLit(frame) ? 1 : 0;
  block.fogDimsBackground = fogDimsBackground(frame) ? 1 : 0;
}

void setEyeCurves(blocks::FrameBlock& block, const Frame& frame, const Medium& lit, int size) {
  const EyeCurves& eye = frame.eyeCurves;
  if (isDimmedBeforeEye(frame)) setFog(block, frame, lit);
  if (size == 0) return;
  block.eyeCurvesSize = size;
  block.eyeCurvesPacked = eye.curves.packed ? 1 : 0;
  block.texelsPerEyeCurve = texelsOf(eye.curves);
  block.eyeCurveDepth = eyeDepth(frame.camera, eye.nearDistance, eye.farDistance);
}

} // namespace

bool isWholeLayer(const Rectangle& r) { return r.x == 0 && r.y == 0 && r.width == 0 && r.height == 0; }

Rectangle texelsOf(const ShadowView& view, int width, int height) {
  return isWholeLayer(view.rectangle) ? Rectangle{0, 0, width, height} : view.rectangle;
}

glm::dvec3 cameraOrigin(const Camera& camera) {
  const glm::dmat4 viewFromWorld = toGlm(camera.viewFromWorld);
  const glm::dmat4 depthClipFromWorld = depthFromClip(camera.clipDepth) * toGlm(camera.clipFromView) * viewFromWorld;
  if (!isOrthographic(depthClipFromWorld)) return eyeOf(depthClipFromWorld);
  const bool reversed = isReversed(depthClipFromWorld, -glm::dvec3(glm::transpose(viewFromWorld)[2]));
  const glm::dvec4 point = glm::inverse(depthClipFromWorld) * glm::dvec4(0, 0, reversed ? 1 : 0, 1);
  return glm::dvec3(point) / point.w;
}

double farthestEnd(const blocks::FrameBlock& block) {
  const double sky = block.skyEnd;
  if (block.isOrthographic != 0) return std::max(glm::length(glm::dvec3(block.nearStep)), sky);
  double far = 0;
  for (const glm::dvec2 corner : {glm::dvec2(-0.5), glm::dvec2(0.5, -0.5), glm::dvec2(-0.5, 0.5), glm::dvec2(0.5)}) {
    const glm::dvec2 p = corner * glm::dvec2(block.frameSize);
    const glm::dvec4 point =
        glm::dvec4(block.farPoint[0]) + p.x * glm::dvec4(block.farPoint[1]) + p.y * glm::dvec4(block.farPoint[2]);
    if (point.w > 1e-30) far = std::max(far, glm::length(glm::dvec3(point)) / point.w);
  }
  return std::max(far, sky);
}

glm::dvec3 peakPhase(const blocks::FrameBlock& block) {
  glm::dvec3 peak(0);
  for (int k = 0; k < block.constituentCount; ++k) {
    const glm::dvec4 shape(block.phaseShape[k]);
    peak += glm::dvec3(block.phaseWeight[k]) * ((1 + shape.z) / std::pow(shape.x, 1.5));
  }
  return peak;
}

glm::dvec3 peakFog(const blocks::FrameBlock& block) {
  if (block.isFogLit == 0) return glm::dvec3(0);
  const glm::dvec4 shape(block.fogShape);
  return glm::dvec3(block.fogScattering) * ((1 + shape.z) / std::pow(shape.x, 1.5));
}

glm::dvec3 leastPhase(const blocks::FrameBlock& block) {
  glm::dvec3 least(0);
  for (int k = 0; k < block.constituentCount; ++k) {
    const glm::dvec4 shape(block.phaseShape[k]);
    least += glm::dvec3(block.phaseWeight[k]) / std::pow(shape.x + 2 * shape.y, 1.5);
  }
  return least;
}

glm::dvec3 scatteringOf(const Medium& medium) {
  glm::dvec3 sum(0);
  for (const Constituent& c : medium.constituents)
    sum += glm::dvec3(toGlm(c.scattering));
  return sum;
}

glm::dvec3 extinctionOf(const Medium& medium) { return scatteringOf(medium) + glm::dvec3(toGlm(medium.absorption)); }

bool isMonochrome(const Medium& medium) {
  const auto isGrey = [](const glm::dvec3& v) { return v.x == v.y && v.y == v.z; };
  for (int i = kEverywhere; i < static_cast<int>(medium.layers.size()); ++i)
    if (!isGrey(extinctionOf(medium, i))) return false;
  const std::vector<glm::dvec3> shares = sharesOf(medium);
  return std::all_of(shares.begin(), shares.end(), isGrey);
}

blocks::FrameBlock frameBlock(const Frame& frame, const FrameSizes& sizes) {
  blocks::FrameBlock block{};
  setCameraRays(block, frame);
  block.extinction = glm::min(
      isLayered(frame.medium) ? extinctionOf(frame.medium, kEverywhere) : extinctionOf(frame.medium), kBrightest);
  const std::optional<Medium> standIn = standInMedium(frame);
  const Medium& lit = standIn ? *standIn : frame.medium;
  const std::vector<glm::dvec3> shares = sharesOf(lit);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    double norm = 0;
    block.phaseShape[k] = phaseNormAndShape(lit.constituents[k], norm);
    block.phaseWeight[k] = glm::vec4(glm::vec3(shares[k] * norm), lit.constituents[k].layer + 1);
  }
  setLayers(block, frame);
  block.dimsBackground = frame.medium.dimsBackground ? 1 : 0;
  block.lightCeiling = sizes.lightCeiling;
  block.colourMax = sizes.colourMax;
  block.outputMax = sizes.outputMax;
  block.constituentCount = static_cast<int>(shares.size());
  block.depthSampleCount = sizes.depthSamples;
  block.frameSize = {frame.viewport.width, frame.viewport.height};
  block.jitter = {frame.camera.jitter[0], frame.camera.jitter[1]};
  block.visibleEnd = static_cast<float>(visibleDistance(frame, block));
  setEngineDepth(block, frame, sizes.depthRounding);
  setLookup(block, frame.lookup, sizes.lookup);
  setEyeCurves(block, frame, lit, sizes.eyeCurves);
  return block;
}

namespace {

void setCone(blocks::LightBlock& block, const Light& light) {
  // Below this difference of cosines the falloff is narrower than float32 tells from a step.
  constexpr double kHardEdge = 1e-6;
  if (light.kind == LightKind::Point) {
    block.outerCosine = block.innerCosine = -1; // what serves spots may serve it, too
    return;
  }
  const double outer = std::cos(light.outerConeAngle), inner = std::cos(light.innerConeAngle);
  const bool hard = inner - outer < kHardEdge;
  const double panel = hard ? 0.2 : std::min(0.2, 0.05 * (light.outerConeAngle - light.innerConeAngle));
  const glm::dvec2 sines(std::sin(light.outerConeAngle), std::sin(light.innerConeAngle));
  block.outerCosine = static_cast<float>(std::max(outer, 0.0));
  block.innerCosine = static_cast<float>(inner);
  block.outerSineSquared = static_cast<float>(sines.x * sines.x);
  block.innerSineSquared = static_cast<float>(sines.y * sines.y);
  block.falloffScale = static_cast<float>(hard ? 0 : 1 / (inner - outer));
  block.falloffPanel = static_cast<float>(panel);
}

// The light's way through the medium, as a linear function of the camera-relative point.
glm::vec4 boundaryOf(const MediumBoundary& boundary, const glm::dvec3& direction, const glm::dvec3& origin) {
  if (!boundary.enabled) return glm::vec4(0);
  const glm::dvec3 normal = directionOf(toGlm(boundary.normal));
  const glm::dvec3 gradient = normal / glm::dot(normal, direction);
  return glm::vec4(gradient, glm::dot(gradient, origin - toGlm(boundary.point)));
}

// How far beyond a side of a shadow view floats may see what belongs to it: a spot whose map is as wide as its cone,
// and the faces of a cube, would be lit there. The side's plane is a row of texelFromCamera, or the opposite one, times
// w; its value along a ray is a sum of terms of size `constant` and `slope` times the way from the light to the point.
// A lamp's sides run through the lamp, except for the rounding of an engine's float matrices, which is added.
glm::vec4 marginOf(const glm::dmat4& texelFromCamera, const glm::dvec2& size, const Light& light,
                   const glm::dvec3& lightFromOrigin, double cameraExtent) {
  constexpr double kRounding = 1e-6; // of a sum of four products in float, and of directions
  const bool lamp = light.kind != LightKind::Directional;
  const glm::dmat4 rows = glm::transpose(texelFromCamera);
  const double reach = cameraExtent + (lamp ? glm::length(lightFromOrigin) : 0.0);
  glm::vec4 margin(0);
  for (int i = 0; i < 2; ++i) {
    const glm::dvec4 low = rows[i], high = size[i] * rows[3] - rows[i];
    const double slope = glm::length(glm::dvec3(rows[i])) + size[i] * glm::length(glm::dvec3(rows[3]));
    const double constant = std::abs(rows[i].w) + size[i] * std::abs(rows[3].w);
    double missed = 0;
    if (lamp) {
      const glm::dvec4 position(lightFromOrigin, 1);
      missed = std::max(std::abs(glm::dot(low, position)), std::abs(glm::dot(high, position)));
      // Views with a centre elsewhere are as they are meant.
      if (missed > kRounding * slope * (reach + glm::length(toGlm(light.position)))) missed = 0;
    }
    margin[i] = static_cast<float>(std::min(kRounding * (constant + slope * reach) + missed, kBrightest));
    margin[i + 2] = static_cast<float>(kRounding * slope);
  }
  return margin;
}

// A lamp nearer to the eye than double rounding of the camera's matrix is at the eye, where directions alone tell what
// its cone holds: in what direction rounding moved it must not.
glm::dvec3 fromEye(const glm::dvec3& lamp, const glm::dvec3& eye) {
  constexpr double kRounding = 1e-14;
  const auto most = [](const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  const glm::dvec3 apart = lamp - eye;
  return most(apart) > kRounding * (most(lamp) + most(eye)) ? apart : glm::dvec3(0);
}

// No camera ray begins farther from the origin.
double extentOf(const Camera& camera) {
  const glm::dmat4 clipFromWorld = toGlm(camera.clipFromView) * toGlm(camera.viewFromWorld);
  if (!isOrthographic(clipFromWorld)) return 0;
  const glm::dmat4 worldFromClip = glm::inverse(clipFromWorld);
  return glm::length(glm::dvec3(worldFromClip[0])) + glm::length(glm::dvec3(worldFromClip[1]));
}

} // namespace

blocks::LightBlock lightBlock(const Frame& frame, const Light& light, int shadowWidth, int shadowHeight,
                              int curvesSize) {
  const glm::dvec3 origin = cameraOrigin(frame.camera);
  const glm::dvec3 direction =
      light.kind == LightKind::Point ? glm::dvec3(0, -1, 0) : directionOf(toGlm(light.direction));
  blocks::LightBlock block{};
  const double scale = light.scatteringScale;
  const std::optional<Medium> standIn = standInMedium(frame);
  block.lightColour =
      glm::min(scale * glm::dvec3(toGlm(light.colour)) * scatteringOf(standIn ? *standIn : frame.medium), kBrightest);
  block.lightDirection = direction;
  if (light.kind != LightKind::Directional)
    block.lightPosition = glm::clamp(fromEye(toGlm(light.position), origin), -kBrightest, kBrightest);
  block.lightRange = static_cast<float>(light.range < kBrightest ? std::max(light.range, kShortest) : 0);
  setCone(block, light);
  block.boundary = boundaryOf(light.boundary, direction, origin);
  block.cascadeFade = static_cast<float>(light.cascadeFade);
  const auto count = static_cast<int>(light.shadow.texture ? light.shadow.views.size() : 0);
  block.viewCount = count;
  block.isLitOutside = light.litOutsideViews ? 1 : 0;
  for (int i = 0; i < count; ++i) {
    const ShadowView& view = light.shadow.views[static_cast<std::size_t>(i)];
    const glm::dmat4 depthClipFromWorld = depthFromClip(light.shadow.clipDepth) * toGlm(view.clipFromWorld);
    const bool reversed = isReversedView(light, i);
    // Clip x, y to texels and depth to a value that grows away from the light: 0..1, or -1..0 if reversed.
    glm::dmat4 texelFromClip(1);
    const Rectangle texels = texelsOf(view, shadowWidth, shadowHeight);
    texelFromClip[0][0] = texelFromClip[3][0] = 0.5 * texels.width;
    texelFromClip[1][1] = texelFromClip[3][1] = 0.5 * texels.height;
    texelFromClip[2][2] = reversed ? -1 : 1;
    const glm::dmat4 texelFromCamera = texelFromClip * glm::translate(depthClipFromWorld, origin);
    blocks::MapView& map = block.shadowViews[i];
    map.texelFromCamera = glm::mat4(texelFromCamera);
    map.margin = marginOf(texelFromCamera, glm::dvec2(texels.width, texels.height), light,
                          toGlm(light.position) - origin, extentOf(frame.camera));
    const bool open = light.kind != LightKind::Directional || i == count - 1;
    map.nearDepth = reversed ? -1 : 0;
    map.farDepth = reversed ? 0 : 1;
    map.depthSign = reversed ? -1 : 1;
    map.isOpen = open ? 1 : 0;
    map.origin = {texels.x, texels.y};
    map.size = {texels.width, texels.height};
    map.layer = view.layer;
    if (curvesSize == 0) continue;
    const glm::dvec4 depth = linearDepth(light, i).coefficients;
    map.curveDepth = glm::vec4(glm::dvec3(depth), glm::dot(depth, glm::dvec4(origin, 1)));
  }
  if (curvesSize == 0) return block;
  block.curvesSize = curvesSize;
  block.curvesPacked = light.curves.packed ? 1 : 0;
  block.texelsPerCurve = texelsOf(light.curves);
  return block;
}

} // namespace tyndall::optics
