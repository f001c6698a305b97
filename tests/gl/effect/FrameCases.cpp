#include "FrameCases.h"

#include "../avsm/AvsmRig.h"
#include "ReuseRig.h"
#include "gl/ReadBack.h"

#include <algorithm>
#include <array>

using namespace tyndall;
using host::gl;

namespace tests {

namespace {

constexpr int kLookupWidth = 6, kLookupHeight = 4, kLookupDepths = 5;

constexpr float kBefore = 0.25F; // in all channels of all targets
constexpr FrameTargets kColour{true, false, false}, kBoth{false, true, true}, kInscatter{false, true, false},
    kTransmittance{false, false, true}, kAll{true, true, true}, kColourInscatter{true, true, false},
    kColourTransmittance{true, false, true};

FrameCase make(const std::string& name, Technique technique, FrameTargets targets = kColour,
               std::vector<LightKind> lights = {LightKind::Directional}) {
  FrameCase item;
  item.name = name;
  item.technique = technique;
  item.targets = targets;
  item.lights = std::move(lights);
  return item;
}

constexpr LightKind kSun = LightKind::Directional, kSpot = LightKind::Spot, kLamp = LightKind::Point;

void addTechniques(std::vector<FrameCase>& all) {
  all.push_back(make("epipolar", Technique::Epipolar));
  all.push_back(make("epipolar, two lights", Technique::Epipolar, kColour, {kSun, kSpot}));
  all.push_back(make("epipolar, lamp", Technique::Epipolar, kColour, {kLamp}));
  all.push_back(make("epipolar, two lights, all targets", Technique::Epipolar, kAll, {kSpot, kSun}));
  all.push_back(make("epipolar, inscatter", Technique::Epipolar, kInscatter));
  all.push_back(make("epipolar, transmittance", Technique::Epipolar, kTransmittance));
  all.push_back(make("epipolar, both outputs", Technique::Epipolar, kBoth));
  all.push_back(make("epipolar, colour and inscatter", Technique::Epipolar, kColourInscatter));
  all.push_back(make("epipolar, colour and transmittance", Technique::Epipolar, kColourTransmittance));
  all.push_back(make("tree", Technique::Tree));
  all.push_back(make("tree, two lights, all targets", Technique::Tree, kAll, {kSun, kSpot}));
  all.push_back(make("tree, two lights, inscatter", Technique::Tree, kInscatter, {kSun, kSpot}));
  all.push_back(make("exact", Technique::Exact));
  all.push_back(make("exact, two lights", Technique::Exact, kColour, {kSun, kSpot}));
  all.push_back(make("exact, lamp, all targets", Technique::Exact, kAll, {kLamp}));
  all.push_back(make("exact, transmittance", Technique::Exact, kTransmittance));
  all.push_back(make("low rank", Technique::LowRank));
  all.push_back(make("low rank, two lights, both outputs", Technique::LowRank, kBoth, {kSun, kSpot}));
}

void addInputs(std::vector<FrameCase>& all) {
  for (const Technique technique : {Technique::Epipolar, Technique::Tree, Technique::LowRank}) {
    const char* names[] = {"exact", "tree", "epipolar", "low rank"};
    FrameCase item = make(names[static_cast<int>(technique)] + std::string(", glass"), technique);
    item.glass = true;
    all.push_back(item);
  }
  FrameCase bilinear = make("epipolar, bilinear and glass", Technique::Epipolar, kAll);
  bilinear.bilinear = bilinear.glass = true;
  all.push_back(bilinear);
  bilinear = make("tree, bilinear", Technique::Tree);
  bilinear.bilinear = true;
  all.push_back(bilinear);
  FrameCase spread = make("epipolar, spread", Technique::Epipolar, kColour, {kSun, kSpot});
  spread.spread = true;
  all.push_back(spread);
  FrameCase chosen = make("epipolar, error target", Technique::Epipolar);
  chosen.chosen = true;
  all.push_back(chosen);
  chosen = make("epipolar, error target, two lights, all targets", Technique::Epipolar, kAll, {kSun, kSpot});
  chosen.chosen = chosen.bilinear = chosen.glass = true;
  all.push_back(chosen);
  chosen = make("epipolar, error target, lamp in parts", Technique::Epipolar, kColour, {kLamp});
  chosen.chosen = true;
  chosen.maxTextureSize = 64;
  all.push_back(chosen);
  chosen = make("epipolar, error target, multisampled depth", Technique::Epipolar);
  chosen.chosen = chosen.multisampled = true;
  all.push_back(chosen);
  for (const Technique technique : {Technique::Epipolar, Technique::Exact}) {
    all.push_back(make(technique == Technique::Exact ? "exact, height fog" : "epipolar, height fog", technique));
    all.back().fog = true;
    all.push_back(all.back());
    all.back().name += ", two lights, all targets";
    all.back().lights = {kLamp, kSpot};
    all.back().targets = kAll;
  }
  all.push_back(make("exact, ambient light", Technique::Exact));
  all.back().ambient = true;
  all.push_back(
      make("epipolar, ambient light, height fog, two lights, all targets", Technique::Epipolar, kAll, {kSun, kSpot}));
  all.back().ambient = all.back().fog = true;
  FrameCase lookup = make("epipolar, look-up, two lights", Technique::Epipolar, kColour, {kSun, kSpot});
  lookup.lookup = lookup.ambient = true;
  all.push_back(lookup);
  lookup = make("tree, look-up, lamp in parts", Technique::Tree, kColour, {kLamp});
  lookup.lookup = true;
  lookup.maxTextureSize = 64;
  all.push_back(lookup);
  lookup = make("low rank, look-up, glass", Technique::LowRank);
  lookup.lookup = lookup.glass = true;
  all.push_back(lookup);
  all.push_back(make("epipolar, smoke before the eye, ambient light", Technique::Epipolar, kColour, {kSpot}));
  all.back().smoke = all.back().ambient = true;
  FrameCase bright = make("epipolar, sum over what colour holds", Technique::Epipolar, kAll, {kSun, kSpot});
  bright.bright = true;
  all.push_back(bright);
  bright = make("epipolar, sun and surroundings over what colour holds", Technique::Epipolar, kAll);
  bright.bright = bright.ambient = true;
  all.push_back(bright);
  FrameCase samples = make("exact, multisampled depth", Technique::Exact);
  samples.multisampled = true;
  all.push_back(samples);
  all.push_back(make("epipolar, lamp in parts", Technique::Epipolar, kColour, {kLamp}));
  all.back().maxTextureSize = 64;
  all.push_back(make("tree, lamp in parts", Technique::Tree, kAll, {kLamp}));
  all.back().maxTextureSize = 64;
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
    const char* names[] = {"exact", "tree", "epipolar"};
    FrameCase curves = make(names[static_cast<int>(technique)] + std::string(", curves"), technique);
    curves.curves = true;
    all.push_back(curves);
  }
}

void addLayouts(std::vector<FrameCase>& all) {
  const auto add = [&all](FrameCase item, Layout layout) {
    item.layout = layout;
    all.push_back(std::move(item));
  };
  FrameCase glass = make("epipolar, cube and glass", Technique::Epipolar, kColour, {kLamp});
  glass.glass = true;
  add(glass, Layout::Cube);
  add(make("exact, cube of an array", Technique::Exact, kColour, {kLamp}), Layout::CubeArray);
  add(make("tree, lamp's atlas", Technique::Tree, kColour, {kLamp}), Layout::Atlas);
  FrameCase copied = make("epipolar, lamp's atlas, bilinear and glass", Technique::Epipolar, kColour, {kLamp});
  copied.bilinear = copied.glass = true;
  add(copied, Layout::Atlas);
}

void addViews(std::vector<FrameCase>& all) {
  for (int view = 1; view < static_cast<int>(DebugView::Redrawn); ++view) {
    FrameCase item = make("view " + std::to_string(view), Technique::Epipolar);
    item.view = static_cast<DebugView>(view);
    all.push_back(item);
  }
  all.push_back(make("view of inputs", Technique::Epipolar));
  all.back().view = DebugView::Inputs;
  for (const DebugView view : {DebugView::Slices, DebugView::NodeVisits, DebugView::Difference})
    for (const Technique technique : {Technique::Tree, Technique::LowRank}) {
      const std::string name = technique == Technique::Tree ? "tree" : "low rank";
      FrameCase item = make(name + ", view " + std::to_string(static_cast<int>(view)), technique);
      item.view = view;
      all.push_back(item);
    }
  FrameCase outputs = make("view 9, two lights, all targets", Technique::Epipolar, kAll, {kSun, kSpot});
  outputs.view = DebugView::Difference;
  all.push_back(outputs);
}

FrameCase reusing(const std::string& name, Changes changes, int before, Motion motion) {
  FrameCase item = make(name, Technique::Epipolar);
  item.changes = changes;
  item.before = before;
  item.motion = motion;
  return item;
}

void addReuse(std::vector<FrameCase>& all) {
  all.push_back(reusing("detect, first frame", Changes::Detect, 0, Motion::Box));
  all.push_back(reusing("detect, a part", Changes::Detect, 1, Motion::Box));
  all.push_back(reusing("detect, third frame", Changes::Detect, 2, Motion::Box));
  all.push_back(reusing("detect, a part, look-up, ambient light", Changes::Detect, 1, Motion::Box));
  all.back().lookup = all.back().ambient = true;
  all.push_back(reusing("detect, nothing", Changes::Detect, 1, Motion::None));
  all.push_back(reusing("objects, first frame", Changes::Objects, 0, Motion::Box));
  all.push_back(reusing("objects, a part", Changes::Objects, 1, Motion::Box));
  all.push_back(reusing("objects, third frame", Changes::Objects, 2, Motion::Box));
  all.push_back(reusing("objects, nothing", Changes::Objects, 1, Motion::None));
  all.push_back(reusing("objects, mesh", Changes::Objects, 1, Motion::Mesh));
  all.push_back(reusing("objects, mesh of a version", Changes::Objects, 1, Motion::Mesh));
  all.back().versionedMesh = true;
  all.push_back(reusing("objects, refreshed", Changes::Objects, 1, Motion::Box));
  all.back().refreshFrames = 8;
  all.push_back(reusing("detect, two lights, all targets", Changes::Detect, 1, Motion::Box));
  all.back().targets = kAll;
  all.back().lights = {kSun, kSpot};
  all.push_back(reusing("objects, lamp, both outputs", Changes::Objects, 1, Motion::Box));
  all.back().targets = kBoth;
  all.back().lights = {kLamp};
  all.push_back(reusing("detect, glass and bilinear", Changes::Detect, 1, Motion::Box));
  all.back().glass = all.back().bilinear = true;
  all.push_back(reusing("detect, spread", Changes::Detect, 1, Motion::Box));
  all.back().spread = true;
  all.push_back(reusing("detect, lamp in parts", Changes::Detect, 1, Motion::Box));
  all.back().lights = {kLamp};
  all.back().maxTextureSize = 64;
  all.push_back(reusing("detect, cube and spot", Changes::Detect, 1, Motion::Box));
  all.back().lights = {kLamp, kSpot};
  all.back().layout = Layout::Cube;
  all.push_back(reusing("tree, detect", Changes::Detect, 1, Motion::Box));
  all.back().technique = Technique::Tree;
  all.push_back(reusing("exact, objects", Changes::Objects, 1, Motion::Box));
  all.back().technique = Technique::Exact;
  all.push_back(reusing("detect, curves", Changes::Detect, 1, Motion::Box));
  all.back().curves = true;
  for (const Changes changes : {Changes::Detect, Changes::Objects}) {
    const std::string name = changes == Changes::Detect ? "detect" : "objects";
    all.push_back(reusing(name + ", redrawn, first frame", changes, 0, Motion::Box));
    all.back().view = DebugView::Redrawn;
    all.push_back(reusing(name + ", redrawn, a part", changes, 1, Motion::Box));
    all.back().view = DebugView::Redrawn;
  }
}

void addPlaces(std::vector<FrameCase>& all) {
  const auto add = [&all](const std::string& name, FrameCase item, bool elsewhere, bool layered) {
    item.name = name;
    item.elsewhere = elsewhere;
    item.layered = layered;
    all.push_back(item);
  };
  const FrameCase lit = make({}, Technique::Epipolar, kColour, {kSun, kSpot}), all3 = make({}, Technique::Exact, kAll);
  FrameCase copied = lit, part = reusing({}, Changes::Detect, 1, Motion::Box);
  copied.tuning.compositing = Compositing::Copy;
  add("elsewhere, two lights", lit, true, false);
  add("elsewhere, all targets", all3, true, false);
  add("layers, two lights", lit, false, true);
  add("layers, all targets", all3, false, true);
  add("layers, colour copied", copied, false, true);
  add("layers elsewhere, detect", part, true, true);
}

// The masks and the composite that are not the table's in software, and all of one kind.
void addTunings(std::vector<FrameCase>& all) {
  const auto add = [&all](const std::string& name, const FrameCase& like, const Tuning& tuning) {
    all.push_back(like);
    all.back().name = name;
    all.back().tuning = tuning;
  };
  const FrameCase part = reusing({}, Changes::Detect, 1, Motion::Box);
  FrameCase lights = part, redrawn = part, spread = make({}, Technique::Epipolar, kColour, {kSun, kSpot});
  lights.lights = {kSun, kSpot};
  redrawn.view = DebugView::Redrawn;
  spread.spread = true;
  const auto stencil = Masking::Stencil, tiles = Masking::Tiles;
  add("detect, by the stencil", part, {stencil, stencil});
  add("detect, two lights, by the stencil, fix-up by tiles", lights, {stencil, tiles});
  add("detect, two lights, by tiles", lights, {tiles, tiles});
  add("detect, redrawn, by the stencil", redrawn, {stencil, stencil});
  add("objects, by the stencil", reusing({}, Changes::Objects, 1, Motion::Box), {stencil, stencil});
  add("epipolar, fix-up by tiles", make({}, Technique::Epipolar), {{}, tiles});
  add("epipolar, spread, fix-up by tiles", spread, {{}, tiles});
  add("epipolar, colour copied", make({}, Technique::Epipolar), {{}, {}, Compositing::Copy});
  add("exact, two lights, colour copied", make({}, Technique::Exact, kColour, {kSun, kSpot}),
      {{}, {}, Compositing::Copy});
  add("low rank, colour copied", make({}, Technique::LowRank), {{}, {}, Compositing::Copy});
  add("detect, colour copied", part, {{}, {}, Compositing::Copy});
}

// Curves of one veil over the middle of a map, made once.
AvsmCurves veil() {
  static AvsmRig rig(configOf(CurveReduction::Sorted, 16, 4, true));
  static const bool captured = [] {
    std::vector<Captured> segments;
    for (int y = 4; y < 12; ++y)
      for (int x = 4; x < 12; ++x)
        segments.push_back({{x, y, 0}, 0.3F, 0.7F, 0.5F});
    rig.capture(segments);
    return true;
  }();
  static_cast<void>(captured);
  AvsmCurves curves = rig.avsm().curves();
  curves.version = 1;
  return curves;
}

Light lightOf(LightKind kind) {
  if (kind == kSpot) return reuse::spot();
  return kind == kLamp ? reuse::point() : reuse::sun();
}

// The eight corners of a cube from -1 to 1.
std::vector<float> cornersOf(const glm::dmat4& worldFromCube) {
  std::vector<float> values;
  for (int i = 0; i < 8; ++i) {
    const auto sign = [&](int axis) { return (i >> axis & 1) != 0 ? 1.0 : -1.0; };
    const glm::vec3 corner(worldFromCube * glm::dvec4(sign(0), sign(1), sign(2), 1));
    values.insert(values.end(), {corner.x, corner.y, corner.z});
  }
  return values;
}

} // namespace

