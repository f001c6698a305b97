#include "passes/Samples.h"

namespace tyndall::passes::samples {

namespace {

// Each sample's depth takes the place of the pixel's; of each comes its share of the light. Transmittance, as a mean,
// and what is in the target come first, so that all samples are added.
void planMean(LightPlanner& light, Pass pass, const DrawOptions& options) {
  const int samples = light.paths.depthSamples, frameBlock = light.frameBlock, lightBlock = light.lightBlock;
  const gl::Uint depth = light.board[Resource::SceneDepth];
  const auto share = 1 / static_cast<float>(samples);
  auto lamp = light.plan.block<blocks::LightBlock>(lightBlock);
  auto camera = light.plan.block<blocks::FrameBlock>(frameBlock);
  lamp.lightColour *= share;
  camera.lightCeiling *= share;
  light.lightBlock = light.plan.add(lamp);
  DrawOptions adding = options;
  adding.adds = true;
  for (camera.depthSample = 0; camera.depthSample < samples; ++camera.depthSample) {
    light.frameBlock = light.plan.add(camera);
    light.draw(Pass::SampleDepth, {light.depthSource(), options.stencil});
    light.board[Resource::SceneDepth] = light.board[Resource::SampleDepth];
    light.draw(pass, adding);
    adding.counting = {}; // of pixels, not of samples
  }
  light.frameBlock = frameBlock;
  light.lightBlock = lightBlock;
  light.board[Resource::SceneDepth] = depth;
}

} // namespace

void drawLight(LightPlanner& light, Pass pass, const DrawOptions& options) {
  if (!light.extent.sampledDepth) return light.drawLight(pass, options);
  DrawOptions off = options, on = options;
  off.stencil = offEdges(options.stencil);
  on.stencil = onEdges(options.stencil);
  light.drawLight(pass, off);
  planMean(light, pass, on);
}

} // namespace tyndall::passes::samples
