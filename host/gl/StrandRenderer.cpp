#include "gl/StrandRenderer.h"

#include "gl/StrandShaders.h"

#include <algorithm>
#include <glm/gtc/matrix_access.hpp>
#include <tyndall/avsm.h>

namespace host {

namespace {

constexpr GLuint kPoints = kFirstFreeUnit;
constexpr GLuint kSegments = kFirstFreeUnit + 1;
constexpr GLuint kLight = kFirstFreeUnit + 2;
constexpr int kLightsAcross = 2048;

Program makeProgram() {
  const std::string version = "#version 330 core\n";
  return {"strands", (version + shaders::kStrandVertex).c_str(), (version + shaders::kStrandFragment).c_str(), {"LIT"}};
}

Program makeCapture() {
  const std::string version = "#version 430 core\n";
  return {"strand capture", (version + shaders::kStrandVertex).c_str(),
          (version + tyndall::avsmCaptureSource() + shaders::kStrandCapture).c_str()};
}

glm::dvec3 middleOf(const std::vector<StrandPoint>& points) {
  if (points.empty()) {
    return glm::dvec3(0);
  }
  glm::dvec3 low = points.front().position;
  glm::dvec3 high = low;
  for (const StrandPoint& point : points) {
    low = glm::min(low, point.position);
    high = glm::max(high, point.position);
  }
  return 0.5 * (low + high);
}

} // namespace

StrandRenderer::StrandRenderer(Strands strands)
    : points_(GL_RGBA32F), segments_(GL_RG32UI), light_("strand light", shaders::kStrandLight, GL_NEAREST),
      strand_(makeProgram()), empty_(makeVertexArray()) {
  set(std::move(strands));
}

void StrandRenderer::set(Strands strands) {
  strands_ = std::move(strands);
  origin_ = middleOf(strands_.points);
  uploadPoints();
  gl().ActiveTexture(GL_TEXTURE0 + kSegments);
  segments_.upload(strands_.segments.data(), strands_.segments.size(), sizeof(glm::uvec2), "strands");
}

void StrandRenderer::uploadPoints() {
  std::vector<glm::vec4> texels;
  texels.reserve(3 * strands_.points.size());
  for (const StrandPoint& point : strands_.points) {
    texels.emplace_back(glm::vec3(point.position - origin_), static_cast<float>(point.strand.width));
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

void StrandRenderer::setView(Program& program, const glm::dmat4& clipFromWorld, const glm::vec4& eye,
                             double pixelSize) const {
  points_.bind(kPoints);
  segments_.bind(kSegments);
  program.set("points", static_cast<int>(kPoints));
  program.set("segments", static_cast<int>(kSegments));
  program.set("clipFromRelative", glm::mat4(clipFromWorld * translation(origin_)));
  program.set("eye", eye);
  program.set("pixelSize", static_cast<float>(pixelSize));
}

void StrandRenderer::capture(const CaptureView& view) {
  if (strands_.segments.empty()) {
    return;
  }
  if (!capture_) {
    capture_ = makeCapture();
  }
  capture_->use();
  const glm::dvec4 light = view.light - view.light.w * glm::dvec4(origin_, 0);
  setView(*capture_, view.clipFromWorld, glm::vec4(light), texelSizeOf(view.clipFromWorld, view.size));
  const glm::dvec3 slope(view.depthPlane);
  capture_->set("depthPlane", glm::vec4(slope, glm::dot(slope, origin_) + view.depthPlane.w));
  capture_->set("layer", view.layer);
  capture_->set("feather", 0.0F);
  gl().BindVertexArray(empty_.name());
  gl().DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count());
}

void StrandRenderer::light(const CameraView& camera, const Illumination& illumination) {
  const int points = static_cast<int>(strands_.points.size());
  light_.render({kLightsAcross, (points + kLightsAcross - 1) / kLightsAcross}, illumination, origin_,
                [&](Program& program) {
                  points_.bind(kPoints);
                  program.set("points", static_cast<int>(kPoints));
                  program.set("count", points);
                  program.set("lightsAcross", kLightsAcross);
                  program.set("eye", camera.viewerFrom(origin_));
                });
}

void StrandRenderer::draw(const CameraView& camera, const Illumination& illumination, const RenderTargets& targets) {
  if (strands_.segments.empty()) {
    return;
  }
  uploadSorted(camera);
  light(camera, illumination);
  gl().BindFramebuffer(GL_FRAMEBUFFER, targets.framebuffer());
  gl().Viewport(0, 0, targets.width(), targets.height());
  gl().Enable(GL_DEPTH_TEST);
  gl().DepthFunc(nearerFunction(camera.convention));
  gl().DepthMask(GL_TRUE);
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  strand_.use();
  const double perUnit = glm::length(glm::dvec3(glm::row(camera.clipFromWorld, 1)));
  setView(strand_, camera.clipFromWorld, camera.viewerFrom(origin_), 2.0 / (targets.height() * perUnit));
  strand_.set("feather", 1.0F);
  strand_.set("lightsAcross", kLightsAcross);
  gl().ActiveTexture(GL_TEXTURE0 + kLight);
  gl().BindTexture(GL_TEXTURE_2D, light_.texture());
  strand_.set("light", static_cast<int>(kLight));
  gl().BindVertexArray(empty_.name());
  gl().DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count());
  gl().DepthMask(GL_FALSE);
}

} // namespace host