const std::vector<FrameCase>& frameCases() {
  static const std::vector<FrameCase> all = [] {
    std::vector<FrameCase> list;
    addTechniques(list);
    addInputs(list);
    addLayouts(list);
    addViews(list);
    addReuse(list);
    addPlaces(list);
    addTunings(list);
    return list;
  }();
  return all;
}

const FrameCase& frameCase(std::string_view name) {
  const auto found =
      std::find_if(frameCases().begin(), frameCases().end(), [&](const FrameCase& c) { return c.name == name; });
  REQUIRE(found != frameCases().end());
  return *found;
}

Config configFor(const FrameCase& frameCase, GlLoader loader, PassTiming timing) {
  return {loader, timing, {}, StateMode::Restore, frameCase.tuning};
}

bool canDraw(const FrameCase& frameCase) {
  const int needed = frameCase.curves || frameCase.smoke ? 43 : frameCase.layout == Layout::CubeArray ? 40 : 33;
  return testContext().glVersion() >= needed;
}

Stage::Stage(const FrameCase& frameCase, int width, int height, RigContext context)
    : case_(frameCase), width_(width), height_(height), rig_(width, height, context),
      targetWidth_(width + (frameCase.elsewhere ? 9 : 0)), targetHeight_(height + (frameCase.elsewhere ? 7 : 0)),
      values_(4 * static_cast<std::size_t>(targetWidth_ * targetHeight_ * (frameCase.layered ? 2 : 1)), kBefore) {
  Frame& frame = rig_.scene.frame;
  for (const LightKind kind : case_.lights) {
    Light light = lightOf(kind);
    if (case_.layout && kind == kLamp) light.shadow.views = faceViews(light);
    rig_.addLight(light, kMapSize, case_.glass);
    if (case_.curves) frame.lights.back().curves = veil();
    if (case_.bright) frame.lights.back().colour = {3e6F, 2e6F, 1e6F};
  }
  Settings& settings = frame.settings;
  settings.technique = case_.technique;
  settings.debugView = case_.view;
  settings.slices = 32;
  settings.samples = 64;
  settings.shadowFilter = case_.bilinear ? ShadowFilter::Bilinear : ShadowFilter::Nearest;
  if (case_.fog) {
    frame.medium.layers = {{0, 2, -1}};
    frame.medium.constituents.front().layer = 0;
  }
  if (case_.ambient) {
    frame.ambient.radiance = {0.2F, 0.3F, 0.4F};
    frame.ambient.harmonics[1] = {0.1F, 0.1F, 0.1F};
    occlusion_ = floatTexture(GL_R32F, 3, 2, {0, 0.25F, 1, 0.75F, 0.5F, 1});
    frame.ambient.occlusion = {occlusion_.name(), 1};
  }
  if (case_.smoke) frame.eyeCurves = {veil(), 1, 30};
  if (case_.lookup) {
    const std::vector<float> none(static_cast<std::size_t>(4 * kLookupWidth * kLookupHeight * kLookupDepths));
    for (host::GlTexture* texture : {&lookupLight_, &lookupPassed_})
      *texture = floatTextureArray(GL_RGBA32F, kLookupWidth, kLookupHeight, kLookupDepths, none);
    frame.lookup = {lookupLight_.name(), lookupPassed_.name(), 1, 30};
  }
  if (case_.spread) settings.spreadThreshold = 0.02F;
  if (case_.chosen) settings.errorTarget = 0.02F;
  if (case_.multisampled) {
    const std::vector<float> depth = rig_.scene.depth();
    rig_.scene.setMultisampledDepth(4, GL_DEPTH_COMPONENT24, [&](int pixel, int sample) {
      return depth[static_cast<std::size_t>(pixel)] * (1 - 0.1F * static_cast<float>(sample));
    });
  }
  makeTargets();
  if (case_.motion == Motion::Mesh) vertices_ = host::makeBuffer();
  frame.reuse.changes = case_.changes;
  frame.reuse.refreshFrames = case_.refreshFrames;
  frame.reuse.fullShare = 1;
  plain_ = frame.lights.front();
  rewind();
}

