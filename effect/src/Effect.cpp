#include "EffectState.h"
#include "Plausible.h"
#include "gl/StateGuard.h"
#include "optics/Ambient.h"
#include "optics/Jitter.h"
#include "plan/MapCopies.h"

#include <algorithm>
#include <utility>

// The data flow of a frame. Boxes are passes (plan/Passes.cpp has a row for each, glsl/passes their shaders), the rest
// are textures (plan/Resources.cpp).
//
//   Technique exact, one draw per light:
//
//   scene depth --+
//   shadow map ---+--> [exact] one draw per light --+--> blended into colour            (no Output asked for)
//   glass map ----+                                 |
//                                                   +--> inscatter, transmittance --> [composite] --> colour
//
//   Scene depth is the engine's texture, or what [plain depth] makes of it: a part, another size, a layer, another
//   encoding.
//
//   Light of the surroundings (Frame::ambient) comes before all lights, with the transmittance: [ambient] --> the same.
//   A look-up (Frame::lookup) is filled by the lights' rows: passes/Lookup.h has the picture.
//
//   A debug view (Settings::debugView) takes the place of [composite]:
//
//   inscatter, transmittance, or what passes/DebugSlices.cpp drew of the first light --> [debug view] --> colour
//
//   Techniques tree, lowrank and epipolar, per light, take the place of [exact]: passes/Epipolar.cpp has their picture.
//   Temporal reuse draws what has changed: reuse/PlanReuse.cpp has the picture.
//
namespace tyndall {

// A frame is planned before anything is drawn: whatever refuses or fails does so while it is (plan/PlanFrame.cpp). The
// rest cannot fail but by a lost context; Config::betweenDraws may give it up.
Status Effect::State::render(const Frame& given) {
  warnings.clear();
  if (Status s = checkFields(given, warnings); !s) return s;
  gl::StateGuard guard(gl, stateMode);
  FrameTextures textures;
  Frame frame = withCubeViews(given);
  if (Status s = checkTextures(gl, frame, textures); !s) return s;
  chooseCopies(frame, textures);
  if (Status s = takeChecks(given, frame, textures, guard); !s) return s;
  if (Status s = takeMeshes(frame); !s) return s;
  beginStatistics();
  KeptEye* eye = eyeOf(frame);
  frame.camera = steadyCamera(frame, eye);
  PlannedFrame planned;
  Status status = planFrame(frame, textures, eye, planned);
  if (status && planned.fillsLookup) {
    const std::uint64_t write = lookupWrites.write(frame.lookup);
    if (planned.next) planned.next->picture.key.lookup.write = write;
  }
  if (status && !draw(given, planned, guard))
    status = {StatusCode::Abandoned, "Config::betweenDraws returned false: the rest of the frame was not drawn"};
  keep(frame, eye, status ? &planned : nullptr);
  return status;
}

// What earlier frames' pixels said. Of a frame that is refused for that only the check is drawn: until it finds
// nothing.
Status Effect::State::takeChecks(const Frame& given, const Frame& frame, const FrameTextures& textures,
                                 gl::StateGuard& guard) {
  if (!checksInputs) return {};
  inputChecks.receive();
  const std::vector<std::string>& found = inputChecks.warnings(given);
  if (found.empty() || !warningsAreErrors) {
    warnings.insert(warnings.end(), found.begin(), found.end());
    return {};
  }
  Status status{StatusCode::InvalidFrame, found.front()};
  beginStatistics();
  PlannedFrame planned;
  if (Status s = planFrame(frame, textures, nullptr, planned, Draws::CheckOnly); !s) return s;
  draw(given, planned, guard);
  targets.endFrame();
  return status;
}

// Of the values, and of what they say of each other.
Status Effect::State::checkFields(const Frame& frame, std::vector<std::string>& suspicions) const {
  if (Status s = checkValues(frame); !s) return s;
  if (Status s = checkPlausible(frame, suspicions); !s) return s;
  if (warningsAreErrors && !suspicions.empty()) return {StatusCode::InvalidFrame, suspicions.front()};
  return {};
}

void Effect::State::beginStatistics() {
  recorder.beginFrame();
  paces.beginFrame();
  visits = 0;
  lastEye.reset();
}

Status Effect::State::planFrame(const Frame& frame, const FrameTextures& textures, KeptEye* eye, PlannedFrame& planned,
                                Draws what) {
  framebuffers.beginFrame();
  Allocator allocator(framebuffers, true);
  const PlanInputs inputs{
      frame, textures, limits, tuning, targets, eye, recorder.canCount(), &paces, lookupWrites.lastOf(frame.lookup)};
  FramePlanner planner(inputs, allocator, planned);
  if (what == Draws::All) planner.plan();
  if (checksInputs) planner.planCheck();
  planned.empty = allocator.texture(targets, Resource::Empty, {});
  if (!allocator.status()) return allocator.status();
  requestPrograms(planned.plan, programs);
  if (Status s = resolvePrograms(planned.plan, programs, Resolve::ToDraw); !s) return s;
  if (planned.checks != 0)
    if (Status s = inputChecks.reserve(stateMode); !s) return s;
  return blocks.upload(planned.plan, limits.blockAlignment);
}

bool Effect::State::draw(const Frame& given, const PlannedFrame& planned, gl::StateGuard& guard) {
  const UnitsUsed units = unitsOf(planned.plan);
  guard.saveUnits(units.count, units.kinds);
  if (units.stencil) guard.saveStencil();
  if (units.scissor) guard.saveScissorBox();
  if (units.copies || planned.checks != 0) guard.saveReadFramebuffer();
  recorder.add(planned.plan.marched, planned.plan.slices);
  const DrawObjects objects{vertexArray.name(), nearestSampler.name(), planned.empty, blocks};
  const bool isWhole = drawPlan(planned.plan, gl, objects, recorder, paces, betweenDraws);
  visits = isWhole ? planned.visits : 0;
  if (isWhole && planned.checks != 0)
    inputChecks.ask(planned.checks, given, planned.checkedLights, stateMode);
  else if (checksInputs)
    inputChecks.forget(given);
  return isWhole;
}

// All that is planned sees the camera without its jitter, as the eye's last frame saw it if that has not moved.
Camera Effect::State::steadyCamera(const Frame& frame, const KeptEye* eye) {
  Camera camera = optics::steady(frame.camera, frame.viewport);
  if (!eye || !eye->last || !optics::agree(camera, eye->last->camera)) return camera;
  camera.clipFromView = eye->last->camera.clipFromView;
  const bool rests = optics::slicesBeyond(camera) == 0 && optics::slicesBeyond(eye->last->camera) > 0;
  if (rests) camera.jitter = optics::kRestingJitter;
  return camera;
}

// What the next frame may reuse: nothing of one that failed.
void Effect::State::keep(const Frame& frame, KeptEye* eye, PlannedFrame* planned) {
  targets.endFrame();
  if (!eye || (planned && !planned->next)) return; // what it shows is not kept
  if (planned) lastEye = eye->id;
  eye->take(frame, planned ? std::move(planned->next) : std::nullopt);
}

// The eye's picture, if the frame may reuse it; one that is not to be reused is given up.
KeptEye* Effect::State::eyeOf(const Frame& frame) {
  if (frame.reuse.changes == Changes::Unknown) {
    eyes.forget(frame.reuse.eye);
    return nullptr;
  }
  KeptEye& eye = eyes.of(frame.reuse.eye);
  for (const double share : eye.counts.takeCounted())
    eye.rests.judge(share, eye.fullShare);
  if (!eye.rests.takeOne()) return &eye;
  recorder.skip("reuse", "the last frames had too little in common");
  eye.giveUp();
  return nullptr;
}

Status Effect::State::takeMeshes(Frame& frame) {
  if (frame.reuse.changes == Changes::Unknown) return {};
  KeptEye& eye = eyes.of(frame.reuse.eye);
  if (frame.reuse.changes == Changes::Detect || !eye.isFollowedBy(frame)) eye.lastShapes.clear();
  const bool hasMeshes = std::any_of(frame.objects.begin(), frame.objects.end(),
                                     [](const MovingObject& object) { return object.mesh.buffer != 0; });
  return hasMeshes ? objectBoxes.makeBoxes(frame, eye.lastShapes) : Status{};
}

// ---------------------------------------------------------------------------------------------------------------------

PrepareStatus Effect::State::prepare(const Frame& given) {
  std::vector<std::string> suspicions;
  if (Status s = checkFields(given, suspicions); !s) return {s};
  const gl::StateGuard guard(gl, stateMode);
  FrameTextures textures;
  Frame frame = withCubeViews(given);
  if (Status s = checkTextures(gl, frame, textures); !s) return {s};
  chooseCopies(frame, textures);
  Frame boxed = frame;
  LastShapes none;
  if (frame.reuse.changes != Changes::Unknown)
    if (Status s = objectBoxes.makeBoxes(boxed, none); !s) return {s};
  std::vector<FramePlan> plans = planAhead(frame, textures);
  for (const FramePlan& plan : plans)
    requestPrograms(plan, programs);
  if (const int left = programs.poll(); left > 0) return {{}, left};
  for (FramePlan& plan : plans)
    if (Status s = resolvePrograms(plan, programs, Resolve::Ahead); !s) return {s};
  return {};
}

// Plans of the frame without anything kept, and, with reuse, whatever of the last one may be drawn anew.
std::vector<FramePlan> Effect::State::planAhead(const Frame& frame, const FrameTextures& textures) {
  std::vector<FramePlan> plans;
  if (optics::isLit(frame.ambient)) { // which may fade, as at night
    Frame dark = frame;
    dark.ambient = {};
    plans = planAhead(dark, textures);
  }
  const auto plan = [&](const Frame& from, KeptEye* eye, auto&& how, std::optional<bool> sumsApart = {}) {
    Allocator allocator(framebuffers, false);
    PlannedFrame planned;
    const PlanInputs inputs{from, textures, limits, tuning, targets, eye, false, nullptr, 0, true, sumsApart};
    FramePlanner planner(inputs, allocator, planned);
    how(planner);
    plans.push_back(std::move(planned.plan));
  };
  const bool hasAmbient = optics::isLit(frame.ambient);
  for (const bool sumsApart : {false, true})
    if (!sumsApart || frame.lights.size() + (hasAmbient ? 1 : 0) > 1)
      plan(frame, nullptr, [](FramePlanner& planner) { planner.plan(); }, sumsApart);
  if (checksInputs) plan(frame, nullptr, [](FramePlanner& planner) { planner.planCheck(); });
  if (frame.reuse.changes == Changes::Unknown) return plans;
  KeptEye eye(gl, framebuffers, frame.reuse.eye);
  plan(frame, &eye, [](FramePlanner& planner) { planner.plan(); });
  if (!drawsInParts(frame)) return plans;
  const auto planRedrawn = [&](const Frame& from) {
    for (const bool ends : {false, true})
      for (const bool rows : {false, true})
        plan(from, &eye, [&](FramePlanner& planner) { planner.planRedrawn(ends, rows); });
  };
  planRedrawn(frame);
  Frame compared = frame; // as one that names objects is while their boxes are not known
  compared.reuse.changes = Changes::Detect;
  if (frame.reuse.changes == Changes::Objects) planRedrawn(compared);
  return plans;
}

Status Effect::State::compileAll() {
  const gl::StateGuard guard(gl, stateMode);
  constexpr std::size_t kAtOnce = 64; // enough for a driver's threads; what does not build is known soon
  const std::vector<gl::Variant> all = allVariants(tuning.compositing == Compositing::DualSource, gl.cubeArrays);
  for (std::size_t first = 0; first < all.size(); first += kAtOnce) {
    const std::size_t end = std::min(first + kAtOnce, all.size());
    for (std::size_t i = first; i < end; ++i)
      programs.request(all[i]);
    for (std::size_t i = first; i < end; ++i)
      if (!programs.find(all[i])) return {StatusCode::ShaderError, "a shader did not build: " + programs.error()};
  }
  return {};
}

} // namespace tyndall
