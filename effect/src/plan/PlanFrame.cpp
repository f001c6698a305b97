#include "plan/PlanFrame.h"

#include "DebugViews.h"
#include "SampleBudget.h"
#include "optics/Ambient.h"
#include "optics/Blocks.h"
#include "optics/EngineDepth.h"
#include "optics/EyeLight.h"
#include "optics/HeightFog.h"
#include "optics/Jitter.h"
#include "optics/LightVolume.h"
#include "passes/Epipolar.h"
#include "passes/Lookup.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {

namespace {

bool hasDebugView(const Frame& frame) { return frame.settings.debugView != DebugView::Composite; }
bool showsSlices(const Frame& frame) { return rowOf(frame.settings.debugView)->shown != Shown::Picture; }
bool usesSlices(const Frame& frame) { return frame.settings.technique != Technique::Exact; }
bool scatters(const Frame& frame) {
  return optics::scatteringOf(frame.medium) != glm::dvec3(0) || optics::isFogLit(frame);
}
bool changesColour(const Frame& frame) {
  const auto isThere = [](const glm::dvec3& sigma) { return sigma != glm::dvec3(0); };
  if (optics::isFogLit(frame) || optics::fogDimsBackground(frame)) return true;
  return isThere(frame.medium.dimsBackground ? optics::extinctionOf(frame.medium) : optics::scatteringOf(frame.medium));
}

// Why a light has nothing to add; empty if it has.
std::string reasonToSkip(const Frame& frame, const Light& light, bool wantsInscatter, bool anyCamera) {
  if (light.colour == Rgb{0, 0, 0}) return "the light is black";
  if (light.scatteringScale == 0) return "the light's scatteringScale is 0";
  if (!scatters(frame)) return "the medium does not scatter";
  if (!wantsInscatter) return "only the transmittance is wanted";
  if (!anyCamera && optics::isOutOfView(light, optics::jittered(frame.camera, frame.viewport)))
    return "the light's volume is outside the view";
  return {};
}

// The same of the light of the surroundings, which most frames have none of.
std::string reasonToSkipAmbient(const Frame& frame, bool wantsInscatter) {
  if (!optics::isLit(frame.ambient)) return "no light comes from the surroundings";
  if (!scatters(frame)) return "the medium does not scatter";
  return wantsInscatter ? "" : "only the transmittance is wanted";
}

// Parts of the inscatter that are drawn one after the other: lights, and the surroundings.
std::size_t partsOf(const Frame& frame, bool anyCamera) {
  const auto lights = std::count_if(frame.lights.begin(), frame.lights.end(), [&](const Light& light) {
    return reasonToSkip(frame, light, true, anyCamera).empty();
  });
  return static_cast<std::size_t>(lights) + (reasonToSkipAmbient(frame, true).empty() ? 1 : 0);
}

// True if the light may be capped though the sum of all is not: one of several parts adds more than its share of what
// the formats hold, so that they are to be added up in a texture of our own first.
bool sumIsCapped(const Frame& frame, float most, std::size_t parts) {
  if (parts < 2 || most >= kLargestFloat) return false;
  const double share = static_cast<double>(most) / static_cast<double>(parts);
  return optics::brightestAmbient(frame) > share ||
         std::any_of(frame.lights.begin(), frame.lights.end(),
                     [&](const Light& light) { return optics::brightestInscatter(frame, light) > share; });
}

// Which programs its layers take.
int layersFor(const Medium& medium, const Light& light) {
  if (!optics::isLayered(medium)) return kNoLayers;
  if (medium.layers.size() > 1 || light.boundary.enabled) return kAnyLayers;
  const bool isSun = light.kind == LightKind::Directional;
  return isSun && optics::extinctionOf(medium, optics::kEverywhere) == glm::dvec3(0) ? kOnlyLayer : kOneLayer;
}

// The shader variant of a light.
LightVariant variantOf(const Frame& frame, const Light& light, bool dualSource, bool direct) {
  LightVariant variant;
  variant.dualSource = dualSource;
  variant.layers = layersFor(frame.medium, light);
  variant.eyeCurves = optics::isDimmedBeforeEye(frame);
  variant.fog = optics::isFogLit(frame);
  variant.monochrome = optics::isMonochrome(frame.medium);
  variant.composite = direct;
  variant.lightKind = static_cast<int>(light.kind);
  variant.glass = light.glass.colour != 0;
  if (light.shadow.texture == 0) return served(variant);
  variant.shadowViews = light.shadow.views.size() > 1 ? 2 : 1;
  variant.shadowArray = light.shadow.array;
  variant.curves = light.curves.texture != 0;
  variant.bilinear = frame.settings.shadowFilter == ShadowFilter::Bilinear;
  return served(variant);
}

std::string nameOf(const Frame& frame, std::size_t light) {
  return (usesSlices(frame) ? "light " : "exact light ") + std::to_string(light);
}

float partOf(float most, std::size_t parts) { return most / static_cast<float>(std::max<std::size_t>(parts, 1)); }

} // namespace

