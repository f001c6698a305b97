#include "optics/EngineDepth.h"

#include "optics/Matrices.h"

#include <cmath>

namespace tyndall::optics {

namespace {

// Where axial distance grows to: with clip w, or along the view's -z if that is 1 everywhere.
glm::vec3 viewAxis(const Camera& camera, bool orthographic) {
  const glm::dmat4 view = toGlm(camera.viewFromWorld);
  const glm::dmat4 rows = glm::transpose(orthographic ? view : toGlm(camera.clipFromView) * view);
  return directionOf(orthographic ? -glm::dvec3(rows[2]) : glm::dvec3(rows[3]));
}

void setMeasure(blocks::FrameBlock& block, const SceneDepth& depth) {
  const DepthScale& scale = depth.scale;
  const bool logarithmic = depth.encoding == DepthEncoding::Logarithmic;
  block.depthUnit = static_cast<float>(logarithmic ? std::log2(1 + scale.constant * scale.farDistance) : scale.unit);
  block.depthZero = static_cast<float>(logarithmic ? 1 / scale.constant : scale.offset);
}

} // namespace

Rectangle depthRectangle(const Frame& frame) {
  const Rectangle& given = frame.depth.rectangle;
  const bool isGiven = given.x != 0 || given.y != 0 || given.width != 0 || given.height != 0;
  return isGiven ? given : frame.viewport;
}

bool isPlain(const Frame& frame) {
  const Rectangle shown = depthRectangle(frame);
  return frame.depth.encoding == DepthEncoding::Window && frame.depth.layer < 0 && shown.x == 0 && shown.y == 0 &&
         shown.width == frame.viewport.width && shown.height == frame.viewport.height;
}

int sampleShift(const Frame& frame, int samples) {
  int shift = 0;
  if (frame.depth.multisampled && !isPlain(frame))
    while (1 << shift < samples)
      ++shift;
  return shift;
}

void setEngineDepth(blocks::FrameBlock& block, const Frame& frame, float rounding) {
  const SceneDepth& depth = frame.depth;
  const Rectangle shown = depthRectangle(frame);
  block.isMultisampled = depth.multisampled && isPlain(frame) ? 1 : 0;
  block.depthSampleShift = sampleShift(frame, block.depthSampleCount);
  block.depthSample = -1;
  block.depthFirst = {shown.x, shown.y};
  block.depthSize = {shown.width, shown.height};
  block.depthLayer = depth.layer;
  if (depth.encoding == DepthEncoding::Window) return;
  block.depthEncoding = static_cast<int>(depth.encoding);
  block.depthAxis = viewAxis(frame.camera, block.isOrthographic != 0);
  block.skyRounding = rounding;
  const bool orthographic = block.isOrthographic != 0; // what passes read is 1 - t, else t
  block.depthOffset = orthographic ? 1 : 0;
  block.depthScale = orthographic ? -1 : 1;
  setMeasure(block, depth);
}

} // namespace tyndall::optics
