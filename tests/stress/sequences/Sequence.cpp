#include "Sequence.h"

#include "support/TestContext.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

using namespace tyndall;
using tests::Fault;
using tests::Times;

namespace stress {

namespace {

using Trouble = std::optional<std::string>;

// Of what reuse promises: as tests/gl/effect/ReuseRig.h.
constexpr double kRounding = 1e-5;
// Root mean square that another jitter's depth may come to in small pictures (Reuse), but for those of so few pixels
// that it promises nothing of them.
constexpr double kOtherJitter = 0.1;
constexpr int kFewPixels = 400;

// A frame that breaks a rule.
Frame spoilt(const Frame& frame, int how) {
  Frame broken = frame;
  switch (how) {
  case 1:
    broken.viewport.width = 0;
    break;
  case 2:
    broken.reuse.fullShare = -1;
    break;
  case 3:
    broken.depth.texture = 987654;
    break;
  case 4:
    broken.camera.viewFromWorld[0] = std::numeric_limits<double>::quiet_NaN();
    break;
  default:
    if (frame.reuse.changes == Changes::Objects) {
      broken.objects.emplace_back();
      broken.objects.back().mesh = {987654, 0, 12, 3, 1};
    } else {
      broken.lights.resize(kMaxLights + 1);
    }
  }
  return broken;
}

Fault faultOf(const FailureState& failure) {
  switch (failure.kind) {
  case Failure::Memory:
    return failure.at % 2 == 0 ? Fault::Buffer : Fault::Texture;
  case Failure::Framebuffer:
    return failure.at % 2 == 0 ? Fault::Renderbuffer : Fault::Framebuffer;
  case Failure::Shader:
    return failure.at % 2 == 0 ? Fault::Link : Fault::Compile;
  default:
    return Fault::None;
  }
}

// Whether tyndall.h lets a frame that fails in this way say so.
bool isStatusOf(const FailureState& failure, StatusCode code) {
  switch (failure.kind) {
  case Failure::Invalid:
    return code == StatusCode::InvalidFrame;
  case Failure::Memory:
    return code == StatusCode::OutOfMemory;
  case Failure::Framebuffer:
    return code == StatusCode::OutOfMemory || code == StatusCode::InvalidFrame;
  case Failure::Shader:
    return code == StatusCode::ShaderError;
  case Failure::Abandoned:
    return code == StatusCode::Abandoned;
  default:
    return false;
  }
}

void describe(const ScriptState& s, const Frame& frame, const ReuseModel::Prediction& prediction, double share) {
  std::printf(
      "%dx%d eye %d frame %d mode %d objects %zu versions %d technique %d view %d filter %d slices %d samples %d "
      "lights %zu jitter %.2f,%.2f refresh %d full %.2f depth %d:%x colour %d:%x outputs %d%d:%x renew %d fail %d "
      "| must %d mixes %d last %d | share %g\n",
      s.width, s.height, s.eye, static_cast<int>(frame.reuse.frame), static_cast<int>(s.changes), frame.objects.size(),
      s.versions, static_cast<int>(s.settings.technique), static_cast<int>(s.settings.debugView),
      static_cast<int>(s.settings.shadowFilter), s.settings.slices, s.settings.samples, s.lights.size(), s.jitter[0],
      s.jitter[1], s.refreshFrames, static_cast<double>(s.fullShare), static_cast<int>(s.depthLayout), s.depthFormat,
      s.colour, s.colourFormat, s.inscatter, s.transmittance, s.outputFormat, s.renew, static_cast<int>(s.failure.kind),
      static_cast<int>(prediction.share), prediction.mixesJitters, prediction.isLast, share);
  for (const LightState& light : s.lights)
    std::printf("    light %d: kind %d cascades %d map %d size %d layout %d format %x glass %d outside %d\n", light.id,
                static_cast<int>(light.kind), light.cascades, light.hasMap, light.mapSize,
                static_cast<int>(light.layout), light.format, light.glass, light.litOutside);
  for (const MoverState& mover : s.movers)
    if (mover.present)
      std::printf("    mover at %.2f %.2f %.2f mesh %d shape %.2f versioned %d\n", mover.place.x, mover.place.y,
                  mover.place.z, mover.mesh, mover.shape, mover.versioned);
}

} // namespace

void Tally::add(const Tally& other) {
  sequences += other.sequences;
  frames += other.frames;
  for (std::size_t i = 0; i < shares.size(); ++i)
    shares[i] += other.shares[i];
  for (std::size_t i = 0; i < predicted.size(); ++i)
    predicted[i] += other.predicted[i];
  for (std::size_t i = 0; i < failures.size(); ++i)
    failures[i] += other.failures[i];
  last += other.last;
  mixed += other.mixed;
  most = std::max(most, other.most);
  mixedRms = std::max(mixedRms, other.mixedRms);
}

Sequence::Sequence(tests::FaultyContext& context, Effect* reference, const Recipe& recipe)
    : context_(context), reference_(reference), recipe_(recipe) {
  makeEffect();
}

void Sequence::makeEffect() {
  Config config;
  if (recipe_.has(Ingredient::Configs)) {
    Random random = recipe_.random(Ingredient::Configs, -1);
    const auto masking = [&] { return static_cast<Masking>(random.below(3)); };
    config.state = static_cast<StateMode>(random.below(2));
    config.timing = random.chance(0.2) ? PassTiming::TimerQuery : PassTiming::Off;
    config.tuning = {masking(), masking(), static_cast<Compositing>(random.below(3)), random.chance(0.8) ? 0 : 1e-3};
    config.checkInputs = random.chance(0.2);
  }
  config.betweenDraws = [this] { return drawsLeft_ < 0 || drawsLeft_-- > 0; };
  CreateResult created = context_.create(config);
  if (!created.effect) throw std::runtime_error("create: " + created.status.message);
  effect_ = std::move(created.effect);
}

Trouble Sequence::run() {
  Script script(recipe_);
  ++tally_.sequences;
  for (int i = 0; i < recipe_.frames; ++i) {
    const ScriptState& state = script.advance();
    if (recipe_.skipped.count(i) != 0) continue;
    context_.resetCounts();
    Trouble trouble = step(state);
    if (!trouble)
      for (const std::string& error : tests::testContext().takeErrors())
        trouble = "GL error: " + error;
    if (trouble) return "frame " + std::to_string(i) + ": " + *trouble;
  }
  return {};
}

Trouble Sequence::step(const ScriptState& state) {
  const Frame& frame = engine_.show(state);
  ++tally_.frames;
  if (recipe_.has(Ingredient::Configs) && recipe_.random(Ingredient::Configs, state.eye).chance(0.2))
    if (const PrepareStatus prepared = effect_->prepare(frame); !prepared.status)
      return "prepare: " + prepared.status.message;
  if (state.failure.kind != Failure::None) {
    bool drawn = false;
    if (Trouble trouble = failFirst(state, frame, drawn)) return trouble;
    if (drawn || !state.failure.again) {
      if (drawn || state.failure.counted) engine_.shown();
      return {};
    }
  }
  return draw(state, frame);
}

Status Sequence::renderFailing(const ScriptState& state, const Frame& frame) {
  const FailureState& failure = state.failure;
  if (failure.kind == Failure::Invalid) return effect_->render(spoilt(frame, failure.at));
  if (failure.kind == Failure::Abandoned) drawsLeft_ = 3 * (failure.at - 1);
  context_.fail(faultOf(failure), failure.at, failure.at % 3 == 0 ? Times::Only : Times::From);
  Status status = effect_->render(frame);
  context_.heal();
  tests::takeGlError();
  drawsLeft_ = -1;
  return status;
}

// The frame that fails: nothing of it may be seen, unless it was abandoned.
Trouble Sequence::failFirst(const ScriptState& state, const Frame& frame, bool& drawn) {
  engine_.fillTargets();
  const Contents before = engine_.readTargets();
  const ReuseModel asIs = model_;
  const ReuseModel::Prediction prediction = model_.predict(engine_.facts());
  const Status status = renderFailing(state, frame);
  drawn = static_cast<bool>(status);
  if (drawn) return check(state, frame, prediction);
  ++tally_.failures[static_cast<std::size_t>(state.failure.kind)];
  model_ = asIs;
  model_.failed(engine_.facts(), status.code);
  if (!isStatusOf(state.failure, status.code)) return "the failing frame says: " + status.message;
  if (status.code != StatusCode::Abandoned && !bitEqual(engine_.readTargets(), before))
    return "a frame that failed was drawn: " + status.message;
  return {};
}

Trouble Sequence::draw(const ScriptState& state, const Frame& frame) {
  engine_.fillTargets();
  const ReuseModel::Prediction prediction = model_.predict(engine_.facts());
  if (const Status status = effect_->render(frame); !status) return "refused: " + status.message;
  return check(state, frame, prediction);
}

// What was just drawn.
Trouble Sequence::check(const ScriptState& state, const Frame& frame, const ReuseModel::Prediction& prediction) {
  engine_.shown();
  const Contents got = engine_.readTargets();
  const double share = effect_->statistics().redrawnShare;
  if (describes) describe(state, frame, prediction, share);
  model_.drawn(engine_.facts(), share);
  const std::optional<Contents> wanted = drawReference(frame);
  if (!wanted) return "the reference is refused";
  ++tally_.shares[share == 0 ? 0 : share < 1 ? 1 : 2];
  ++tally_.predicted[static_cast<std::size_t>(prediction.share)];
  Trouble trouble = checkPicture(state, got, *wanted, prediction);
  if (mayRest(state) && trouble)
    if (const std::optional<Contents> resting = drawReference(frame, true); resting)
      trouble = checkPicture(state, got, *resting, prediction);
  if (trouble) return *trouble + ", share " + std::to_string(share);
  return checkShare(prediction.share, share);
}

// True if the eye may keep the slices of a jitter that has come to rest: Camera::jitter.
bool Sequence::mayRest(const ScriptState& state) {
  const FrameFacts& facts = engine_.facts();
  const bool kept = facts.changes != Changes::Unknown && jittered_[state.eye] == facts.camera;
  const bool rests = state.jitter == std::array<double, 2>{0, 0};
  jittered_[state.eye] = kept || !rests ? facts.camera : 0;
  return kept && rests;
}

Trouble Sequence::checkShare(Share predicted, double share) {
  const bool right = predicted == Share::Any ? share >= 0 && share <= 1 : share == (predicted == Share::All ? 1 : 0);
  if (right) return {};
  return "the redrawn share is " + std::to_string(share) + ", and must be " +
         (predicted == Share::Any   ? "from 0 to 1"
          : predicted == Share::All ? "1"
                                    : "0");
}

std::optional<Contents> Sequence::drawReference(const Frame& frame, bool rests) {
  std::unique_ptr<Effect> fresh;
  if (!reference_) fresh = context_.create().effect;
  Frame inFull = frame;
  inFull.reuse = {};
  inFull.objects.clear();
  if (rests) inFull.camera.jitter = {1e-12, 0}; // none, with the slices of one
  engine_.fillTargets();
  if (!(reference_ ? reference_ : fresh.get())->render(inFull)) return {};
  return engine_.readTargets();
}

Trouble Sequence::checkPicture(const ScriptState& state, const Contents& got, const Contents& wanted,
                               const ReuseModel::Prediction& prediction) {
  if (!isUntouchedOutside(got, engine_.empty(), state)) return "drawn outside the viewport";
  if (Trouble trouble = checkKept(state, got, prediction)) return trouble;
  Contents ours = got;
  if (state.settings.debugView == DebugView::Redrawn) ours[0] = wanted[0]; // which shows what was reused
  return checkFull(state, ours, wanted, prediction.mixesJitters);
}

Trouble Sequence::checkKept(const ScriptState& state, const Contents& got, const ReuseModel::Prediction& prediction) {
  const LastPicture now{
      got, {state.left, state.bottom, state.right, state.top}, {state.colourFormat, state.outputFormat}};
  const auto last = last_.find(state.eye);
  Trouble trouble;
  if (prediction.isLast && last != last_.end() && last->second.margins == now.margins &&
      last->second.formats == now.formats) {
    ++tally_.last;
    const bool showsReuse = state.settings.debugView == DebugView::Redrawn;
    for (std::size_t i = showsReuse ? 1 : 0; i < got.size(); ++i)
      if (!got[i].empty() && !last->second.contents[i].empty() &&
          !bitEqual({got[i], {}, {}}, {last->second.contents[i], {}, {}}))
        trouble = "nothing has changed, and it is not the last picture";
  }
  last_[state.eye] = now;
  return trouble;
}

Trouble Sequence::checkFull(const ScriptState& state, const Contents& got, const Contents& wanted, bool mixesJitters) {
  const Difference difference = differenceOf(got, wanted, state);
  std::vector<Contents>& jitters = jitters_[state.eye];
  if (!mixesJitters) jitters.clear();
  jitters.push_back(wanted);
  if (mixesJitters) {
    double others = kOtherJitter;
    for (const Contents& other : jitters)
      others = std::max(others, differenceOf(other, wanted, state).rootMeanSquare);
    if (difference.rootMeanSquare > others && state.width * state.height >= kFewPixels)
      return "differs by " + std::to_string(difference.rootMeanSquare) +
             ", and the pictures of the jitters that it is of by " + std::to_string(others) + ": " + difference.where;
    ++tally_.mixed;
    tally_.mixedRms = std::max(tally_.mixedRms, difference.rootMeanSquare);
    return {};
  }
  if (difference.most > kRounding) return "differs by " + std::to_string(difference.most) + ": " + difference.where;
  tally_.most = std::max(tally_.most, difference.most);
  return {};
}

} // namespace stress
