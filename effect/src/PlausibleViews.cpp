// Shadow views against their light and against each other.
#include "FieldText.h"
#include "Plausible.h"
#include "optics/Projections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace tyndall {

namespace {

using optics::Projection;
using optics::toGlm;

std::string viewField(std::size_t light, std::size_t view, const char* member = "clipFromWorld") {
  return "lights[" + std::to_string(light) + "].shadow.views[" + std::to_string(view) + "]." + member;
}

// A light with the views that it has.
struct Lamp {
  const Frame& frame;
  std::size_t index;
  const Light& light;
  std::array<Projection, kMaxShadowViews> views = {};
  std::size_t count = 0; // of the views

  bool isSun() const { return light.kind == LightKind::Directional; }
  glm::dvec3 position() const { return toGlm(light.position); }
  glm::dvec3 direction() const { return optics::directionOf(toGlm(light.direction)); }

  // As the effect reads it off.
  bool isReversed(const Projection& view) const {
    const glm::dvec4 centre = view.middle(0.5);
    return optics::isReversed(view.depthClipFromWorld,
                              isSun() ? direction() : glm::dvec3(centre) / centre.w - position());
  }
};

// ---------------------------------------------------------------------------------------------------------------------
// Where the rays of a view come from

// The sine of the angle between a sun's light and a view's rays.
double sunOff(const Projection& view, const glm::dvec3& direction) {
  const glm::dvec4 near = view.middle(0), far = view.middle(1);
  const glm::dvec3 from = glm::dvec3(near) / near.w, ray = glm::dvec3(far) / far.w - from;
  constexpr double kParallel = 1000; // depths of the view, from its middle to where its rays meet
  const glm::dvec4 centre = view.centre();
  if (centre.w != 0 && glm::length(view.eye() - from) < kParallel * glm::length(ray)) return kInfinity;
  return glm::length(glm::cross(glm::normalize(ray), direction));
}

// How far a lamp's view is from the lamp, as a part of its nearer plane's distance; beyond what rounding makes of that.
double lampOff(const Projection& view, const glm::dvec3& position) {
  if (optics::isOrthographic(view.depthClipFromWorld) || view.centre().w == 0) return kInfinity;
  constexpr double kRounding = 1e-5; // of the lamp's place in a matrix of floats
  const glm::dvec4 low = view.middle(0), high = view.middle(1), near = std::abs(low.w) > std::abs(high.w) ? low : high;
  const double off = std::max(glm::length(view.eye() - position) - kRounding * glm::length(position), 0.0);
  return off / glm::length(glm::dvec3(near) / near.w - view.eye());
}

constexpr double kMostOff = 0.005;

double offOf(const Lamp& lamp, const Projection& view) {
  return lamp.isSun() ? sunOff(view, lamp.direction()) : lampOff(view, lamp.position());
}

// What the matrix would have to be for its rays to come from the light.
std::string remedyOf(const Lamp& lamp, std::size_t view) {
  const glm::dmat4 given = toGlm(lamp.light.shadow.views[view].clipFromWorld);
  const auto fits = [&](const glm::dmat4& matrix) {
    return offOf(lamp, Projection(matrix, lamp.light.shadow.clipDepth)) <= kMostOff;
  };
  if (fits(glm::transpose(given))) return "; it is transposed: take the other of mat4 and mat4RowMajor";
  if (fits(glm::inverse(given))) return "; it is the inverse, worldFromClip";
  if (fits(glm::inverse(glm::transpose(given)))) return "; it is the inverse, transposed";
  return "";
}

std::string centreText(const Lamp& lamp, const Projection& view) {
  const glm::dvec4 centre = view.centre();
  if (lamp.isSun() && sunOff(view, lamp.direction()) == kInfinity) return "a perspective view";
  if (!lamp.isSun() && lampOff(view, lamp.position()) == kInfinity) return "an orthographic view";
  if (!lamp.isSun()) return "a view from " + textOf(view.eye());
  const glm::dvec3 along = glm::normalize(glm::dvec3(centre));
  return "a view along " + textOf(glm::dot(along, lamp.direction()) < 0 ? -along : along);
}

// Rows and slices run through the light and what its views show: only exact does without that (Technique).
void refuse(const Lamp& lamp, const std::string& line, Findings& findings) {
  if (lamp.frame.settings.technique == Technique::Exact)
    findings.warnings.push_back(line);
  else
    findings.wrong({StatusCode::InvalidFrame, line});
}

void checkCentre(const Lamp& lamp, std::size_t i, Findings& findings) {
  if (offOf(lamp, lamp.views[i]) <= kMostOff) return;
  const std::string light = "lights[" + std::to_string(lamp.index) + "].";
  const std::string rule =
      lamp.isSun() ? "must be orthographic along " + light + "direction, which is " + textOf(lamp.direction())
                   : "must be a perspective view from " + light + "position, which is " + textOf(lamp.light.position);
  const std::string line = lineOf(viewField(lamp.index, i), centreText(lamp, lamp.views[i]), rule + remedyOf(lamp, i));
  refuse(lamp, line, findings);
}

// ---------------------------------------------------------------------------------------------------------------------
// What a view shows

glm::dvec2 placeOf(const Projection& view, const glm::dvec4& p) {
  const glm::dvec4 clip = view.depthClipFromWorld * p;
  return glm::dvec2(clip) / clip.w;
}

// A symmetric perspective has its axis in the middle, a matrix for texture coordinates at (0.5, 0.5).
void checkAxis(const Lamp& lamp, std::size_t i, Findings& findings) {
  const Projection& view = lamp.views[i];
  if (lamp.isSun() || lampOff(view, lamp.position()) > kMostOff) return;
  const glm::dvec2 axis = placeOf(view, glm::dvec4(view.eye() + view.forward() / glm::length(view.forward()), 1));
  constexpr double kRounding = 1e-3;
  if (glm::length(glm::abs(axis) - 0.5) > kRounding) return;
  findings.wrong(invalid(viewField(lamp.index, i),
                         "a view whose axis is at (" + text(axis.x) + ", " + text(axis.y) + ")",
                         "clip space runs from -1 to 1; texture coordinates, from 0 to 1, are not scaled into it, nor "
                         "is an atlas's tile (rectangle)"));
}

// How far from the picture's middle a direction from the eye is, in half its width; infinite for what is behind.
double awayFrom(const Projection& view, const glm::dvec3& way) {
  const glm::dvec4 clip = view.depthClipFromWorld * glm::dvec4(way, 0);
  const bool ahead = clip.w != 0 && (clip.w > 0) == ((view.depthClipFromWorld * view.middle(0.5)).w > 0);
  return ahead ? std::max(std::abs(clip.x), std::abs(clip.y)) / std::abs(clip.w) : kInfinity;
}

// The smallest angle between a direction and those that a perspective view shows.
double angleTo(const Projection& view, const glm::dvec3& axis) {
  if (awayFrom(view, axis) <= 1) return 0;
  std::array<glm::dvec3, 4> corners; // in turn
  for (std::size_t k = 0; k < 4; ++k) {
    const glm::dvec4 p = view.worldFromDepthClip * glm::dvec4(k == 1 || k == 2 ? 1 : -1, k < 2 ? -1 : 1, 0.5, 1);
    corners[k] = glm::normalize(glm::dvec3(p) / p.w - view.eye());
  }
  double least = glm::pi<double>();
  const auto consider = [&](const glm::dvec3& way) {
    least = std::min(least, std::atan2(glm::length(glm::cross(way, axis)), glm::dot(way, axis)));
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const glm::dvec3 &a = corners[k], &b = corners[(k + 1) % 4], normal = glm::cross(a, b);
    const glm::dvec3 onEdge = axis - glm::dot(axis, normal) / glm::dot(normal, normal) * normal;
    consider(a);
    if (glm::dot(glm::cross(a, onEdge), normal) > 0 && glm::dot(glm::cross(onEdge, b), normal) > 0) consider(onEdge);
  }
  return least;
}

// Whether a camera has some of the ray from a lamp between its sides.
bool sees(const Projection& camera, const Lamp& lamp, const glm::dvec3& way) {
  const glm::dvec4 from = camera.depthClipFromWorld * glm::dvec4(lamp.position(), 1),
                   step = camera.depthClipFromWorld * glm::dvec4(way, 0);
  double begin = 0, end = lamp.light.range;
  for (int side = 0; side < 4; ++side) { // inside of one are the distances t where at + t rate >= 0
    const double sign = side < 2 ? 1 : -1;
    const double at = from.w + sign * from[side % 2], rate = step.w + sign * step[side % 2];
    if (rate == 0 && at < 0) return false;
    if (rate > 0) begin = std::max(begin, -at / rate);
    if (rate < 0) end = std::min(end, -at / rate);
  }
  return begin < end;
}

// A spot's view holds what the camera sees of its cone, whose rim is nearly dark.
void checkCone(const Lamp& lamp, const Projection& camera, Findings& findings) {
  const Projection& view = lamp.views.front();
  const std::string field = "lights[" + std::to_string(lamp.index) + "].";
  const glm::dvec3 axis = lamp.direction();
  const double cone = lamp.light.outerConeAngle;
  if (angleTo(view, axis) > cone) {
    refuse(lamp,
           lineOf(field + "direction", textOf(lamp.light.direction),
                  "all of the cone is outside of " + viewField(lamp.index, 0)),
           findings);
    return;
  }
  const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 side = glm::normalize(glm::cross(axis, other)), up = glm::cross(axis, side);
  for (int k = 0; k < 16; ++k) {
    const double turn = k * glm::pi<double>() / 8;
    const glm::dvec3 rim = std::cos(cone) * axis + std::sin(cone) * (std::cos(turn) * side + std::sin(turn) * up);
    constexpr double kRim = 1.1;
    if (awayFrom(view, rim) <= kRim || !sees(camera, lamp, rim)) continue;
    findings.warnings.push_back(
        lineOf(field + "outerConeAngle", text(cone),
               "a half angle, in radians; the cone reaches out of " + viewField(lamp.index, 0)));
    return;
  }
}

// Of an engine's projections all mirror, or none.
void checkMirror(const Lamp& lamp, bool cameraMirrored, std::size_t i, Findings& findings) {
  const Projection& view = lamp.views[i];
  if (view.isMirrored(lamp.isReversed(view)) == cameraMirrored) return;
  findings.warnings.push_back(
      lamp.isSun() ? lineOf("lights[" + std::to_string(lamp.index) + "].direction", textOf(lamp.light.direction),
                            "as seen along it " + viewField(lamp.index, i) +
                                " is mirrored, which the camera is not: points it to the sun, or is row y negated?")
                   : lineOf(viewField(lamp.index, i), "mirrored",
                            "the camera is not: is row y negated, or one of them left-handed?"));
}

void checkPlanes(const Lamp& lamp, std::size_t i, Findings& findings) {
  const Projection& view = lamp.views[i];
  if (lamp.isSun() || optics::isOrthographic(view.depthClipFromWorld)) return;
  const double ratio = view.farOverNear(lamp.isReversed(view));
  const std::string field = "lights[" + std::to_string(lamp.index) + "].";
  const char* const value = lamp.light.shadow.clipDepth == ClipDepth::ZeroToOne ? "ZeroToOne" : "NegativeOneToOne";
  if (ratio < 0)
    findings.wrong(invalid(field + "shadow.clipDepth", value,
                           "with it the far plane of views[" + std::to_string(i) +
                               "] lies behind the light; the projection is one for the other"));
  const bool reversed = lamp.isReversed(view);
  const glm::dvec4 near = view.middle(reversed ? 1 : 0);
  const double distance = glm::length(glm::dvec3(near) / near.w - view.eye());
  if (lamp.light.range < distance)
    findings.warnings.push_back(
        lineOf(field + "range", text(lamp.light.range),
               "the near plane of views[" + std::to_string(i) + "] is farther, " + text(distance)));
}

// ---------------------------------------------------------------------------------------------------------------------
// Several views

// In the part of space that the view owns, its far plane included.
bool holds(const Projection& view, const glm::dvec3& p) {
  constexpr double kRounding = 1e-5;
  const glm::dvec4 clip = view.depthClipFromWorld * glm::dvec4(p, 1);
  const glm::dvec3 place = glm::dvec3(clip) / clip.w - glm::dvec3(0, 0, 0.5);
  return clip.w > 0 && std::abs(place.x) < 1 + kRounding && std::abs(place.y) < 1 + kRounding &&
         std::abs(place.z) < 0.5 + kRounding;
}

bool holdsAll(const Projection& view, const Projection& other) {
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p =
        other.worldFromDepthClip * glm::dvec4(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : 0, 1);
    if (!holds(view, glm::dvec3(p) / p.w)) return false;
  }
  return true;
}