FramePlanner::FramePlanner(const PlanInputs& inputs, Allocator& allocator, PlannedFrame& out)
    : in_(inputs), frame_(inputs.frame), allocator_(allocator), out_(out),
      passes_(allocator, out.plan, inputs.targets, inputs.tuning), colour_{frame_.colour, frame_.colourLayer},
      inscatter_{frame_.output.inscatter, frame_.output.layer},
      transmittance_{frame_.output.transmittance, frame_.output.layer} {
  passes_.extent.width = frame_.viewport.width;
  passes_.extent.height = frame_.viewport.height;
  passes_.extent.wideColour = inputs.textures.colour.max >= kLargestFloat;
  passes_.extent.engines = {inputs.textures.colour.format, inputs.textures.inscatter.format,
                            inputs.textures.transmittance.format};
  passes_.variant.dualSource = inputs.tuning.compositing == Compositing::DualSource;
  passes_.variant.layers = optics::isLayered(frame_.medium) ? kAnyLayers : kNoLayers;
  passes_.variant.eyeCurves = optics::isDimmedBeforeEye(frame_);
  passes_.variant.fog = optics::isFogLit(frame_);
  passes_.board[Resource::EyeCurves] = frame_.eyeCurves.curves.texture;
  const FrameTextures::Lookup& lookup = inputs.textures.lookup;
  passes_.extent.lookup = {lookup.width, lookup.height};
  passes_.extent.lookupDepths = lookup.depths;
  passes_.extent.sampledDepth = frame_.depth.multisampled;
  passes_.extent.sampleShift = optics::sampleShift(frame_, inputs.textures.depthSamples);
  passes_.paths.depthSamples = inputs.textures.depthSamples;
  passes_.paces = inputs.paces;
  out.plan.bandMilliseconds = inputs.tuning.bandMilliseconds;
}

void FramePlanner::plan() {
  if (!changesColour(frame_))
    out_.plan.skip("composite", frame_.medium.dimsBackground ? "the medium neither scatters nor absorbs"
                                                             : "the medium does not scatter, and dims nothing");
  const bool reuses =
      in_.eye && changesColour(frame_) && (!hasDebugView(frame_) || frame_.settings.debugView == DebugView::Redrawn);
  makeStandIns(changesColour(frame_) || hasDebugView(frame_));
  if (reuses)
    planWithEye();
  else
    planInFull();
  copyBack();
}

void FramePlanner::planWithEye() {
  passes_.eyeTargets = &in_.eye->targets;
  begin(keptDestination());
  const std::vector<DrawnLight> drawn = lightsToDraw(frame_, passes_.destination);
  planReused(drawn, planRedraw(*in_.eye, keyOf(drawn), frame_));
}

// As the papers do: each light's inscatter, and with the first the transmittance, into colour at once or by a
// composite.
void FramePlanner::planInFull() {
  const Output& output = frame_.output;
  const bool looksUp = in_.textures.lookup.depths > 0;
  const bool shows =
      changesColour(frame_) || hasDebugView(frame_) || output.inscatter != 0 || output.transmittance != 0;
  if (!shows && !looksUp) return;
  begin(chooseDestination(changesColour(frame_)));
  if (shows) planDepth();
  if (showsSlices(frame_)) passes_.clear(Resource::DebugView, 0);
  beginLookup();
  if (shows) planLights(frame_, passes_.destination, lightsToDraw(frame_, passes_.destination));
  finishLookup();
  if (passes_.destination.copies) copyToOutput(passes_.destination.inscatter, inscatter_.texture);
  if (!passes_.destination.composite) return;
  if (frame_.settings.debugView == DebugView::Redrawn) showRedrawn(Redraw::All, {});
  planPicture();
}

