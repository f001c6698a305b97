#include "gl/SmokeRenderer.h"

#include "gl/SmokeShaders.h"

#include <algorithm>
#include <tyndall/avsm.h>

namespace host {

namespace {

constexpr GLuint kParticles = kFirstFreeUnit;
constexpr GLuint kLight = kFirstFreeUnit + 1;
constexpr GLuint kDepth = kFirstFreeUnit + 2;
constexpr int kTile = 4; ///< points across a particle where it is lit, as in the shaders
constexpr int kTilesAcross = 256;

Program makeProgram() {
  const std::string version = "#version 330 core\n";
  return {"smoke", (version + shaders::kSmokeVertex).c_str(),
          (version + shaders::kSmokeChord + shaders::kSmokeFragment).c_str()};
}

Program makeCapture() {
  const std::string version = "#version 430 core\n";
  const std::string fragment = version + tyndall::avsmCaptureSource() + shaders::kSmokeChord + shaders::kSmokeCapture;
  return {"smoke capture", (version + shaders::kSmokeVertex).c_str(), fragment.c_str()};
}

glm::dvec3 middleOf(const std::vector<SmokeParticle>& particles) {
  if (particles.empty()) {
    return glm::dvec3(0);
  }
  glm::dvec3 low = particles.front().position;
  glm::dvec3 high = low;
  for (const SmokeParticle& particle : particles) {
    low = glm::min(low, particle.position);
    high = glm::max(high, particle.position);
  }
  return 0.5 * (low + high);
}

} // namespace

SmokeRenderer::SmokeRenderer(std::vector<SmokeParticle> particles)
    : buffer_(GL_RGBA32F), light_("smoke light", shaders::kSmokeLight, GL_LINEAR), smoke_(makeProgram()),
      depthFramebuffer_(makeFramebuffer()), empty_(makeVertexArray()) {
  set(std::move(particles));
}

void SmokeRenderer::set(std::vector<SmokeParticle> particles) {
  particles_ = std::move(particles);
  particles_.erase(std::remove_if(particles_.begin(), particles_.end(),
                                  [](const SmokeParticle& particle) { return !(particle.density > 0); }),
                   particles_.end());
  origin_ = middleOf(particles_);
  upload(particles_);
}

void SmokeRenderer::upload(const std::vector<SmokeParticle>& particles) {
  std::vector<glm::vec4> texels;
  texels.reserve(2 * particles.size());
  for (const SmokeParticle& particle : particles) {
    texels.emplace_back(glm::vec3(particle.position - origin_), static_cast<float>(particle.radius));
    texels.emplace_back(particle.albedo, static_cast<float>(particle.density));
  }
  gl().ActiveTexture(GL_TEXTURE0 + kParticles);
  buffer_.upload(texels.data(), texels.size(), sizeof(glm::vec4), "smoke");
}

/// Farthest first.
void SmokeRenderer::sort(const CameraView& camera) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    order.emplace_back((camera.viewFromWorld * glm::dvec4(particles_[i].position, 1)).z, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<SmokeParticle> sorted;
  sorted.reserve(particles_.size());
  for (const auto& [viewZ, i] : order) {
    sorted.push_back(particles_[i]);
  }
  particles_ = std::move(sorted);
  upload(particles_);
}

void SmokeRenderer::setView(Program& program, const glm::dmat4& clipFromWorld, const glm::vec4& eye) const {
  const glm::dmat4 clipFromRelative = clipFromWorld * translation(origin_);
  buffer_.bind(kParticles);
  program.set("particles", static_cast<int>(kParticles));
  program.set("clipFromRelative", glm::mat4(clipFromRelative));
  program.set("relativeFromClip", glm::mat4(glm::inverse(clipFromRelative)));
  program.set("eye", eye);
}

void SmokeRenderer::capture(const CaptureView& view) {
  if (particles_.empty()) {
    return;
  }
  if (!capture_) {
    capture_ = makeCapture();
  }
  capture_->use();
  const glm::dvec4 light = view.light - view.light.w * glm::dvec4(origin_, 0);
  setView(*capture_, view.clipFromWorld, glm::vec4(light));
  const glm::dvec3 slope(view.depthPlane);
  capture_->set("depthPlane", glm::vec4(slope, glm::dot(slope, origin_) + view.depthPlane.w));
  capture_->set("layer", view.layer);
  gl().BindVertexArray(empty_.name());
  gl().DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count());
}

