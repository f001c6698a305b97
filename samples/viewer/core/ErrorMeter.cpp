#include "ErrorMeter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gl/Gl.h>
#include <limits>

namespace viewer {

namespace {

constexpr int kDropped = 11; ///< bits of a float that bins do not tell apart; its sign is 0

std::size_t binOf(float error) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &error, sizeof bits);
  return bits >> kDropped;
}

float valueOf(std::size_t bin) {
  const auto bits = static_cast<std::uint32_t>((bin << kDropped) + (1U << (kDropped - 1)));
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

} // namespace

void ErrorSum::add(const float* got, const float* exact, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const double error = std::abs(static_cast<double>(got[i]) - exact[i]);
    sum_ += exact[i];
    squares_ += error * error;
    ++values_;
    if (!std::isfinite(error))
      ++nonFinite_;
    else
      ++counts_[binOf(static_cast<float>(error))];
  }
}

Errors ErrorSum::errors() const {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Errors errors;
  if (values_ == 0) return errors;
  const auto count = static_cast<double>(values_);
  errors.mean = sum_ / count;
  if (nonFinite_ > 0 || (errors.mean <= 0 && squares_ > 0)) return {kInfinite, kInfinite, errors.mean};
  if (squares_ == 0) return errors;
  errors.rRmse = std::sqrt(squares_ / count) / errors.mean;
  std::uint64_t left = values_ - static_cast<std::uint64_t>(0.99 * count);
  std::size_t bin = counts_.size();
  while (bin > 0 && left > 0) {
    --bin;
    left -= std::min<std::uint64_t>(left, counts_[bin]);
  }
  errors.p99 = bin == 0 ? 0 : valueOf(bin) / errors.mean;
  return errors;
}

void ErrorMeter::begin(const host::RenderTargets& surfaces, const std::vector<const Way*>& shown) {
  if (!exact_) exact_ = std::make_unique<Way>(config_);
  if (!framebuffer_) framebuffer_ = host::makeFramebuffer();
  tyndall::Settings settings = shown.front()->frame().settings;
  settings.technique = tyndall::Technique::Exact;
  settings.debugView = tyndall::DebugView::Composite;
  exact_->begin(surfaces, shown.front()->frame(), settings);
  shown_.clear();
  for (const Way* way : shown)
    shown_.push_back(way->inscatter());
  sums_.assign(shown_.size(), ErrorSum());
  errors_.assign(shown_.size(), Errors());
  isBegun_ = true;
}

void ErrorMeter::stop() {
  isBegun_ = false;
  errors_.clear();
}

void ErrorMeter::read(GLuint texture, const tyndall::Rectangle& part, std::vector<float>& values) const {
  values.resize(3 * static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
  const GladGLContext& gl = host::gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.PixelStorei(GL_PACK_ROW_LENGTH, 0);
  gl.ReadPixels(part.x, part.y, part.width, part.height, GL_RGB, GL_FLOAT, values.data());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void ErrorMeter::step(double milliseconds) {
  if (!isRunning()) return;
  const tyndall::Rectangle part = exact_->step(milliseconds);
  std::vector<float> exact, got;
  read(exact_->inscatter(), part, exact);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    read(shown_[i], part, got);
    sums_[i].add(got.data(), exact.data(), exact.size());
    errors_[i] = sums_[i].errors();
  }
}

} // namespace viewer
