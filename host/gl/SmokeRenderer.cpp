#include "gl/SmokeRenderer.h"

#include "gl/SmokeShaders.h"

#include <algorithm>

namespace host {

namespace {

constexpr int kTile = 4; ///< points across a particle where it is lit, as in the shaders
constexpr int kTilesAcross = 256;

constexpr QuadShaders kShaders = {"smoke",
                                  shaders::kSmokeVertex,
                                  shaders::kSmokeChord,
                                  shaders::kSmokeFragment,
                                  shaders::kSmokeCapture,
                                  shaders::kSmokeLight,
                                  GL_LINEAR};

} // namespace

SmokeRenderer::SmokeRenderer(std::vector<SmokeParticle> particles)
    : QuadRenderer(kShaders), buffer_(GL_RGBA32F), depthFramebuffer_(makeFramebuffer()) {
  set(std::move(particles));
}

void SmokeRenderer::set(std::vector<SmokeParticle> particles) {
  particles_ = std::move(particles);
  particles_.erase(std::remove_if(particles_.begin(), particles_.end(),
                                  [](const SmokeParticle& particle) { return !(particle.density > 0); }),
                   particles_.end());
  centreOn(particles_);
  upload(particles_);
}

void SmokeRenderer::upload(const std::vector<SmokeParticle>& particles) {
  std::vector<glm::vec4> texels;
  texels.reserve(2 * particles.size());
  for (const SmokeParticle& particle : particles) {
    texels.emplace_back(glm::vec3(particle.position - origin()), static_cast<float>(particle.radius));
    texels.emplace_back(particle.albedo, static_cast<float>(particle.density));
  }
  gl().ActiveTexture(GL_TEXTURE0 + kParticles);
  buffer_.upload(texels.data(), texels.size(), sizeof(glm::vec4), "smoke");
}

glm::ivec2 SmokeRenderer::lightSize() const {
  return {kTile * kTilesAcross, kTile * rowsOf(particles_.size(), kTilesAcross)};
}

/// Farthest first.
void SmokeRenderer::sort(const CameraView& camera) {
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(particles_.size());
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

void SmokeRenderer::setView(Program& program, const glm::dmat4& clipFromWorld) const {
  buffer_.bind(kParticles);
  program.set("particles", static_cast<int>(kParticles));
  program.set("relativeFromClip", glm::mat4(glm::inverse(clipFromWorld * translation(origin()))));
}

void SmokeRenderer::capture(const CaptureView& view) {
  if (particles_.empty()) {
    return;
  }
  Program& program = beginCapture(view);
  setView(program, view.clipFromWorld);
  drawQuads(program, particles_.size());
}

void SmokeRenderer::lightUp(const CameraView& camera, const Illumination& illumination) {
  light().render(lightSize(), illumination, origin(), [&](Program& program) {
    buffer_.bind(kParticles);
    program.set("particles", static_cast<int>(kParticles));
    program.set("tilesAcross", kTilesAcross);
    program.set("count", static_cast<int>(particles_.size()));
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
void SmokeRenderer::setDepth(Program& program, const CameraView& camera) const {
  const bool zeroToOne = camera.convention.clipDepth == tyndall::ClipDepth::ZeroToOne;
  const glm::dmat4 viewFromClip = glm::inverse(camera.clipFromView);
  program.set("ndcFromDepth", zeroToOne ? glm::vec2(1, 0) : glm::vec2(2, -1));
  program.set("depthFromNdc",
              glm::vec4(-viewFromClip[2][2], -viewFromClip[3][2], viewFromClip[2][3], viewFromClip[3][3]));
  program.set("forward", glm::vec3(-glm::normalize(glm::dvec3(camera.worldFromView[2]))));
  program.set("viewpoint", glm::vec3(camera.eye - origin()));
}

void SmokeRenderer::draw(const CameraView& camera, const Illumination& illumination, const RenderTargets& targets) {
  if (particles_.empty()) {
    return;
  }
  sort(camera);
  lightUp(camera, illumination);
  copyDepth(targets);
  Program& smoke = beginPicture(camera, targets);
  gl().Disable(GL_DEPTH_TEST);
  gl().BlendFunc(GL_ONE, GL_SRC_ALPHA);
  setView(smoke, camera.clipFromWorld);
  setDepth(smoke, camera);
  smoke.set("right", glm::vec3(glm::normalize(glm::dvec3(camera.worldFromView[0]))));
  smoke.set("up", glm::vec3(glm::normalize(glm::dvec3(camera.worldFromView[1]))));
  smoke.set("tileSize", glm::vec2(lightSize()));
  smoke.set("tilesAcross", kTilesAcross);
  gl().ActiveTexture(GL_TEXTURE0 + kDepth);
  gl().BindTexture(GL_TEXTURE_2D, depth_.name());
  smoke.set("sceneDepth", static_cast<int>(kDepth));
  drawQuads(smoke, particles_.size());
}

} // namespace host