void Stage::makeTargets() {
  Frame& frame = rig_.scene.frame;
  const auto makeTarget = [&](GLenum format) {
    return case_.layered ? host::makeTextureArray(format, targetWidth_, targetHeight_, 2)
                         : host::makeTexture2D(format, targetWidth_, targetHeight_);
  };
  colour_ = makeTarget(GL_RGBA16F);
  inscatter_ = makeTarget(GL_RGBA32F);
  transmittance_ = makeTarget(GL_RGBA32F);
  const bool colour = case_.targets.colour || case_.view != DebugView::Composite;
  frame.colour = colour ? colour_.name() : 0;
  frame.output = {case_.targets.inscatter ? inscatter_.name() : 0,
                  case_.targets.transmittance ? transmittance_.name() : 0, case_.layered ? 1 : -1};
  frame.colourLayer = case_.layered ? 1 : -1;
  if (case_.elsewhere) {
    frame.viewport.x = 5;
    frame.viewport.y = 3;
  }
}

void Stage::show(int number) {
  Frame& frame = rig_.scene.frame;
  if (case_.layout) frame.lights.front() = plain_;
  if (case_.motion != Motion::None) rig_.setMoving({reuse::tumbling(number)});
  if (case_.layout) layMaps();
  if (case_.elsewhere) frame.depth.rectangle = {1, 1, width_ - 1, height_ - 1};
  frame.objects.clear();
  if (case_.changes != Changes::Objects || case_.motion == Motion::None) return;
  if (case_.motion == Motion::Box)
    frame.objects = {reuse::between(reuse::tumbling(std::max(number - 1, 0)), reuse::tumbling(number))};
  else
    frame.objects = {reshape(number)};
}

