// Frames: whatever an engine hands over, the checks answer with a status; and what they let pass makes uniform blocks,
// slices and tables of finite numbers.
#include "CheckFrame.h"
#include "FrameInput.h"
#include "Plausible.h"
#include "SampleBudget.h"
#include "optics/Ambient.h"
#include "optics/Blocks.h"
#include "optics/EngineDepth.h"
#include "optics/Jitter.h"
#include "optics/LightVolume.h"
#include "optics/LowRank.h"
#include "optics/MovedSlices.h"
#include "optics/Slices.h"
#include "plan/MapCopies.h"

namespace {

using namespace tyndall;

constexpr int kMapSize = 512; // texels per side of a shadow map

template <typename Vector>
void requireFinite(const Vector& v, const std::string& what) {
  for (int i = 0; i < v.length(); ++i)
    fuzz::require(std::isfinite(v[i]), what + " is finite");
}

void requireFinite(float number, const std::string& what) { fuzz::require(std::isfinite(number), what + " is finite"); }

void requireFinite(const blocks::FrameBlock& block) {
  for (const blocks::vec4& row : block.farPoint)
    requireFinite(row, "farPoint");
  requireFinite(block.nearStep, "nearStep");
  requireFinite(block.depthOffset, "depthOffset");
  requireFinite(block.depthScale, "depthScale");
  fuzz::require(block.skyEnd >= 0, "skyEnd is not negative");
  fuzz::require(block.visibleEnd >= 0, "visibleEnd is not negative");
  requireFinite(block.extinction, "extinction");
  requireFinite(block.depthAxis, "depthAxis");
  requireFinite(block.depthUnit, "depthUnit");
  requireFinite(block.depthZero, "depthZero");
  requireFinite(block.jitter, "jitter");
  for (int k = 0; k < block.constituentCount; ++k) {
    requireFinite(block.phaseWeight[k], "phaseWeight");
    requireFinite(block.phaseShape[k], "phaseShape");
  }
  for (int i = 0; i < block.layerCount; ++i) {
    requireFinite(block.layerUp[i], "layerUp");
    requireFinite(block.layerExtinction[i], "layerExtinction");
  }
}

void requireFinite(const blocks::AmbientBlock& block) {
  for (const blocks::vec4& row : block.ambientHarmonics)
    requireFinite(row, "ambientHarmonics");
}

void requireFinite(const blocks::LightBlock& block, LightKind kind) {
  requireFinite(block.lightColour, "lightColour");
  fuzz::require(std::abs(glm::length(block.lightDirection) - 1) < 1e-5F, "lightDirection is unit");
  fuzz::require(block.lightRange >= 0, "lightRange is not negative");
  requireFinite(block.lightPosition, "lightPosition");
  requireFinite(block.lightRange, "lightRange");
  if (kind == LightKind::Spot) { // other kinds' cones may be anything, and are not read
    requireFinite(block.outerCosine, "outerCosine");
    requireFinite(block.innerCosine, "innerCosine");
    requireFinite(block.falloffScale, "falloffScale");
  }
  requireFinite(block.boundary, "boundary");
  for (int i = 0; i < block.viewCount; ++i) {
    const blocks::MapView& view = block.shadowViews[i];
    for (int column = 0; column < 4; ++column)
      requireFinite(view.texelFromCamera[column], "texelFromCamera");
    requireFinite(view.margin, "margin");
    requireFinite(view.curveDepth, "curveDepth");
    requireFinite(view.nearDepth, "nearDepth");
    requireFinite(view.farDepth, "farDepth");
  }
}

void requireFinite(const optics::SliceTable& slices, const Settings& settings) {
  fuzz::require(slices.slices >= 1 && slices.slices <= settings.slices, "there are as many slices as asked for");
  fuzz::require(slices.texels.size() == static_cast<std::size_t>(slices.slices) * slices.rows, "the table is whole");
  for (const glm::vec4& texel : slices.texels)
    requireFinite(texel, "a slice");
  requireFinite(slices.block.epipole, "epipole");
  requireFinite(slices.block.border, "border");
  requireFinite(slices.block.slicesBegin, "slicesBegin");
  requireFinite(slices.block.sliceWidth, "sliceWidth");
  requireFinite(slices.block.rowCodeScale, "rowCodeScale");
  requireFinite(slices.block.rowCodeOffset, "rowCodeOffset");
  requireFinite(slices.block.storedScale, "storedScale");
}

void makeLight(const Frame& frame, const Light& light) {
  optics::isOutOfView(light, frame.camera);
  const optics::LightShare share = optics::shareOf(light, frame.camera, frame.medium);
  fuzz::require(share.area >= 0 && share.area <= 1 && share.brightness >= 0, "a light has a share of the image");
  fuzz::require(optics::brightestInscatter(frame, light) >= 0, "a light's inscatter has a bound");
  const int size = light.shadow.texture != 0 ? kMapSize : 0;
  const blocks::LightBlock block = optics::lightBlock(frame, light, size, size, light.curves.texture != 0 ? 64 : 0);
  requireFinite(block, light.kind);
  if (frame.settings.technique == Technique::Exact) return;
  const optics::SliceTable slices = optics::makeSlices(frame, light, size, size);
  requireFinite(slices, frame.settings);
  optics::movedSlices(frame, light, block, slices);
  if (frame.settings.technique == Technique::LowRank) optics::makeLowRank(frame, light, slices);
}

/// As Effect::State takes a frame: without its jitter, a cube's faces as views.
Frame prepared(const Frame& given) {
  Frame frame = withCubeViews(given);
  frame.camera = optics::steady(given.camera, given.viewport);
  return frame;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Numbers numbers(data, size);
  const Frame given = fuzz::frameOf(numbers);
  if (const Status status = checkValues(given); !status) {
    fuzz::require(!status.message.empty() && status.message.find('\n') == std::string::npos, "a message is one line");
    return 0;
  }
  std::vector<std::string> warnings;
  const Status plausible = checkPlausible(given, warnings);
  fuzz::require(plausible || !plausible.message.empty(), "what is refused has a message");
  if (!plausible) return 0;
  const Frame frame = prepared(given);
  requireFinite(optics::frameBlock(frame, {frame.depth.multisampled ? 4 : 1, 1e30F, 1e30F, 1e30F, 1e-6F}));
  requireFinite(optics::ambientBlock(frame, {0, 0}));
  fuzz::require(optics::brightestAmbient(frame) >= 0, "brightestAmbient is no NaN");
  dealSamples(frame, std::vector<bool>(frame.lights.size(), true));
  optics::isMonochrome(frame.medium);
  for (const Light& light : frame.lights)
    makeLight(frame, light);
  return 0;
}