Destination FramePlanner::chooseDestination(bool changes) {
  const Output& output = frame_.output;
  const std::size_t parts = partsOf(frame_, in_.ahead);
  const float most =
      output.inscatter ? in_.textures.inscatter.max : in_.textures.colour.max; // of where they are added up
  const bool apart = in_.sumsApart.value_or(sumIsCapped(frame_, most, parts));
  Destination to;
  to.colour = colour_.texture;
  to.engines = engines();
  to.ceiling = partOf(most, parts);
  // Spread and what dims before the eye take several times the time: no programs for them draw into colour at once.
  const bool spreads =
      frame_.settings.technique == Technique::Epipolar && std::isfinite(frame_.settings.spreadThreshold);
  const bool blends = passes_.variant.dualSource;
  if (output.inscatter == 0 && output.transmittance == 0 && !hasDebugView(frame_) && !apart && !spreads &&
      !optics::isDimmedBeforeEye(frame_) && blends)
    return to;
  to.inscatter = apart ? 0 : inscatter_.texture;
  to.transmittance = transmittance_.texture;
  to.composite = hasDebugView(frame_) || (changes && frame_.colour != 0);
  to.copies = apart && output.inscatter != 0;
  if (!to.inscatter && (to.composite || to.copies || frame_.lookup.inscatter != 0)) {
    to.inscatter = passes_.textureOf(Resource::Inscatter);
    to.ceiling = partOf(kLargestFloat, parts);
  }
  if (!to.transmittance && to.composite) to.transmittance = passes_.textureOf(Resource::Transmittance);
  return to;
}

// The engine's texture where passes can read it, or what is made of it.
void FramePlanner::planSamples() {
  const SceneDepth& depth = frame_.depth;
  Board& board = passes_.board;
  if (optics::isPlain(frame_)) {
    board[depth.multisampled ? Resource::SceneDepthSamples : Resource::SceneDepthSideBySide] = depth.texture;
    return;
  }
  board[Resource::EngineDepth] = depth.texture;
  DrawOptions source;
  source.options = {{"DEPTH_SOURCE", (depth.layer < 0 ? 0 : 1) + (depth.multisampled ? 2 : 0)}};
  passes_.draw(Pass::PlainDepth, source);
  board[Resource::SceneDepthSideBySide] = board[Resource::PlainDepth];
}

// Slices take one depth a pixel; of a multisampled one, where a pixel's samples show several surfaces, it is marked.
void FramePlanner::planDepth() {
  planSamples();
  Board& board = passes_.board;
  board[Resource::SceneDepth] = board[Resource::SceneDepthSideBySide];
  if (!frame_.depth.multisampled || !usesSlices(frame_)) return;
  passes_.draw(Pass::OneDepth, {passes_.samplesOfDepth()});
  board[Resource::SceneDepth] = board[Resource::OneDepth];
  DrawOptions marking{{}, kMarkEdges};
  marking.blend = Blend::Add;
  passes_.clearStencil(Stencil::kAll);
  passes_.draw(Pass::Edges, marking);
}

void FramePlanner::begin(const Destination& destination) {
  passes_.destination = destination;
  const FrameTextures::Lookup& lookup = in_.textures.lookup;
  passes_.frameBlock = out_.plan.add(optics::frameBlock(frame_, {in_.textures.depthSamples,
                                                                 destination.ceiling,
                                                                 in_.textures.colour.max,
                                                                 in_.textures.inscatter.max,
                                                                 in_.textures.depthRounding,
                                                                 {lookup.width, lookup.height, lookup.depths},
                                                                 in_.textures.eyeCurves}));
}

