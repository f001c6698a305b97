#include "passes/Lookup.h"

#include "gl/ShaderSources.h"
#include "passes/Rows.h"

namespace tyndall::passes::lookup {

void begin(PassPlanner& planner) {
  planner.clear(Resource::LookupSteps, 0);
  planner.fillsLookup = true;
}

void addLight(LightPlanner& light, bool rowsAtHand) {
  for (int draw = 0; draw < light.draws(); ++draw) {
    light.selectDraw(draw);
    if (!rowsAtHand || light.draws() > 1) rows::plan(light);
    light.draw(Pass::LookupLight);
  }
  const Size size = light.extent.lookup;
  light.plan.marched += static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
}

void finish(const PassPlanner& planner, const Lookup& engines, const FrameTextures::Lookup& formats) {
  PassPlanner passes = planner;
  auto block = planner.plan.block<blocks::FrameBlock>(planner.frameBlock);
  block.outputMax = formats.inscatter.max;
  for (block.lookupFirst = 0; block.lookupFirst < block.lookupDepths; block.lookupFirst += LOOKUP_LAYERS) {
    passes.frameBlock = planner.plan.add(block);
    DrawOptions options;
    options.layer = block.lookupFirst;
    if ((options.output = engines.inscatter) != 0) passes.draw(Pass::LookupSums, options);
    if ((options.output = engines.transmittance) != 0) passes.draw(Pass::LookupTransmittance, options);
  }
}

} // namespace tyndall::passes::lookup

namespace tyndall {

const char* shaftsLookupSource() {
  static const std::string text = shaderSource("public/shaftsLookup.glsl");
  return text.c_str();
}

} // namespace tyndall