void SmokeRenderer::light(const CameraView& camera, const Illumination& illumination) {
  const int rows = (count() + kTilesAcross - 1) / kTilesAcross;
  light_.render({kTile * kTilesAcross, kTile * rows}, illumination, origin_, [&](Program& program) {
    buffer_.bind(kParticles);
    program.set("particles", static_cast<int>(kParticles));
    program.set("tilesAcross", kTilesAcross);
    program.set("count", count());
    program.set("right", glm::vec3(glm::normalize(glm::dvec3(camera.worldFromView[0]))));
    program.set("up", glm::vec3(glm::normalize(glm::dvec3(camera.worldFromView[1]))));
  });
}

void SmokeRenderer::copyDepth(const RenderTargets& targets) {
  gl().BindFramebuffer(GL_FRAMEBUFFER, depthFramebuffer_.name());
  const glm::ivec2 size(targets.width(), targets.height());
  if (size != depthSize_ || targets.depthFormat() != depthFormat_) {
    gl().ActiveTexture(GL_TEXTURE0 + kDepth);
    depth_ = makeTexture2D(targets.depthFormat(), size.x, size.y);
    gl().FramebufferTexture2D(GL_FRAMEBUFFER, depthAttachmentOf(targets.depthFormat()), GL_TEXTURE_2D, depth_.name(),
                              0);
    gl().DrawBuffer(GL_NONE);
    gl().ReadBuffer(GL_NONE);
    requireCompleteFramebuffer("copy of the depth");
    depthSize_ = size;
    depthFormat_ = targets.depthFormat();
  }
  gl().BindFramebuffer(GL_READ_FRAMEBUFFER, targets.framebuffer());
  gl().BlitFramebuffer(0, 0, size.x, size.y, 0, 0, size.x, size.y, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

/// How the depth buffer's values become view depths: of the inverse projection only rows z and w matter.
void SmokeRenderer::setDepth(const CameraView& camera) {
  const bool zeroToOne = camera.convention.clipDepth == tyndall::ClipDepth::ZeroToOne;
  const glm::dmat4 viewFromClip = glm::inverse(camera.clipFromView);
  smoke_.set("ndcFromDepth", zeroToOne ? glm::vec2(1, 0) : glm::vec2(2, -1));
  smoke_.set("depthFromNdc",
             glm::vec4(-viewFromClip[2][2], -viewFromClip[3][2], viewFromClip[2][3], viewFromClip[3][3]));
  smoke_.set("forward", glm::vec3(-glm::normalize(glm::dvec3(camera.worldFromView[2]))));
  smoke_.set("viewpoint", glm::vec3(camera.eye - origin_));
}

void SmokeRenderer::draw(const CameraView& camera, const Illumination& illumination, const RenderTargets& targets) {
  if (particles_.empty()) {
    return;
  }
  sort(camera);
  light(camera, illumination);
  copyDepth(targets);
  gl().BindFramebuffer(GL_FRAMEBUFFER, targets.framebuffer());
  gl().Viewport(0, 0, targets.width(), targets.height());
  gl().Disable(GL_DEPTH_TEST);
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_ONE, GL_SRC_ALPHA);
  gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  smoke_.use();
  setView(smoke_, camera.clipFromWorld, camera.viewerFrom(origin_));
  setDepth(camera);
  smoke_.set("right", glm::vec3(glm::normalize(glm::dvec3(camera.worldFromView[0]))));
  smoke_.set("up", glm::vec3(glm::normalize(glm::dvec3(camera.worldFromView[1]))));
  const int rows = (count() + kTilesAcross - 1) / kTilesAcross;
  smoke_.set("tileSize", glm::vec2(kTile * kTilesAcross, kTile * rows));
  smoke_.set("tilesAcross", kTilesAcross);
  gl().ActiveTexture(GL_TEXTURE0 + kLight);
  gl().BindTexture(GL_TEXTURE_2D, light_.texture());
  smoke_.set("light", static_cast<int>(kLight));
  gl().ActiveTexture(GL_TEXTURE0 + kDepth);
  gl().BindTexture(GL_TEXTURE_2D, depth_.name());
  smoke_.set("sceneDepth", static_cast<int>(kDepth));
  gl().BindVertexArray(empty_.name());
  gl().DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count());
}

} // namespace host
