#include "Way.h"

#include <chrono>
#include <gl/Gl.h>
#include <scene/Error.h>

namespace viewer {

Way::Way(const tyndall::Config& config) {
  tyndall::CreateResult created = tyndall::Effect::create(config);
  if (!created.status) throw host::Error("effect: " + created.status.message);
  effect_ = std::move(created.effect);
}

void Way::prepare(const host::RenderTargets& surfaces, tyndall::Frame frame, const tyndall::Settings& settings) {
  const int width = surfaces.width(), height = surfaces.height();
  if (!composite_ || composite_->width() != width || composite_->height() != height) {
    composite_ = std::make_unique<host::RenderTargets>(host::RenderTargetOptions{width, height, GL_RGBA32F});
    inscatter_ = host::makeTexture2D(GL_RGBA32F, width, height);
    transmittance_ = host::makeTexture2D(GL_RGBA32F, width, height);
  }
  frame_ = std::move(frame);
  frame_.viewport = {0, 0, width, height};
  frame_.colour = composite_->colour();
  frame_.depth.texture = surfaces.depth();
  frame_.depth.multisampled = surfaces.multisampled();
  frame_.output.inscatter = inscatter_.name();
  frame_.output.transmittance = transmittance_.name();
  frame_.settings = settings;
  copySurfaces(surfaces);
}

void Way::copySurfaces(const host::RenderTargets& surfaces) const {
  const GladGLContext& gl = host::gl();
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, surfaces.framebuffer());
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, composite_->framebuffer());
  gl.Disable(GL_SCISSOR_TEST);
  gl.BlitFramebuffer(0, 0, surfaces.width(), surfaces.height(), 0, 0, surfaces.width(), surfaces.height(),
                     GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

bool Way::render(const tyndall::Frame& frame) {
  host::gl().Finish();
  const auto start = std::chrono::steady_clock::now();
  const tyndall::Status status = effect_->render(frame);
  host::gl().Finish();
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  renderMilliseconds_ = time.count();
  if (status.code == tyndall::StatusCode::Abandoned) return false;
  if (!status) throw host::Error("effect: " + status.message);
  return true;
}

bool Way::draw(const host::RenderTargets& surfaces, tyndall::Frame frame, const tyndall::Settings& settings) {
  prepare(surfaces, std::move(frame), settings);
  bands_ = {};
  if (!render(frame_)) return false;
  milliseconds_ = renderMilliseconds_;
  statistics_ = effect_->statistics();
  hasCompiled_ = statistics_.compiledPrograms > programs_;
  programs_ = statistics_.compiledPrograms;
  return true;
}

void Way::begin(const host::RenderTargets& surfaces, tyndall::Frame frame, const tyndall::Settings& settings) {
  prepare(surfaces, std::move(frame), settings);
  frame_.reuse = {};
  frame_.objects.clear();
  bands_ = Bands(surfaces.width(), surfaces.height());
  milliseconds_ = 0;
  statistics_ = {};
}

tyndall::Rectangle Way::step(double milliseconds) {
  if (isWhole()) return {};
  const tyndall::Rectangle part = bands_.next(pace_.pixelsFor(milliseconds));
  render(croppedTo(frame_, part));
  pace_.took(static_cast<double>(part.width) * part.height, renderMilliseconds_);
  milliseconds_ += renderMilliseconds_;
  const tyndall::Statistics now = effect_->statistics();
  const std::uint64_t marched = statistics_.marchedSamples + now.marchedSamples;
  statistics_ = now;
  statistics_.marchedSamples = marched;
  return part;
}

} // namespace viewer
