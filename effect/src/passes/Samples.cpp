#include "passes/Samples.h"

#include <algorithm>

namespace tyndall::passes::samples {

namespace {

// Each sample's depth takes the place of the pixel's; of each comes its share of the light. Transmittance, as a mean,
// and what is in the target come first, so that all samples are added.
void planMean(LightPlanner& light, Pass pass, DrawOptions options) {
  const int samples = light.paths.depthSamples, frameBlock = light.frameBlock, lightBlock = light.lightBlock;
  const gl::Uint depth = light.board[Resource::SceneDepth];
  const auto share = 1 / static_cast<float>(samples);
  auto lamp = light.plan.block<blocks::LightBlock>(lightBlock);
  auto camera = light.plan.block<blocks::FrameBlock>(frameBlock);
  lamp.lightColour *= share;
  camera.lightCeiling *= share;
  light.lightBlock = light.plan.add(lamp);
  options.blend = Blend::Add;
  for (camera.depthSample = 0; camera.depthSample < samples; ++camera.depthSample) {
    light.frameBlock = light.plan.add(camera);
    light.draw(Pass::SampleDepth, {light.samplesOfDepth(), options.stencil});
    light.board[Resource::SceneDepth] = light.board[Resource::SampleDepth];
    light.draw(pass, options);
    options.counting = {}; // of pixels, not of samples
  }
  light.frameBlock = frameBlock;
  light.lightBlock = lightBlock;
  light.board[Resource::SceneDepth] = depth;
}

// What is left of pixels at edges comes to a few rays, whose light counts by their shares.
void planRays(LightPlanner& light, Pass pass, DrawOptions options) {
  const int frameBlock = light.frameBlock;
  const Board board = light.board;
  const Destination destination = light.destination;
  auto sampled = light.plan.block<blocks::FrameBlock>(frameBlock), marched = sampled;
  marched.isMultisampled = marched.depthSampleShift = 0;
  marched.depthSampleCount = 1;
  DrawOptions ray{{}, options.stencil};
  ray.blend = Blend::Alpha;
  options.blend = Blend::AddByAlpha;
  for (sampled.depthSample = 0; sampled.depthSample < std::min(EDGE_RAYS, sampled.depthSampleCount);
       ++sampled.depthSample) {
    light.board = board;
    light.frameBlock = light.plan.add(sampled);
    light.draw(Pass::EdgeRay, ray);
    light.frameBlock = light.plan.add(marched);
    light.board[Resource::SceneDepth] = light.board[Resource::SceneDepthSideBySide] =
        light.board[Resource::SampleDepth];
    light.board[Resource::SceneDepthSamples] = 0;
    light.destination = {};
    light.destination.inscatter = light.board[Resource::EdgeInscatter];
    light.draw(pass, options);
    light.destination = destination;
    options.counting = {}; // of pixels, not of rays
  }
  light.frameBlock = frameBlock;
  light.board = board;
}

// As ever but at edges, which are drawn in a way of their own.
void drawApart(LightPlanner& light, Pass pass, const DrawOptions& options,
               void (*planEdges)(LightPlanner&, Pass, DrawOptions)) {
  if (!light.extent.sampledDepth) return light.drawLight(pass, options);
  DrawOptions off = options, on = options;
  off.stencil = offEdges(options.stencil);
  on.stencil = onEdges(options.stencil);
  light.drawLight(pass, off);
  planEdges(light, pass, on);
}

} // namespace

void drawLight(LightPlanner& light, Pass pass, const DrawOptions& options) {
  drawApart(light, pass, options, planMean);
}

void unwarpEdges(LightPlanner& light) {
  light.draw(Pass::UnwarpEdges, {{}, onEdges({})});
  DrawOptions marking{{}, onEdges(kMarkServed)};
  marking.blend = Blend::Add;
  light.draw(Pass::ServedEdges, marking);
}

void fixUp(LightPlanner& light, Pass pass, const DrawOptions& options) { drawApart(light, pass, options, planRays); }

void addEdges(LightPlanner& light) {
  light.selectDraw(0);
  const bool direct = light.firstLight && light.destination.direct();
  light.draw(direct ? Pass::EdgeComposite : Pass::EdgeLight, {{}, onEdges({})});
}

} // namespace tyndall::passes::samples