std::vector<DrawnLight> FramePlanner::lightsToDraw(const Frame& frame, const Destination& destination) {
  const bool direct = destination.direct();
  std::vector<bool> drawn;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const std::string reason = reasonToSkip(frame, frame.lights[i], direct || destination.inscatter != 0, in_.ahead);
    drawn.push_back(reason.empty());
    if (!reason.empty()) out_.plan.skip(nameOf(frame, i), reason);
  }
  const std::vector<Settings> settings = dealSamples(frame, drawn);
  std::vector<DrawnLight> lights;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const FrameTextures::Shadow& map = in_.textures.shadows[i];
    if (drawn[i])
      lights.push_back({i, nameOf(frame, i), settings[i],
                        optics::lightBlock(frame, frame.lights[i], map.width, map.height, map.curvesSize), map.copies,
                        variantOf(frame, frame.lights[i], passes_.variant.dualSource, direct)});
  }
  return lights;
}

void FramePlanner::beginLookup() {
  if (in_.textures.lookup.depths == 0) return;
  const Size steps = rowOf(Resource::LookupSteps).size(passes_.extent);
  if (std::max(steps.width, steps.height) > in_.limits.textureSize)
    return allocator_.fail(
        {StatusCode::InvalidFrame, "Frame::lookup's layers need a texture of " + std::to_string(steps.width) + " x " +
                                       std::to_string(steps.height) + ": this context has none so large"});
  out_.fillsLookup = true;
  if (frame_.lookup.inscatter != 0) passes::lookup::begin(passes_);
}

void FramePlanner::finishLookup() {
  if (!out_.fillsLookup) return;
  passes_.fillsLookup = false;
  passes::lookup::finish(passes_, frame_.lookup, in_.textures.lookup);
}

AmbientKey FramePlanner::ambientKey() const {
  if (!reasonToSkipAmbient(frame_, true).empty()) return {};
  return {optics::ambientBlock(frame_, in_.textures.occlusion), frame_.ambient.occlusion};
}

// What comes first, with the transmittance: the light of the surroundings or, where fog before the eye dims the picture
// behind, nothing else; the lights are added to it. False if there is neither.
bool FramePlanner::planAmbient(const PassPlanner& planner) {
  const Destination& to = planner.destination;
  const std::string reason = reasonToSkipAmbient(frame_, to.direct() || to.inscatter != 0);
  if (optics::isLit(frame_.ambient) && !reason.empty()) out_.plan.skip(rowOf(Pass::Ambient).name, reason);
  PassPlanner passes = planner;
  passes.firstLight = true;
  if (!reason.empty()) {
    if (!optics::fogDimsBackground(frame_) || to.transmittance == 0) return false;
    passes.draw(Pass::Transmittance);
    return true;
  }
  passes.variant.layers = layersFor(frame_.medium, {});
  passes.variant.composite = to.direct();
  passes.epipolarBlock = out_.plan.add(optics::ambientBlock(frame_, in_.textures.occlusion));
  passes.board[Resource::Occlusion] = frame_.ambient.occlusion.texture;
  passes.draw(Pass::Ambient);
  if (passes.fillsLookup) passes.draw(Pass::LookupAmbient);
  return true;
}

void FramePlanner::planLights(const Frame& frame, const Destination& destination,
                              const std::vector<DrawnLight>& lights) {
  PassPlanner passes = passes_;
  passes.destination = destination;
  const bool ambient = planAmbient(passes);
  Frame lit = frame; // for one light at a time
  for (const DrawnLight& drawn : lights) {
    lit.settings = drawn.settings;
    const bool isFirst = &drawn == &lights.front();
    passes.firstLight = isFirst && !ambient;
    LightPlanner light(passes, lit, drawn, in_.textures, in_.limits);
    light.copyMaps();
    if (!usesSlices(frame)) {
      out_.plan.marched += light.pixels();
      light.drawLight(Pass::Exact, drawn.name, {});
      continue;
    }
    light.makeSlices();
    passes::epipolar::plan(light, isFirst ? frame.settings.debugView : DebugView::Composite);
  }
  if (ambient || (!lights.empty() && !in_.ahead)) return;
  passes.firstLight = true;
  passes.variant.composite = destination.direct();
  passes.draw(Pass::Transmittance);
}

