#include "gl/LegacyState.h"

#include "gl/Enums.h"

namespace tyndall::gl {

namespace {

constexpr std::array<Enum, 2> kCapabilities = {ALPHA_TEST, POLYGON_STIPPLE};

// What happens to colours on their way to and from textures.
constexpr std::array<Enum, 9> kTransfer = {MAP_COLOR, RED_SCALE,  GREEN_SCALE, BLUE_SCALE, ALPHA_SCALE,
                                           RED_BIAS,  GREEN_BIAS, BLUE_BIAS,   ALPHA_BIAS};
constexpr std::array<Float, 9> kTransferDefaults = {0, 1, 1, 1, 1, 0, 0, 0, 0};

} // namespace

// Of both faces' stencils only that of the active face is asked for and set, unless a function names the face.
void LegacyState::save() {
  if (!gl_.compatibility) return;
  for (const Enum capability : kCapabilities)
    if (gl_.IsEnabled(capability)) capabilities_.push_back(capability);
  if (gl_.ActiveStencilFaceEXT) {
    if (gl_.IsEnabled(STENCIL_TEST_TWO_SIDE)) capabilities_.push_back(STENCIL_TEST_TWO_SIDE);
    gl_.GetIntegerv(ACTIVE_STENCIL_FACE, &stencilFace_);
    gl_.ActiveStencilFaceEXT(FRONT);
  }
  for (const Enum capability : capabilities_)
    gl_.Disable(capability);
  gl_.GetIntegerv(CLAMP_FRAGMENT_COLOR, &clamping_);
  if (clamping_ != FIXED_ONLY) gl_.ClampColor(CLAMP_FRAGMENT_COLOR, FIXED_ONLY);
  for (std::size_t i = 0; i < kTransfer.size(); ++i) {
    gl_.GetFloatv(kTransfer[i], &transfer_[i]);
    if (transfer_[i] != kTransferDefaults[i]) gl_.PixelTransferf(kTransfer[i], kTransferDefaults[i]);
  }
}

void LegacyState::restore() const {
  if (!gl_.compatibility) return;
  for (const Enum capability : capabilities_)
    gl_.Enable(capability);
  if (clamping_ != FIXED_ONLY) gl_.ClampColor(CLAMP_FRAGMENT_COLOR, static_cast<Enum>(clamping_));
  for (std::size_t i = 0; i < kTransfer.size(); ++i)
    if (transfer_[i] != kTransferDefaults[i]) gl_.PixelTransferf(kTransfer[i], transfer_[i]);
  if (stencilFace_ != 0) gl_.ActiveStencilFaceEXT(static_cast<Enum>(stencilFace_));
}

void LegacyState::setDefaults() const {
  if (!gl_.compatibility) return;
  for (const Enum capability : kCapabilities)
    gl_.Disable(capability);
  if (gl_.ActiveStencilFaceEXT) {
    gl_.Disable(STENCIL_TEST_TWO_SIDE);
    gl_.ActiveStencilFaceEXT(FRONT);
  }
  gl_.ClampColor(CLAMP_FRAGMENT_COLOR, FIXED_ONLY);
  for (std::size_t i = 0; i < kTransfer.size(); ++i)
    gl_.PixelTransferf(kTransfer[i], kTransferDefaults[i]);
}

} // namespace tyndall::gl
