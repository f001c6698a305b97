#include "Plausible.h"

#include "FieldText.h"
#include "optics/Ambient.h"
#include "optics/Blocks.h"
#include "optics/EyeLight.h"
#include "optics/HeightFog.h"
#include "optics/Projections.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

namespace {

using optics::toGlm;

std::string rowText(const glm::dvec4& row) {
  return "(" + text(row.x) + ", " + text(row.y) + ", " + text(row.z) + ", " + text(row.w) + ")";
}

void checkRow(const Camera& camera, Findings& findings) {
  const glm::dmat4 clipFromView = toGlm(camera.clipFromView);
  if (optics::hasUsualRow(clipFromView)) return;
  const std::string row = "has the last row " + rowText(glm::transpose(clipFromView)[3]);
  const bool transposed = optics::hasUsualRow(glm::transpose(clipFromView));
  const bool inverted = optics::hasUsualRow(glm::inverse(clipFromView));
  if (transposed || inverted)
    return findings.wrong(
        {StatusCode::InvalidFrame, "Frame::camera.clipFromView " + row + ": it is " +
                                       (transposed ? "transposed (take the other of mat4 and mat4RowMajor)" : "") +
                                       (transposed && inverted ? ", or " : "") +
                                       (inverted ? "the inverse of a projection, viewFromClip" : "")});
  findings.warnings.push_back("Frame::camera.clipFromView " + row +
                              ": projections have (0, 0, -1, 0) or (0, 0, 0, 1); is a view matrix in it, too?");
}

// A clip depth that is not the projection's moves its planes.
void checkPlanes(const Camera& camera, const optics::Projection& projection, Findings& findings) {
  if (optics::isOrthographic(projection.depthClipFromWorld)) return;
  const bool reversed = optics::isReversed(projection.depthClipFromWorld, projection.forward());
  const double ratio = projection.farOverNear(reversed);
  const bool zeroToOne = camera.clipDepth == ClipDepth::ZeroToOne;
  if (ratio < 0)
    return findings.wrong(
        invalid("camera.clipDepth", zeroToOne ? "ZeroToOne" : "NegativeOneToOne",
                "with it clipFromView's far plane lies behind the eye; the projection is one for the other"));
  if (ratio < 2.01)
    findings.warnings.push_back(
        lineOf("camera.clipDepth", zeroToOne ? "ZeroToOne" : "NegativeOneToOne",
               "with it clipFromView's far plane is only " + text(ratio) + " times as far as the near plane"));
}

void checkAspect(const Frame& frame, Findings& findings) {
  constexpr double kRounding = 0.05; // of the size in pixels, and of a dynamic resolution
  const glm::dmat4 m = toGlm(frame.camera.clipFromView);
  const glm::dvec3 x(m[0][0], m[1][0], m[2][0]), y(m[0][1], m[1][1], m[2][1]);
  const double seen = std::abs(y.y / x.x), shown = double(frame.viewport.width) / frame.viewport.height;
  if (frame.viewport.width < 16 || frame.viewport.height < 16 || !std::isfinite(seen)) return; // all is rounding
  if (std::abs(seen / shown - 1) > kRounding)
    findings.warnings.push_back(lineOf("camera.clipFromView", "for a picture " + text(seen) + " times as wide as high",
                                       "the viewport is " + text(shown) + " times as wide; of another size?"));
}

// A projection that is symmetric but for its jitter says how large that is.
void checkJitter(const Frame& frame, Findings& findings) {
  const auto& jitter = frame.camera.jitter;
  if (jitter[0] == 0 && jitter[1] == 0) return;
  const glm::dmat4 m = toGlm(frame.camera.clipFromView);
  const glm::dvec4 middle = m[2][3] != 0 ? m[2] / m[2][3] : m[3] / m[3][3]; // where the view's axis is in the picture
  const glm::dvec2 moved = 0.5 * glm::dvec2(middle) * glm::dvec2(frame.viewport.width, frame.viewport.height);
  const glm::dvec2 off = moved - glm::dvec2(jitter[0], jitter[1]);
  constexpr double kMostPixels = 16.01, kRounding = 0.02;
  if (std::max(std::abs(moved.x), std::abs(moved.y)) > kMostPixels) return; // not symmetric
  if (std::max(std::abs(off.x), std::abs(off.y)) > kRounding)
    findings.warnings.push_back(
        lineOf("camera.jitter", "(" + text(jitter[0]) + ", " + text(jitter[1]) + ")",
               "clipFromView moves the picture by (" + text(moved.x) + ", " + text(moved.y) + ") pixels"));
}

void checkCamera(const Frame& frame, Findings& findings) {
  checkRow(frame.camera, findings);
  if (!findings.error) return;
  checkPlanes(frame.camera, optics::Projection(toGlm(frame.camera.clipFromView), frame.camera.clipDepth), findings);
  checkAspect(frame, findings);
  checkJitter(frame, findings);
}

// ---------------------------------------------------------------------------------------------------------------------

// How far the camera sees: its near plane, and where most of its rays end at the latest.
struct Sight {
  double near = 0, end = kInfinity;
};

Sight sightOf(const Frame& frame) {
  const Camera& camera = frame.camera;
  const optics::Projection projection(toGlm(camera.clipFromView), camera.clipDepth);
  const bool parallel = optics::isOrthographic(projection.depthClipFromWorld);
  const glm::dvec3 forward = parallel ? glm::dvec3(0, 0, -1) : projection.forward();
  const bool reversed = optics::isReversed(projection.depthClipFromWorld, forward);
  const glm::dvec4 near = projection.middle(reversed ? 1 : 0), far = projection.middle(reversed ? 0 : 1);
  const glm::dvec3 from = parallel ? glm::dvec3(near) / near.w : projection.eye();
  Sight sight;
  sight.near = glm::length(glm::dvec3(near) / near.w - from);
  if (parallel || std::isfinite(projection.farOverNear(reversed)))
    sight.end = glm::length(glm::dvec3(far) / far.w - from);
  return sight;
}

void checkMedium(const Frame& frame, Findings& findings) {
  const glm::dvec3 scattering = optics::scatteringOf(frame.medium);
  const glm::dvec3 extinction = optics::extinctionAtEye(frame.medium, frame.camera);
  const double most = std::max({scattering.x, scattering.y, scattering.z});
  const double least = std::min({extinction.x, extinction.y, extinction.z});
  if (most == 0 && optics::isFogLit(frame)) return;
  if (most == 0) {
    if (!frame.lights.empty() || optics::isLit(frame.ambient))
      findings.warnings.emplace_back("Frame::medium.constituents scatter nothing: no light is added");
    return;
  }
  const Sight sight = sightOf(frame);
  constexpr double kOpaque = 7, kClear = 1e-7; // optical depths: a thousandth is left; less than a half float shows
  if (least * sight.near > kOpaque && frame.medium.dimsBackground)
    findings.warnings.push_back(
        lineOf("medium", "so thick that nothing is seen",
               "1/extinction is " + text(1 / least) + " world units, the camera's near plane " + text(sight.near)));
  const double longest = std::max(std::isfinite(sight.end) ? sight.end : 0, frame.medium.farDistance);
  if (most * longest < kClear && !optics::isLayered(frame.medium))
    findings.warnings.push_back(
        lineOf("medium", "so thin that nothing is seen of it",
               "1/scattering is " + text(1 / most) + " world units, the longest ray " + text(longest)));
  if (frame.medium.farDistance <= sight.near)
    findings.warnings.push_back(lineOf("medium.farDistance", text(frame.medium.farDistance),
                                       "the camera's near plane is no nearer, " + text(sight.near)));
}

void checkBrightness(const Frame& frame, Findings& findings) {
  const auto isBlack = [](const Light& light) { return light.colour == Rgb{0, 0, 0} || light.scatteringScale == 0; };
  const bool areBlack = std::all_of(frame.lights.begin(), frame.lights.end(), isBlack);
  if (!frame.lights.empty() && areBlack && !optics::isLit(frame.ambient))
    findings.warnings.emplace_back(
        "Frame::lights: the colour of each is black, or its scatteringScale 0: no light is added");
  constexpr double kRinging = 0.05; // of coefficients that were fitted to a sky
  if (const double least = optics::leastAmbient(frame); least < -kRinging)
    findings.warnings.push_back(lineOf("ambient.harmonics", "below 0 on some side",
                                       "what is scattered comes to " + text(least) +
                                           " of the most towards some directions, and is taken as 0"));
}

void checkMap(const Frame& frame, std::size_t index, Findings& findings) {
  const ShadowMap& shadow = frame.lights[index].shadow;
  const auto field = [&] { return "lights[" + std::to_string(index) + "].shadow.texture"; };
  if (shadow.texture == 0) {
    if (!shadow.views.empty())
      findings.warnings.push_back(lineOf(field(), "0", "it has views, but nothing blocks the light"));
    return;
  }
  if (shadow.texture == frame.depth.texture && !shadow.array)
    return findings.wrong(invalid(field(), "texture " + std::to_string(shadow.texture), "that is the scene depth"));
  if (!shadow.cube.enabled) checkViews(frame, index, findings);
}

} // namespace

Status checkPlausible(const Frame& frame, std::vector<std::string>& warnings) {
  Findings findings{warnings};
  checkCamera(frame, findings);
  if (!findings.error) return findings.error;
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    checkMap(frame, i, findings);
  checkMedium(frame, findings);
  checkBrightness(frame, findings);
  return findings.error;
}

} // namespace tyndall
