#include "baselines/SharedPhysics.h"

#include "optics/Blocks.h"
#include "optics/Matrices.h"
#include "optics/Slices.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

namespace bench {

namespace {

template <class Block>
Bytes bytesOf(const Block& block) {
  Bytes bytes(sizeof block);
  std::memcpy(bytes.data(), &block, sizeof block);
  return bytes;
}

} // namespace

Bytes frameBlock(const tyndall::Frame& frame, float maxRadiance) {
  tyndall::optics::FrameSizes sizes;
  sizes.lightCeiling = maxRadiance;
  return bytesOf(tyndall::optics::frameBlock(frame, sizes));
}

Bytes lightBlock(const tyndall::Frame& frame, const tyndall::Light& light, int shadowWidth, int shadowHeight) {
  return bytesOf(tyndall::optics::lightBlock(frame, light, shadowWidth, shadowHeight));
}

glm::dmat4 cameraFromTexel(const tyndall::Frame& frame, const tyndall::Light& light, int shadowWidth,
                           int shadowHeight) {
  return glm::inverse(
      glm::dmat4(tyndall::optics::lightBlock(frame, light, shadowWidth, shadowHeight).shadowViews[0].texelFromCamera));
}

bool isReversedMap(const tyndall::Frame& frame, const tyndall::Light& light) {
  return tyndall::optics::lightBlock(frame, light, 1, 1).shadowViews[0].depthSign < 0;
}

glm::dmat4 clipFromCamera(const tyndall::Frame& frame) {
  const glm::dmat4 clipFromWorld =
      tyndall::optics::toGlm(frame.camera.clipFromView) * tyndall::optics::toGlm(frame.camera.viewFromWorld);
  return glm::translate(clipFromWorld, tyndall::optics::cameraOrigin(frame.camera));
}

SliceShape sliceShape(const tyndall::Frame& frame, const tyndall::Light& light, int shadowWidth, int shadowHeight) {
  const tyndall::optics::SliceTable table = tyndall::optics::makeSlices(frame, light, shadowWidth, shadowHeight);
  SliceShape shape{table.slices, (table.longestRow + 63) / 64 * 64, 0, table.regularSamples};
  int strips = 0, sum = 0;
  for (int first = 0; first < table.slices; first += 64, ++strips) {
    float most = 0;
    for (int i = first; i < std::min(first + 64, table.slices); ++i)
      most = std::max(most, table.texels[static_cast<std::size_t>(3 * table.slices + i)].x); // texels of the first view
    sum += static_cast<int>(most);
  }
  shape.drawnTexels = sum / std::max(strips, 1);
  return shape;
}

bool isMonochrome(const tyndall::Medium& medium) { return tyndall::optics::isMonochrome(medium); }

} // namespace bench