void checkCascades(const Lamp& lamp, std::size_t i, Findings& findings) {
  for (std::size_t before = 0; before < i; ++before)
    if (holdsAll(lamp.views[before], lamp.views[i])) {
      findings.warnings.push_back(lineOf(viewField(lamp.index, i),
                                         "all inside of views[" + std::to_string(before) + "]",
                                         "it is never looked at: the finest comes first"));
      return;
    }
}

bool isWhole(const Rectangle& r) { return r.x == 0 && r.y == 0 && r.width == 0 && r.height == 0; }

void checkLayers(const Lamp& lamp, std::size_t i, Findings& findings) {
  const std::vector<ShadowView>& views = lamp.light.shadow.views;
  for (std::size_t before = 0; before < i; ++before)
    if (views[before].layer == views[i].layer && isWhole(views[before].rectangle) && isWhole(views[i].rectangle)) {
      findings.warnings.push_back(lineOf(viewField(lamp.index, i, "layer"), std::to_string(views[i].layer),
                                         "that of views[" + std::to_string(before) + "], and neither has a rectangle"));
      return;
    }
}

bool isInView(const Lamp& lamp, const glm::dvec3& way) {
  constexpr double kRounding = 1e-4;
  return std::any_of(lamp.views.begin(), lamp.views.begin() + lamp.count,
                     [&](const Projection& view) { return awayFrom(view, way) <= 1 + kRounding; });
}

