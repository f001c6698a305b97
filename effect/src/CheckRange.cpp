// Shaders have 32-bit floats: what a frame comes to relative to the eye must be finite as such.
#include "CheckValues.h"
#include "optics/Blocks.h"
#include "optics/Jitter.h"
#include "optics/MapCopy.h"

#include <cmath>
#include <initializer_list>

namespace tyndall {

namespace {

constexpr const char* kRule = "must be finite as 32-bit floats, relative to the eye";

template <typename Vector>
bool allFinite(std::initializer_list<Vector> vectors) {
  for (const Vector& v : vectors)
    for (int i = 0; i < Vector::length(); ++i)
      if (!std::isfinite(v[i])) return false;
  return true;
}

Status tooFar(const std::string& field) { return invalid(field, "", kRule); }

Status checkFrameBlock(const blocks::FrameBlock& block) {
  if (!allFinite({block.farPoint[0], block.farPoint[1], block.farPoint[2], block.nearStep})) return tooFar("camera");
  if (!std::isfinite(block.depthUnit) || !std::isfinite(block.depthZero)) return tooFar("depth.scale");
  return {};
}

bool isFinite(const blocks::MapView& view) {
  const blocks::mat4& m = view.texelFromCamera;
  return allFinite({m[0], m[1], m[2], m[3], view.margin, view.curveDepth});
}

bool isFinite(const blocks::CopyBlock& copy) {
  return allFinite({copy.copiedRay[0], copy.copiedRay[1], copy.copiedRay[2], copy.copiedDepth}) &&
         std::isfinite(copy.copiedUnit) && std::isfinite(copy.copiedOffset) && std::isfinite(copy.copiedFar);
}

/// The light has its cube's faces as views; textures may be as large as they ever are.
Status checkLightBlock(const Frame& frame, const Light& light, const std::string& field) {
  const blocks::LightBlock block =
      optics::lightBlock(frame, light, kMaxImageSize, kMaxImageSize, light.curves.texture != 0 ? 1 : 0);
  if (!allFinite({block.boundary})) return tooFar(field + "boundary");
  const ShadowMap& shadow = light.shadow;
  const bool isCopied = shadow.cube.enabled || shadow.encoding != DepthEncoding::Window;
  for (int i = 0; i < block.viewCount; ++i) {
    const bool fits = isFinite(block.shadowViews[i]) && (!isCopied || isFinite(optics::copyBlock(light, i, {}, 0)));
    if (!fits && shadow.cube.enabled) return tooFar(field + "shadow.cube");
    if (!fits) return tooFar(field + "shadow.views[" + std::to_string(i) + "]");
  }
  return {};
}

} // namespace

Status checkRange(const Frame& frame) {
  Frame seen; // what is planned sees the camera without its jitter
  seen.viewport = frame.viewport;
  seen.camera = optics::steady(frame.camera, frame.viewport);
  seen.depth = frame.depth;
  seen.medium = frame.medium;
  if (Status s = checkFrameBlock(optics::frameBlock(seen, {})); !s) return s;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const Light& light = frame.lights[i];
    const std::string field = "lights[" + std::to_string(i) + "].";
    if (light.shadow.texture == 0 || !light.shadow.cube.enabled) {
      if (Status s = checkLightBlock(seen, light, field); !s) return s;
      continue;
    }
    Light faces = light;
    faces.shadow.views = optics::cubeViews(light);
    if (Status s = checkLightBlock(seen, faces, field); !s) return s;
  }
  return {};
}

} // namespace tyndall