void Stage::layMaps() {
  Light& light = rig_.scene.frame.lights.front();
  plain_ = light;
  laid_.emplace(rig_.scene.shadow(0), *case_.layout, 0.0F);
  laid_->enter(light);
}

// A mesh in world coordinates, whose vertices move.
MovingObject Stage::reshape(int number) {
  const std::vector<float> corners = cornersOf(reuse::tumbling(number));
  gl().BindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  gl().BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(float)), corners.data(),
                  GL_DYNAMIC_DRAW);
  gl().BindBuffer(GL_ARRAY_BUFFER, 0);
  MovingObject object;
  object.mesh = {vertices_.name(), 0, 12, 8, 0};
  if (case_.versionedMesh) object.mesh.version = static_cast<std::uint64_t>(number) + 1;
  return object;
}

void Stage::rewind() {
  number_ = 0;
  frame().reuse.eye = reuse::newView();
  frame().reuse.frame = 0;
  show(0);
}

void Stage::advance() {
  ++frame().reuse.frame;
  show(++number_);
}

void Stage::rest() {
  ++frame().reuse.frame;
  frame().objects.clear();
}

void Stage::fill() {
  const std::vector<float> none(static_cast<std::size_t>(4 * kLookupWidth * kLookupHeight * kLookupDepths));
  for (const host::GlTexture* texture : {&lookupLight_, &lookupPassed_}) {
    if (!case_.lookup) continue;
    gl().BindTexture(GL_TEXTURE_2D_ARRAY, texture->name());
    gl().TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, kLookupWidth, kLookupHeight, kLookupDepths, GL_RGBA, GL_FLOAT,
                       none.data());
    gl().BindTexture(GL_TEXTURE_2D_ARRAY, 0);
  }
  for (const host::GlTexture* texture : {&colour_, &inscatter_, &transmittance_}) {
    if (case_.layered) {
      gl().BindTexture(GL_TEXTURE_2D_ARRAY, texture->name());
      gl().TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, targetWidth_, targetHeight_, 2, GL_RGBA, GL_FLOAT,
                         values_.data());
      gl().BindTexture(GL_TEXTURE_2D_ARRAY, 0);
      continue;
    }
    gl().BindTexture(GL_TEXTURE_2D, texture->name());
    gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, targetWidth_, targetHeight_, GL_RGBA, GL_FLOAT, values_.data());
  }
  gl().BindTexture(GL_TEXTURE_2D, 0);
}

TargetContents Stage::read() const {
  TargetContents contents;
  for (const host::GlTexture* texture : {&colour_, &inscatter_, &transmittance_})
    contents.push_back(case_.layered ? host::readColourArray(texture->name(), targetWidth_, targetHeight_, 1)
                                     : host::readColour(texture->name(), targetWidth_, targetHeight_));
  for (const host::GlTexture* texture : {&lookupLight_, &lookupPassed_})
    for (int layer = 0; case_.lookup && layer < kLookupDepths; ++layer)
      contents.push_back(host::readColourArray(texture->name(), kLookupWidth, kLookupHeight, layer));
  return contents;
}

TargetContents Stage::draw(Effect& effect) {
  fill();
  const Status status = effect.render(frame());
  INFO(case_.name << ": " << status.message);
  REQUIRE(status);
  return read();
}

std::vector<TargetContents> drawFrames(Stage& stage, Effect& effect) {
  std::vector<TargetContents> pictures;
  stage.rewind();
  for (int i = 0; i < 3; ++i) {
    pictures.push_back(stage.draw(effect));
    stage.advance();
  }
  return pictures;
}

} // namespace tests
