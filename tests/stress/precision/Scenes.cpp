#include "Scenes.h"

#include "gl/ReadBack.h"
#include "gl/avsm/AvsmRig.h"
#include "gl/effect/MapLayoutRig.h"
#include "gl/effect/ReuseRig.h"

#include <memory>
#include <random>

using namespace tyndall;

namespace precision {

namespace {

constexpr int kWidth = 64, kHeight = 48, kMapSize = 64, kFineMapSize = 1024;
constexpr LightKind kSun = LightKind::Directional, kSpot = LightKind::Spot, kLamp = LightKind::Point;

using Rig = std::shared_ptr<tests::ShaftRig>;

struct Recipe {
  std::string name;
  LightKind light = kSun;
  Technique technique = Technique::Epipolar;
  bool coloured = false, glass = false;
  std::function<void(tests::ShaftRig&)> change = nullptr;
  int times = 1; ///< as many pixels along each side, and with more than one the finer map
};

Light lightOf(LightKind kind) {
  return kind == kSun ? tests::reuse::sun() : kind == kSpot ? tests::reuse::spot() : tests::reuse::point();
}

Rig rigOf(const Recipe& recipe) {
  auto rig = std::make_shared<tests::ShaftRig>(recipe.times * kWidth, recipe.times * kHeight);
  Frame& frame = rig->scene.frame;
  if (recipe.coloured)
    frame.medium = {{{{0.02F, 0.05F, 0.09F}, Phase::Rayleigh, 0}, {{0.03F, 0.03F, 0.02F}, Phase::CornetteShanks, 0.7F}},
                    {0, 0.02F, 0.01F}};
  rig->addLight(lightOf(recipe.light), recipe.times == 1 ? kMapSize : kFineMapSize, recipe.glass);
  frame.settings.technique = recipe.technique;
  if (recipe.change) recipe.change(*rig);
  return rig;
}

Scene sceneOf(const Recipe& recipe) {
  const Rig rig = rigOf(recipe);
  return {recipe.name, [rig](Effect& effect) { return rig->scene.render(effect).inscatter; },
          [rig] { return rig->scene.reference().inscatter; }};
}

void scaleLights(tests::ShaftRig& rig, float times) {
  for (Light& light : rig.scene.frame.lights)
    for (float& channel : light.colour)
      channel *= times;
}

// Half of the texels are leaves, each at its height, over a slope: what nodes of the tree may take by averages.
void growLeaves(tests::ShaftRig& rig, int size) {
  reference::ShadowImage image = rig.scene.shadow(0);
  image.width = image.height = size;
  image.depth.clear();
  const auto texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  std::mt19937 random(5);
  const bool isSun = rig.scene.frame.lights[0].kind == kSun;
  for (std::size_t i = 0; i < texels; ++i) {
    const float share = static_cast<float>(random() >> 8) * 0x1p-24F, leaf = isSun ? 0.35F : 0.97F;
    image.depth.push_back(random() % 2 == 0 ? leaf + 0.01F * share : 0.995F);
  }
  if (!image.glassColour.empty()) {
    image.glassDepth.assign(texels, isSun ? 0.3F : 0.96F);
    image.glassColour.clear();
    for (std::size_t i = 0; i < 3 * texels; ++i)
      image.glassColour.push_back(static_cast<float>(random() >> 8) * 0x1p-24F);
  }
  rig.scene.setShadow(0, image);
}

void addPlain(std::vector<Scene>& all) {
  const auto bilinear = [](tests::ShaftRig& rig) { rig.scene.frame.settings.shadowFilter = ShadowFilter::Bilinear; };
  const auto spread = [](tests::ShaftRig& rig) { rig.scene.frame.settings.spreadThreshold = 0.02F; };
  const auto target = [](tests::ShaftRig& rig) { rig.scene.frame.settings.errorTarget = 0.02F; };
  const auto leaves = [](tests::ShaftRig& rig) { growLeaves(rig, 1024); };
  const auto filteredLeaves = [bilinear, leaves](tests::ShaftRig& rig) {
    bilinear(rig);
    leaves(rig);
  };
  for (const Recipe& recipe : {
           Recipe{"sun", kSun},
           Recipe{"spot", kSpot},
           Recipe{"lamp", kLamp},
           Recipe{"sun, coloured", kSun, Technique::Epipolar, true},
           Recipe{"lamp, coloured", kLamp, Technique::Epipolar, true},
           Recipe{"sun, glass, bilinear", kSun, Technique::Epipolar, true, true, bilinear},
           Recipe{"lamp, glass", kLamp, Technique::Epipolar, false, true},
           Recipe{"sun, bilinear", kSun, Technique::Epipolar, false, false, bilinear},
           Recipe{"spot, bilinear", kSpot, Technique::Epipolar, false, false, bilinear},
           Recipe{"sun, spread", kSun, Technique::Epipolar, false, false, spread},
           Recipe{"spot, spread", kSpot, Technique::Epipolar, true, false, spread},
           Recipe{"sun, error target", kSun, Technique::Epipolar, false, false, target},
           Recipe{"spot, error target", kSpot, Technique::Epipolar, true, false, target},
           Recipe{"sun, tree", kSun, Technique::Tree},
           Recipe{"spot, tree, glass", kSpot, Technique::Tree, false, true},
           Recipe{"sun, low rank", kSun, Technique::LowRank},
           Recipe{"lamp, low rank", kLamp, Technique::LowRank},
           Recipe{"spot, low rank, glass", kSpot, Technique::LowRank, false, true},
           Recipe{"leaves, sun", kSun, Technique::Epipolar, false, false, leaves},
           Recipe{"leaves, spot", kSpot, Technique::Tree, false, false, leaves},
           Recipe{"leaves, sun, glass", kSun, Technique::Tree, true, true, leaves},
           Recipe{"leaves, spot, bilinear", kSpot, Technique::Epipolar, false, false, filteredLeaves},
       })
    all.push_back(sceneOf(recipe));
}

// Far from the world's origin, in other units, through a depth of thirteen decades, bright and dim.
void addHostile(std::vector<Scene>& all) {
  const auto moved = [](double scale, const glm::dvec3& offset) {
    return [=](tests::ShaftRig& rig) { tests::transformWorld(rig.scene.frame, scale, offset); };
  };
  const auto deep = [](tests::ShaftRig& rig) {
    rig.setConvention({true, false, false, ClipDepth::ZeroToOne, 1e-4, 1e9});
  };
  const auto times = [](float k) { return [k](tests::ShaftRig& rig) { scaleLights(rig, k); }; };
  const auto hazy = [](tests::ShaftRig& rig) { rig.scene.frame.medium.constituents[0].scattering = {3, 3, 3}; };
  all.push_back(sceneOf({"sun, fine", kSun, Technique::Epipolar, true, false, nullptr, 3}));
  all.push_back(sceneOf({"spot, fine", kSpot, Technique::Epipolar, false, false, nullptr, 3}));
  for (const LightKind kind : {kSun, kSpot}) {
    const std::string name = kind == kSun ? "sun, " : "spot, ";
    const auto add = [&](const char* what, bool coloured, const std::function<void(tests::ShaftRig&)>& change) {
      all.push_back(sceneOf({name + what, kind, Technique::Epipolar, coloured, false, change}));
    };
    add("1e6 from the origin", false, moved(1, {1e6, 12, -1e6}));
    add("units of 1e-4", true, moved(1e-4, {}));
    add("units of 1e4", true, moved(1e4, {}));
    add("depth from 1e-4 to 1e9", false, deep);
    add("1e8 as bright", true, times(1e8F));
    add("1e-8 as bright", true, times(1e-8F));
    add("dense", false, hazy);
  }
}

Scene multisampled(LightKind kind) {
  const Rig rig = rigOf({"", kind, Technique::Epipolar, true});
  const std::vector<float> depth = rig->scene.depth();
  rig->scene.setMultisampledDepth(4, GL_DEPTH_COMPONENT32F, [depth](int pixel, int sample) {
    return depth[static_cast<std::size_t>(pixel)] * (1 - 0.02F * static_cast<float>(sample * (pixel % 3)));
  });
  return {"multisampled", [rig](Effect& effect) { return rig->scene.render(effect).inscatter; },
          [rig] { return rig->scene.reference().inscatter; }};
}

// Depth as distances along the axis, a lamp's map as a cube of them: both are copied.
Scene copied(bool glass) {
  const auto rig = std::shared_ptr<tests::ShaftRig>(tests::layoutRig(kLamp, glass, kMapSize));
  rig->scene.frame.settings.technique = Technique::Epipolar;
  const auto maps = std::make_shared<tests::LaidMaps>(rig->scene.shadow(0), tests::Layout::Cube, 0.0F);
  maps->enter(rig->scene.frame.lights[0]);
  const std::vector<double>& distances = rig->scene.distances;
  const auto depth = std::make_shared<host::GlTexture>(
      tests::floatTexture(GL_R32F, rig->scene.frame.viewport.width, rig->scene.frame.viewport.height,
                          std::vector<float>(distances.begin(), distances.end())));
  rig->scene.frame.depth = {};
  rig->scene.frame.depth.texture = depth->name();
  rig->scene.frame.depth.encoding = DepthEncoding::Axial;
  return {glass ? "cube, glass" : "cube",
          [rig, maps, depth](Effect& effect) { return rig->scene.render(effect).inscatter; }, nullptr};
}

// A sun's map as distances from its near plane, glass of 8 bits.
Scene copiedGlass() {
  const Rig rig = rigOf({"", kSun, Technique::Epipolar, false, true});
  Light& light = rig->scene.frame.lights[0];
  light.shadow.encoding = DepthEncoding::Axial;
  light.shadow.scale.unit = 59; // from plane to plane
  std::vector<float> rgba;
  const std::vector<float>& rgb = rig->scene.shadow(0).glassColour;
  for (std::size_t i = 0; i < rgb.size(); i += 3)
    rgba.insert(rgba.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 1});
  const auto glass = std::make_shared<host::GlTexture>(tests::floatTextureArray(GL_RGBA8, kMapSize, kMapSize, 1, rgba));
  light.glass.colour = glass->name();
  return {"distances, glass of 8 bits", [rig, glass](Effect& effect) { return rig->scene.render(effect).inscatter; },
          nullptr};
}

reference::Image colourOf(tests::ShaftRig& rig, Effect& effect, const Output& output, GLenum format = GL_RGBA32F) {
  std::vector<float> back; // which half floats do not hold
  for (int i = 0; i < 4 * kWidth * kHeight; ++i)
    back.push_back(0.1F + 0.0137F * static_cast<float>(i % 11));
  const host::GlTexture colour = rig.scene.makeColour(format, back);
  Frame frame = rig.scene.frame;
  frame.output = output;
  const Status status = effect.render(frame);
  INFO(status.message);
  REQUIRE(status);
  rig.scene.frame.colour = 0;
  return {kWidth, kHeight, host::readColour(colour.name(), kWidth, kHeight, 3)};
}

void addComposites(std::vector<Scene>& all) {
  const Rig rig = rigOf({"", kSun, Technique::Epipolar, true});
  all.push_back({"colour copied",
                 [rig](Effect& effect) { return colourOf(*rig, effect, {}); },
                 nullptr,
                 {{}, {}, Compositing::Copy}});
  all.push_back({"half colour copied",
                 [rig](Effect& effect) { return colourOf(*rig, effect, {}, GL_RGBA16F); },
                 nullptr,
                 {{}, {}, Compositing::Copy},
                 "colour"});
  all.push_back({"colour copied, inscatter kept",
                 [rig](Effect& effect) { return colourOf(*rig, effect, {rig->scene.frame.output.inscatter, 0}); },
                 nullptr,
                 {{}, {}, Compositing::Copy}});
  all.push_back({"fix-up by tiles",
                 [rig](Effect& effect) { return rig->scene.render(effect).inscatter; },
                 nullptr,
                 {Masking::Tiles, Masking::Tiles}});
  for (const DebugView view : {DebugView::NodeVisits, DebugView::Samples, DebugView::Difference}) {
    const Rig shown = rigOf({"", kSun, Technique::Epipolar, true});
    shown->scene.frame.settings.debugView = view;
    all.push_back({"debug view " + std::to_string(static_cast<int>(view)),
                   [shown](Effect& effect) { return colourOf(*shown, effect, {}); },
                   nullptr,
                   {},
                   "debug"});
  }
}

// The third frame of a view in which a box tumbles.
Scene reusing(const std::string& name, const Recipe& recipe, Changes changes, const Tuning& tuning) {
  const Rig rig = rigOf(recipe);
  return {name,
          [rig, changes](Effect& effect) {
            tests::reuse::begin(*rig, changes);
            rig->scene.frame.reuse.fullShare = 1;
            rig->scene.frame.reuse.frame = 0;
            reference::Image image;
            for (int frame = 0; frame < 3; ++frame) {
              tests::reuse::moveTo(*rig, frame);
              image = rig->scene.render(effect).inscatter;
            }
            return image;
          },
          [rig] { return rig->scene.reference().inscatter; }, tuning};
}

void addReuse(std::vector<Scene>& all) {
  const auto bilinear = [](tests::ShaftRig& rig) { rig.scene.frame.settings.shadowFilter = ShadowFilter::Bilinear; };
  const Tuning tiles{Masking::Tiles, Masking::Tiles};
  all.push_back(reusing("detect", {"", kSun}, Changes::Detect, tiles));
  all.push_back(
      reusing("detect, bilinear", {"", kSpot, Technique::Epipolar, false, false, bilinear}, Changes::Detect, {}));
  all.push_back(reusing("objects", {"", kSpot, Technique::Epipolar, true}, Changes::Objects, tiles));
}

Scene smoky() {
  const Rig rig = rigOf({"", kSun});
  const auto smoke = std::make_shared<tests::AvsmRig>(tests::configOf(CurveReduction::Sorted, 16, 8, true));
  std::vector<tests::Captured> segments;
  for (int y = 2; y < 14; ++y)
    for (int x = 2; x < 14; ++x) {
      const float shift = 0.01F * static_cast<float>((3 * x + 5 * y) % 11);
      segments.push_back({{x, y, 0}, 0.3F + shift, 0.5F + shift, 0.6F});
      segments.push_back({{x, y, 0}, 0.45F + shift, 0.7F, 0.5F});
    }
  smoke->capture(segments);
  rig->scene.frame.lights[0].curves = smoke->avsm().curves();
  rig->scene.curves = {smoke->map()};
  return {"smoke", [rig, smoke](Effect& effect) { return rig->scene.render(effect).inscatter; },
          [rig] { return rig->scene.reference().inscatter; }};
}

} // namespace

std::vector<Scene> studyScenes() {
  std::vector<Scene> all;
  addPlain(all);
  addHostile(all);
  all.push_back(multisampled(kSpot));
  all.push_back(copied(false));
  all.push_back(copied(true));
  all.push_back(copiedGlass());
  addComposites(all);
  addReuse(all);
  if (tests::hasAvsm()) all.push_back(smoky());
  return all;
}

} // namespace precision
