// What an engine tells of the frames before: Frame::reuse, versions and moving objects.
#include "Engine.h"
#include "Hash.h"

#include <algorithm>
#include <cmath>

using namespace tyndall;

namespace stress {

namespace {

bool sameShape(const MoverState& a, const MoverState& b) { return a.mesh == b.mesh && (!a.mesh || a.shape == b.shape); }

bool rests(const MoverState& a, const MoverState& b) {
  if (!a.present || !b.present) return a.present == b.present;
  return poseOf(a) == poseOf(b) && sameShape(a, b);
}

} // namespace

std::uint64_t Engine::versionOf(std::uint64_t holds) {
  if (state_.versions == 0) return 0;
  return state_.versions == 1 ? holds | 1U : ++versions_;
}

MeshVertices Engine::meshOf(std::size_t mover) const {
  const MeshBuffer& mesh = meshes_[mover];
  return {mesh.buffer.name(), 8, 20, 8, state_.movers[mover].versioned ? mesh.version : 0};
}

// True if nothing but what moves has changed in maps and depth: no texels of another format, which differ everywhere.
bool Engine::isExplainedByObjects(const Shown& last) const {
  for (const LightState& light : state_.lights) {
    const auto found = last.maps.find(light.id);
    if (found != last.maps.end() && found->second != light.format) return false;
  }
  return last.depth == state_.depthFormat;
}

// A mesh that was a box, or the other way round, is the one that vanishes and the other that appears.
void Engine::nameObjects(const Shown& last) {
  for (std::size_t i = 0; i < state_.movers.size(); ++i) {
    const MoverState &now = state_.movers[i], &before = last.movers[i];
    if (rests(before, now) && !(state_.namesResting && now.present)) continue;
    const auto name = [&](const MoverState& at, const MoverState& from) {
      const glm::dmat4 margin = glm::dmat4(glm::dmat3(at.mesh ? 1.0 : state_.margin));
      MovingObject object{fromGlm(poseOf(at) * margin), fromGlm(poseOf(from) * margin)};
      if (at.mesh) object.mesh = meshOf(i);
      frame_.objects.push_back(object);
    };
    if (before.present && now.present && before.mesh == now.mesh) {
      name(now, before);
      continue;
    }
    if (before.present) name(before, before);
    if (now.present) name(now, now);
  }
}

void Engine::tellReuse() {
  const auto eye = static_cast<std::size_t>(state_.eye);
  frame_.depth.version = versionOf(depth_.holds());
  for (std::size_t i = 0; i < frame_.lights.size(); ++i) {
    if (frame_.lights[i].shadow.texture == 0) continue;
    const LightSheets& sheets = lights_.at(state_.lights[i].id);
    Hash holds;
    holds.add(sheets.depth.holds());
    if (frame_.lights[i].glass.colour != 0) holds.add(sheets.glassColour.holds());
    frame_.lights[i].shadow.version = versionOf(holds.value());
  }
  const std::optional<Shown>& last = shown_[eye];
  const bool jumps = state_.jumps || !last || !isExplainedByObjects(*last);
  frame_.reuse = {state_.changes, static_cast<std::uint64_t>(100 + state_.eye),
                  (last ? last->frame : counters_[eye]) + (jumps ? 2 : 1), state_.fullShare, state_.refreshFrames};
  if (state_.changes == Changes::Objects && !jumps) nameObjects(*last);
}

void Engine::shown() {
  Shown now{state_.movers, {}, state_.depthFormat, frame_.reuse.frame};
  for (const LightState& light : state_.lights)
    now.maps[light.id] = light.format;
  shown_[static_cast<std::size_t>(state_.eye)] = now;
  counters_[static_cast<std::size_t>(state_.eye)] = frame_.reuse.frame;
}

void Engine::tellFacts() {
  const CameraState& camera = state_.cameras[static_cast<std::size_t>(state_.eye)];
  Hash shared;
  shared.add(state_.width).add(state_.height).add(cameraOf(camera, {0, 0}, state_.width, state_.height).clipFromView);
  shared.add(frame_.camera.viewFromWorld).add(camera.zeroToOne);
  facts_ = {};
  facts_.camera = shared.value();
  shared.add(state_.settings.technique);
  for (const Constituent& part : state_.medium.constituents)
    shared.add(part.scattering).add(part.phase).add(part.g);
  shared.add(state_.medium.absorption).add(state_.medium.farDistance);
  Hash everything = shared;
  const Settings& s = state_.settings;
  everything.add(s.debugView).add(s.shadowFilter).add(s.slices).add(s.samples).add(s.rowStep).add(s.minMaxTree);
  everything.add(s.averageThreshold).add(s.leastWeight).add(s.bendThreshold).add(s.sampleBudget).add(s.spreadThreshold);
  everything.add(s.errorTarget);
  everything.add(state_.depthLayout).add(state_.depthFormat);
  everything.add(state_.colour || state_.inscatter).add(state_.colourFormat).add(state_.outputFormat); // lights' use
  for (const LightState& light : state_.lights) {
    everything.add(light.id).add(light.kind).add(light.turn).add(light.colour).add(light.hasMap).add(light.glass);
    everything.add(light.litOutside).add(light.mapSize).add(light.layout).add(light.format).add(light.cascades);
  }
  for (const Light& light : frame_.lights) {
    const Hash place = Hash().add(light.shadow.texture).add(light.glass.colour).add(light.glass.depth);
    const auto at = static_cast<std::size_t>(&light - frame_.lights.data());
    const auto found = lights_.find(state_.lights[at].id);
    const bool hasMap = light.shadow.texture != 0;
    facts_.maps.push_back({place.value(), hasMap ? found->second.depth.holds() : 0, hasMap ? light.shadow.version : 1});
  }
  facts_.eye = frame_.reuse.eye;
  facts_.frame = frame_.reuse.frame;
  facts_.changes = frame_.reuse.changes;
  facts_.shared = shared.value();
  facts_.everything = everything.value();
  const Rectangle& at = frame_.depth.rectangle;
  facts_.depth = {Hash().add(frame_.depth.texture).add(frame_.depth.layer).add(at.x).add(at.y).value(), depth_.holds(),
                  frame_.depth.version};
  facts_.jitter = state_.jitter;
  facts_.namesObjects = !frame_.objects.empty();
  facts_.namesMeshes = std::any_of(frame_.objects.begin(), frame_.objects.end(),
                                   [](const MovingObject& object) { return object.mesh.buffer != 0; });
  facts_.drawsInParts = s.technique == Technique::Epipolar && !std::isfinite(s.spreadThreshold);
  Rgb extinction = state_.medium.absorption;
  for (const Constituent& part : state_.medium.constituents)
    for (std::size_t i = 0; i < 3; ++i)
      extinction[i] += part.scattering[i];
  facts_.isPicture =
      (s.debugView == DebugView::Composite || s.debugView == DebugView::Redrawn) && extinction != Rgb{0, 0, 0};
  facts_.refreshFrames = state_.refreshFrames;
  facts_.fullShare = state_.fullShare;
}

} // namespace stress
