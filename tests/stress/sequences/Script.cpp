#include "Script.h"

#include "gl/Gl.h"

#include <cmath>
#include <limits>

using namespace tyndall;

namespace stress {

namespace {

// Few sizes, and no powers of two, also with what is around them: Mesa's software driver compiles shaders once more for
// textures of those.
void changeSize(ScriptState& s, Random& r) {
  s.width = r.pick<int>({9, 14, 22, 31, 47});
  s.height = r.pick<int>({11, 15, 19, 27, 39});
}

void changeViewport(ScriptState& s, Random& r) {
  for (int* margin : {&s.left, &s.bottom, &s.right, &s.top})
    *margin = r.chance(0.5) ? 3 : 0;
}

void changeEye(ScriptState& s, Random& r) { s.eye = r.below(r.chance(0.5) ? 2 : kEyes); }

void changeCamera(ScriptState& s, Random& r) {
  CameraState& camera = s.cameras[static_cast<std::size_t>(s.eye)];
  const bool cut = r.chance(0.2);
  if (cut) {
    camera.orthographic = r.chance(0.15);
    camera.reversed = r.chance(0.4);
    camera.zeroToOne = r.chance(0.5);
    camera.infinite = camera.reversed && camera.zeroToOne && !camera.orthographic && r.chance(0.5);
    camera.size = r.uniform(0.25, 1.2);
  }
  const double reach = cut ? 1 : 0.03;
  camera.place += reach * glm::dvec3(r.uniform(-1.5, 1.5), r.uniform(-0.5, 1), r.uniform(-1, 1.5));
  camera.place = glm::clamp(camera.place, glm::dvec3(-2, 1, -1), glm::dvec3(2, 4, 3));
  camera.turn += reach * r.uniform(-2, 2);
  camera.tilt = glm::clamp(camera.tilt + reach * r.uniform(-0.6, 0.6), -0.6, 0.6);
}

void changeJitter(ScriptState& s, Random& r) {
  const double reach = r.chance(0.1) ? 4 : 0.5;
  s.jitter = {r.uniform(-reach, reach), r.uniform(-reach, reach)};
  if (r.chance(0.15)) s.jitter = {0, 0};
}

LightState newLight(ScriptState& s, Random& r) {
  LightState light;
  light.id = s.nextLight++;
  light.kind = r.pick<LightKind>(
      {LightKind::Directional, LightKind::Directional, LightKind::Spot, LightKind::Spot, LightKind::Point});
  light.cascades = light.kind == LightKind::Directional && r.chance(0.3) ? r.between(2, 4) : 1;
  light.hasMap = r.chance(0.9);
  light.litOutside = r.chance(0.7);
  light.turn = r.uniform(-1, 1);
  if (light.kind == LightKind::Point || light.cascades > 1) light.layout = MapLayout::Layers;
  return light;
}

void changeLights(ScriptState& s, Random& r) {
  const bool adds = s.lights.empty() || (s.lights.size() < 3 && r.chance(0.5));
  const int at = r.below(static_cast<int>(s.lights.size()) + (adds ? 1 : 0));
  if (adds)
    s.lights.insert(s.lights.begin() + at, newLight(s, r));
  else if (s.lights.size() > 1 && r.chance(0.3))
    std::swap(s.lights.front(), s.lights.back());
  else
    s.lights.erase(s.lights.begin() + at);
}

LightState* anyLight(ScriptState& s, Random& r) {
  return s.lights.empty() ? nullptr : &s.lights[static_cast<std::size_t>(r.below(static_cast<int>(s.lights.size())))];
}

void changeLight(ScriptState& s, Random& r) {
  LightState* light = anyLight(s, r);
  if (!light) return;
  if (r.chance(0.5)) {
    light->turn += r.uniform(-0.3, 0.3);
    return;
  }
  for (float& channel : light->colour)
    channel = static_cast<float>(r.uniform(0, 2));
  if (r.chance(0.2)) light->colour = {0, 0, 0};
}

void changeMap(ScriptState& s, Random& r) {
  LightState* light = anyLight(s, r);
  if (!light) return;
  light->hasMap = r.chance(0.85);
  light->mapSize = r.pick<int>({5, 12, 12, 24, 30});
  light->format = r.pick<Format>({0, 0, GL_DEPTH_COMPONENT16});
  const bool single = light->kind != LightKind::Point && light->cascades == 1;
  light->layout =
      r.pick<MapLayout>({single ? MapLayout::Plain : MapLayout::Layers, MapLayout::Layers, MapLayout::Atlas});
}

void changeGlass(ScriptState& s, Random& r) {
  if (LightState* light = anyLight(s, r)) light->glass = !light->glass;
}

void changeMedium(ScriptState& s, Random& r) {
  const auto colour = [&r](double most) {
    Rgb rgb{};
    const bool grey = r.chance(0.4);
    for (float& channel : rgb)
      channel = static_cast<float>(r.uniform(0, most));
    return grey ? Rgb{rgb[0], rgb[0], rgb[0]} : rgb;
  };
  s.medium.constituents.clear();
  for (int count = r.chance(0.1) ? 0 : r.between(1, 2); count > 0; --count)
    s.medium.constituents.push_back(
        {colour(0.1), static_cast<Phase>(r.below(4)), static_cast<float>(r.uniform(-0.8, 0.9))});
  s.medium.absorption = r.chance(0.5) ? colour(0.05) : Rgb{0, 0, 0};
  s.medium.farDistance = r.chance(0.5) ? 60 : 20;
}

void changeSettings(ScriptState& s, Random& r) {
  Settings& settings = s.settings;
  switch (r.below(9)) {
  case 0:
    settings.slices = r.pick<int>({1, 7, 24, 60, 1152});
    break;
  case 1:
    settings.samples = r.pick<int>({64, 128, 512});
    break;
  case 2:
    settings.rowStep = r.between(1, 3);
    break;
  case 3:
    settings.minMaxTree = !settings.minMaxTree;
    break;
  case 4:
    settings.averageThreshold = r.pick<float>({0, 0.1F, 1});
    break;
  case 5:
    settings.leastWeight = r.pick<float>({0, 0.01F, 0.5F});
    break;
  case 6:
    settings.bendThreshold = r.pick<float>({0.001F, 0.02F, 0.5F});
    break;
  case 7:
    settings.sampleBudget = r.pick<int>({0, 4096});
    break;
  default:
    settings.shadowFilter =
        settings.shadowFilter == ShadowFilter::Nearest ? ShadowFilter::Bilinear : ShadowFilter::Nearest;
  }
}

void changeTechnique(ScriptState& s, Random& r) {
  s.settings.technique = r.pick<Technique>({Technique::Epipolar, Technique::Epipolar, Technique::Epipolar,
                                            Technique::Tree, Technique::Exact, Technique::LowRank});
  s.settings.spreadThreshold = r.chance(0.1) ? 0.02F : std::numeric_limits<float>::infinity();
}

void changeMode(ScriptState& s, Random& r) {
  s.changes = r.pick<Changes>({Changes::Unknown, Changes::Detect, Changes::Detect, Changes::Objects, Changes::Objects});
}

void changeVersions(ScriptState& s, Random& r) { s.versions = r.pick<int>({0, 1, 1, 1, 2}); }

void changeMovers(ScriptState& s, Random& r) {
  MoverState& mover = s.movers[static_cast<std::size_t>(r.below(3))];
  if (!mover.present || r.chance(0.15)) {
    mover.present = !mover.present;
    mover.size = {r.uniform(0.05, 0.8), r.uniform(0.05, 0.6), r.uniform(0.05, 0.6)};
  }
  const double reach = r.chance(0.3) ? 1 : 0.1;
  mover.place += reach * glm::dvec3(r.uniform(-2, 2), r.uniform(-1, 1), r.uniform(-2, 2));
  mover.place = glm::clamp(mover.place, glm::dvec3(-3, 0.3, -7), glm::dvec3(3, 5, -2));
  mover.angle += reach * r.uniform(-2, 2);
}

void changeMesh(ScriptState& s, Random& r) {
  MoverState& mover = s.movers[static_cast<std::size_t>(r.below(3))];
  if (mover.mesh && r.chance(0.7))
    mover.shape = r.pick<double>({0.4, 1, 1.8}); // one that was there before has its version again
  else if (!mover.present || !mover.mesh)        // one that is seen stays what it is
    mover.mesh = true;
  mover.versioned = r.chance(0.8);
}

void changeRefresh(ScriptState& s, Random& r) { s.refreshFrames = r.pick<int>({0, 0, 1, 3, 7, 40}); }
void changeFullShare(ScriptState& s, Random& r) { s.fullShare = r.pick<float>({0, 0.1F, 0.35F, 1, 1}); }

void changeView(ScriptState& s, Random& r) {
  const int views = static_cast<int>(DebugView::Inputs) + 1;
  const auto view = r.chance(0.5) ? DebugView::Composite : static_cast<DebugView>(r.below(views));
  s.settings.debugView = r.chance(0.2) ? DebugView::Redrawn : view;
}

void changeTargets(ScriptState& s, Random& r) {
  s.colour = r.chance(0.8);
  s.inscatter = !s.colour || r.chance(0.6);
  s.transmittance = r.chance(0.6);
  s.colourFormat = r.pick<Format>({0, 0, GL_RGBA16F});
  s.outputFormat = r.pick<Format>({0, 0, 0, GL_RGBA16F});
}

void changeDepth(ScriptState& s, Random& r) {
  s.depthFormat = r.pick<Format>({0, 0, GL_DEPTH_COMPONENT24});
  s.depthLayout =
      r.pick<DepthLayout>({DepthLayout::Plain, DepthLayout::Rectangle, DepthLayout::Layer, DepthLayout::Double});
}

void changeFailure(ScriptState& s, Random& r) {
  s.failure = {static_cast<Failure>(1 + r.below(kFailures - 1)), r.between(1, 5), r.chance(0.6), r.chance(0.5)};
}

// Some views need a technique.
void makeShowable(Settings& s) {
  const bool isPicture = s.debugView == DebugView::Composite || s.debugView >= DebugView::Inscatter;
  if (isPicture || s.technique == Technique::Epipolar) return;
  const bool needsSlices = s.debugView == DebugView::Slices || s.debugView == DebugView::NodeVisits;
  if (!needsSlices || s.technique == Technique::Exact) s.debugView = DebugView::Composite;
}

ScriptState simplest() {
  ScriptState state;
  state.medium.constituents = {{{0.05F, 0.05F, 0.05F}, Phase::Isotropic, 0}};
  state.medium.farDistance = 60;
  state.settings.slices = 60;
  state.settings.samples = 64;
  return state;
}

} // namespace

Script::Script(const Recipe& recipe) : recipe_(recipe), state_(simplest()) {
  for (std::size_t i = 0; i < rates_.size(); ++i) {
    Random random = recipe_.random(static_cast<Ingredient>(i), -1);
    const auto ingredient = static_cast<Ingredient>(i);
    const bool often = ingredient == Ingredient::Movers || ingredient == Ingredient::Meshes;
    rates_[i] = often ? random.pick<double>({0, 0.1, 0.5}) : random.pick<double>({0, 0, 0, 0.05, 0.25});
  }
}

// Frame 0 sees each ingredient once, or some of them more often, with what it has in the sequence.
void Script::vary(Ingredient ingredient, Change change) {
  if (!recipe_.has(ingredient)) return;
  Random random = recipe_.random(ingredient, frame_);
  const double rate = rates_[static_cast<std::size_t>(ingredient)];
  if (frame_ == 0) {
    const bool often = ingredient == Ingredient::Movers || ingredient == Ingredient::Meshes ||
                       ingredient == Ingredient::Lights || ingredient == Ingredient::Settings;
    for (int times = often ? random.below(4) : random.below(2); times > 0; --times)
      change(state_, random);
  } else if (random.chance(rate)) {
    change(state_, random);
  }
}

void Script::varyAll() {
  vary(Ingredient::Sizes, changeSize);
  vary(Ingredient::Viewports, changeViewport);
  vary(Ingredient::Eyes, changeEye);
  vary(Ingredient::Cameras, changeCamera);
  vary(Ingredient::Jitter, changeJitter);
  vary(Ingredient::Lights, changeLights);
  vary(Ingredient::LightMoves, changeLight);
  vary(Ingredient::Maps, changeMap);
  vary(Ingredient::Glass, changeGlass);
  vary(Ingredient::Media, changeMedium);
  vary(Ingredient::Settings, changeSettings);
  vary(Ingredient::Techniques, changeTechnique);
  vary(Ingredient::Modes, changeMode);
  vary(Ingredient::Versions, changeVersions);
  vary(Ingredient::Movers, changeMovers);
  vary(Ingredient::Meshes, changeMesh);
  vary(Ingredient::Refresh, changeRefresh);
  vary(Ingredient::FullShare, changeFullShare);
  vary(Ingredient::Views, changeView);
  vary(Ingredient::Targets, changeTargets);
  vary(Ingredient::Depths, changeDepth);
  state_.renew = state_.jumps = false;
  state_.failure = {};
  vary(Ingredient::Textures, [](ScriptState& s, Random&) { s.renew = true; });
  vary(Ingredient::Failures, changeFailure);
  vary(Ingredient::Modes, [](ScriptState& s, Random& r) { s.jumps = r.chance(0.3); });
  vary(Ingredient::Movers, [](ScriptState& s, Random& r) {
    s.namesResting = r.chance(0.3);
    s.margin = r.pick<double>({1, 1, 1.2});
  });
}

const ScriptState& Script::advance() {
  ++frame_;
  varyAll();
  if (state_.settings.debugView != DebugView::Composite) state_.colour = true;
  if (frame_ == 0) state_.failure = {};
  makeShowable(state_.settings);
  return state_;
}

} // namespace stress
