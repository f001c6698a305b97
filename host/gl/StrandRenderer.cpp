#include "gl/StrandRenderer.h"

#include "gl/StrandShaders.h"

#include <algorithm>
#include <glm/gtc/matrix_access.hpp>

namespace host {

namespace {

constexpr int kLightsAcross = 2048;

constexpr QuadShaders kShaders = {
    "strands", shaders::kStrandVertex, "", shaders::kStrandFragment, shaders::kStrandCapture, shaders::kStrandLight,
    GL_NEAREST};

} // namespace

StrandRenderer::StrandRenderer(Strands strands) : QuadRenderer(kShaders), points_(GL_RGBA32F), segments_(GL_RG32UI) {
  set(std::move(strands));
}

void StrandRenderer::set(Strands strands) {
  strands_ = std::move(strands);
  centreOn(strands_.points);
  uploadPoints();
  gl().ActiveTexture(GL_TEXTURE0 + kSegments);
  segments_.upload(strands_.segments.data(), strands_.segments.size(), sizeof(glm::uvec2), "strands");
}

void StrandRenderer::uploadPoints() {
  std::vector<glm::vec4> texels;
  texels.reserve(3 * strands_.points.size());
  for (const StrandPoint& point : strands_.points) {
    texels.emplace_back(glm::vec3(point.position - origin()), static_cast<float>(point.strand.width));
    texels.emplace_back(glm::vec3(point.tangent), static_cast<float>(point.strand.opacity));
    texels.emplace_back(point.albedo, 0);
  }
  gl().ActiveTexture(GL_TEXTURE0 + kPoints);
  points_.upload(texels.data(), texels.size(), sizeof(glm::vec4), "strands");
}

/// Farthest first, by the middles of the segments.
void StrandRenderer::uploadSorted(const CameraView& camera) {
  std::vector<float> viewZ;
  viewZ.reserve(strands_.points.size());
  for (const StrandPoint& point : strands_.points) {
    viewZ.push_back(static_cast<float>((camera.viewFromWorld * glm::dvec4(point.position, 1)).z));
  }
  std::vector<std::pair<float, std::uint32_t>> order;
  order.reserve(strands_.segments.size());
  for (std::size_t i = 0; i < strands_.segments.size(); ++i) {
    const glm::uvec2 segment = strands_.segments[i];
    order.emplace_back(viewZ[segment.x] + viewZ[segment.y], static_cast<std::uint32_t>(i));
  }
  std::sort(order.begin(), order.end());
  std::vector<glm::uvec2> sorted;
  sorted.reserve(order.size());
  for (const auto& [z, i] : order) {
    sorted.push_back(strands_.segments[i]);
  }
  gl().ActiveTexture(GL_TEXTURE0 + kSegments);
  segments_.upload(sorted.data(), sorted.size(), sizeof(glm::uvec2), "strands");
}

void StrandRenderer::setSegments(Program& program, double pixelSize) const {
  points_.bind(kPoints);
  segments_.bind(kSegments);
  program.set("points", static_cast<int>(kPoints));
  program.set("segments", static_cast<int>(kSegments));
  program.set("pixelSize", static_cast<float>(pixelSize));
}

void StrandRenderer::capture(const CaptureView& view) {
  if (strands_.segments.empty()) {
    return;
  }
  Program& program = beginCapture(view);
  setSegments(program, texelSizeOf(view.clipFromWorld, view.size));
  program.set("feather", 0.0F);
  drawQuads(program, strands_.segments.size());
}

void StrandRenderer::lightUp(const CameraView& camera, const Illumination& illumination) {
  const std::size_t count = strands_.points.size();
  light().render({kLightsAcross, rowsOf(count, kLightsAcross)}, illumination, origin(), [&](Program& program) {
    points_.bind(kPoints);
    program.set("points", static_cast<int>(kPoints));
    program.set("count", static_cast<int>(count));
    program.set("lightsAcross", kLightsAcross);
    program.set("eye", camera.viewerFrom(origin()));
  });
}

void StrandRenderer::draw(const CameraView& camera, const Illumination& illumination, const RenderTargets& targets) {
  if (strands_.segments.empty()) {
    return;
  }
  uploadSorted(camera);
  lightUp(camera, illumination);
  Program& strand = beginPicture(camera, targets);
  gl().Enable(GL_DEPTH_TEST);
  gl().DepthFunc(nearerFunction(camera.convention));
  gl().DepthMask(GL_TRUE);
  gl().BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  const double perUnit = glm::length(glm::dvec3(glm::row(camera.clipFromWorld, 1)));
  setSegments(strand, 2.0 / (targets.height() * perUnit));
  strand.set("feather", 1.0F);
  strand.set("lightsAcross", kLightsAcross);
  drawQuads(strand, strands_.segments.size());
  gl().DepthMask(GL_FALSE);
}

} // namespace host
