#include "gl/QuadRenderer.h"
#include "gl/Pause.h"

#include <algorithm>
#include <tyndall/avsm.h>

namespace host {

namespace {

Program makePicture(const QuadShaders& shaders) {
  const std::string version = "#version 330 core\n";
  return {
      shaders.name, (version + shaders.vertex).c_str(), (version + shaders.shared + shaders.picture).c_str(), {"LIT"}};
}

Program makeCapture(const QuadShaders& shaders) {
  const std::string version = "#version 430 core\n";
  const std::string fragment = version + tyndall::avsmCaptureSource() + shaders.shared + shaders.capture;
  return {std::string(shaders.name) + " capture", (version + shaders.vertex).c_str(), fragment.c_str()};
}

} // namespace

QuadRenderer::QuadRenderer(const QuadShaders& shaders)
    : shaders_(shaders), light_((std::string(shaders.name) + " light").c_str(), shaders.light, shaders.lightFilter),
      picture_(makePicture(shaders)), empty_(makeVertexArray()) {}

void QuadRenderer::begin(Program& program, const glm::dmat4& clipFromWorld, const glm::vec4& eye) const {
  program.use();
  program.set("clipFromRelative", glm::mat4(clipFromWorld * translation(origin_)));
  program.set("eye", eye);
}

Program& QuadRenderer::beginCapture(const CaptureView& view) {
  if (!capture_) capture_ = makeCapture(shaders_);
  begin(*capture_, view.clipFromWorld, glm::vec4(view.light - view.light.w * glm::dvec4(origin_, 0)));
  const glm::dvec3 slope(view.depthPlane);
  capture_->set("depthPlane", glm::vec4(slope, glm::dot(slope, origin_) + view.depthPlane.w));
  capture_->set("layer", view.layer);
  return *capture_;
}

Program& QuadRenderer::beginPicture(const CameraView& camera, const RenderTargets& targets) {
  gl().BindFramebuffer(GL_FRAMEBUFFER, targets.framebuffer());
  gl().Viewport(0, 0, targets.width(), targets.height());
  gl().Enable(GL_BLEND);
  gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  begin(picture_, camera.clipFromWorld, camera.viewerFrom(origin_));
  gl().ActiveTexture(GL_TEXTURE0 + kLightUnit);
  gl().BindTexture(GL_TEXTURE_2D, light_.texture());
  picture_.set("light", static_cast<int>(kLightUnit));
  return picture_;
}

void QuadRenderer::drawQuads(Program& program, std::size_t count) const {
  constexpr std::size_t kAtOnce = 4096;
  gl().BindVertexArray(empty_.name());
  const std::size_t most = Pause::isWanted() ? kAtOnce : count;
  for (std::size_t first = 0; first < count; first += most) {
    program.set("firstQuad", static_cast<int>(first));
    gl().DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(std::min(most, count - first)));
    Pause::take();
  }
}

} // namespace host