// A point light shines to all sides: to the middles, edges and corners of a cube.
void checkCover(const Lamp& lamp, Findings& findings) {
  int open = 0, all = 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        ++all;
        if (!isInView(lamp, {x, y, z})) ++open;
      }
  if (open > 0)
    findings.warnings.push_back(lineOf("lights[" + std::to_string(lamp.index) + "].shadow.views",
                                       std::to_string(lamp.count) + " long",
                                       "a point light shines to all sides, and of " + std::to_string(all) +
                                           " directions " + std::to_string(open) + " are in no view (six faces are)"));
}

Projection projectionOf(const Camera& camera) {
  return {toGlm(camera.clipFromView) * toGlm(camera.viewFromWorld), camera.clipDepth};
}

// Whether the camera mirrors, as views are not to.
bool isMirrored(const Camera& camera) {
  const Projection projection = projectionOf(camera);
  const glm::dvec3 forward = optics::isOrthographic(projection.depthClipFromWorld)
                                 ? -glm::dvec3(glm::transpose(toGlm(camera.viewFromWorld))[2])
                                 : projection.forward();
  return projection.isMirrored(optics::isReversed(projection.depthClipFromWorld, forward));
}

} // namespace

void checkViews(const Frame& frame, std::size_t index, Findings& findings) {
  Lamp lamp{frame, index, frame.lights[index]};
  for (const ShadowView& view : lamp.light.shadow.views)
    lamp.views[lamp.count++] = Projection(toGlm(view.clipFromWorld), lamp.light.shadow.clipDepth);
  const bool mirrored = isMirrored(frame.camera);
  for (std::size_t i = 0; i < lamp.count; ++i) {
    checkCentre(lamp, i, findings);
    checkAxis(lamp, i, findings);
    checkPlanes(lamp, i, findings);
    checkLayers(lamp, i, findings);
    if (!findings.error) return;
    if (i == 0 || !lamp.isSun()) checkMirror(lamp, mirrored, i, findings);
    if (lamp.isSun()) checkCascades(lamp, i, findings);
  }
  if (lamp.light.kind == LightKind::Spot) checkCone(lamp, projectionOf(frame.camera), findings);
  if (lamp.light.kind == LightKind::Point) checkCover(lamp, findings);
}

} // namespace tyndall