// What the engine's colour receives: both textures blended into it, or a debug view.
void FramePlanner::planPicture() {
  const Destination& from = passes_.destination;
  const DebugView view = frame_.settings.debugView;
  Board& board = passes_.board;
  board[Resource::Inscatter] = from.inscatter;
  board[Resource::Transmittance] = from.transmittance;
  if (!hasDebugView(frame_)) return planComposite();
  if (view == DebugView::Inputs) return planInputs();
  board[Resource::Image] = view == DebugView::Transmittance                    ? from.transmittance
                           : showsSlices(frame_) || view == DebugView::Redrawn ? board[Resource::DebugView]
                                                                               : from.inscatter;
  if (view == DebugView::Difference) {
    planDifference();
    passes_.draw(Pass::DebugDifference);
  } else if (view == DebugView::NodeVisits) {
    planMean(board[Resource::DebugView]);
    out_.visits = board[Resource::DebugMean];
    board[Resource::Image] = board[Resource::DebugView];
    passes_.draw(Pass::DebugVisits);
  } else {
    passes_.draw(Pass::DebugImage);
  }
}

void FramePlanner::planComposite() {
  if (passes_.variant.dualSource) return passes_.draw(Pass::Composite);
  passes_.board[Resource::Image] = colour_.texture;
  if (colour_.layer < 0)
    passes_.draw(Pass::CopyColour);
  else
    copyColourLayer();
  passes_.draw(Pass::CompositeOfCopy);
}

// Exact's inscatter, and its mean.
void FramePlanner::planDifference() {
  Frame exact = frame_;
  exact.settings.technique = Technique::Exact;
  Destination to;
  to.inscatter = passes_.board[Resource::DebugExact] = passes_.textureOf(Resource::DebugExact);
  planLights(exact, to, lightsToDraw(exact, to));
  planMean(to.inscatter);
}

void FramePlanner::planMean(gl::Uint image) {
  passes_.board[Resource::Image] = image;
  passes_.draw(Pass::DebugRowMeans);
  passes_.draw(Pass::DebugMean);
}

// A light with its map, which is not to be drawn.
LightPlanner FramePlanner::mapOf(std::size_t light) {
  const FrameTextures::Shadow& map = in_.textures.shadows[light];
  PassPlanner passes = passes_;
  passes.frameBlock =
      out_.plan.add(optics::frameBlock(frame_, {in_.textures.depthSamples, 0, 0, 0, in_.textures.depthRounding}));
  const DrawnLight drawn{light,           nameOf(frame_, light),
                         frame_.settings, optics::lightBlock(frame_, frame_.lights[light], map.width, map.height),
                         map.copies,      variantOf(frame_, frame_.lights[light], passes_.variant.dualSource, false)};
  LightPlanner planner{passes, frame_, drawn, in_.textures, in_.limits};
  planner.copyMaps();
  return planner;
}

// Of the first light that has a map.
void FramePlanner::planInputs() {
  const auto& lights = frame_.lights;
  const auto mapped = std::find_if(lights.begin(), lights.end(), [](const Light& l) { return l.shadow.texture != 0; });
  if (mapped == lights.end()) return passes_.draw(Pass::DebugInputs);
  mapOf(static_cast<std::size_t>(mapped - lights.begin())).draw(Pass::DebugInputs);
}

void FramePlanner::planCheck() {
  planSamples();
  for (std::size_t i = 0; i < frame_.lights.size(); ++i) {
    if (frame_.lights[i].shadow.texture == 0) continue;
    LightPlanner light = mapOf(i);
    DrawOptions options;
    options.viewport = Viewport{0, static_cast<int>(2 * CHECK_HEIGHT * i), CHECK_WIDTH, 2 * CHECK_HEIGHT};
    light.draw(Pass::CheckInputs, options);
    out_.checks = light.board[Resource::InputChecks];
    out_.checkedLights.push_back(i);
  }
}

void FramePlanner::copyToOutput(gl::Uint from, gl::Uint output) {
  if (output == 0) return;
  passes_.board[Resource::Image] = from;
  DrawOptions options;
  options.output = output;
  passes_.draw(Pass::CopyToOutput, options);
}

// What a frame with Frame::reuse drew: all, or what its mask holds.
void FramePlanner::showRedrawn(Redraw picture, const Mask& mask) {
  passes_.clear(Resource::DebugView, picture == Redraw::All ? 1 : 0);
  if (picture == Redraw::Part) drawMasked(Pass::DebugRedrawn, mask);
}

} // namespace tyndall
