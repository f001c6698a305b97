#include "Case.h"

#include "reference/CameraRays.h"

#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace stress {

namespace {

constexpr const char* kRelationNames[] = {"scale",        "offset",     "mirror",      "roll",       "depth",
                                          "double light", "half media", "light order", "split light"};
static_assert(std::size(kRelationNames) == kRelations);

} // namespace

const char* nameOf(Relation relation) { return kRelationNames[static_cast<int>(relation)]; }

Vec3 toVec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Mat4 Lens::clipFromView(double aspect) const {
  const glm::dmat4 clip = reference::toMat4(convention.clipFromView(size, aspect));
  return tests::toMat4(glm::translate(glm::dmat4(1), glm::dvec3(shift, 0)) * clip);
}

EyeFrame::EyeFrame(const Camera& camera) {
  const glm::dmat4 worldFromView = glm::inverse(reference::toMat4(camera.viewFromWorld));
  axes = glm::dmat3(worldFromView);
  position = glm::dvec3(worldFromView[3]);
}

glm::dvec3 pixelDirection(const Case& made, Random& random) {
  const Rectangle& viewport = made.frame.viewport;
  const int x = random.integer(0, viewport.width - 1), y = random.integer(0, viewport.height - 1);
  return reference::CameraRays(made.frame.camera, viewport.width, viewport.height).ray(x, y).direction;
}

void makeMedium(Case& made, const AxisSet& simple) {
  Medium& medium = made.frame.medium;
  medium.constituents = {{{0.05F, 0.1F, 0.2F}, Phase::HenyeyGreenstein, 0.3F}};
  if (Random random(made.seed, Axis::Medium); !simple.has(Axis::Medium)) {
    medium.constituents.clear();
    Random family = Random::ofFamily(made.seed, Axis::Medium);
    const int count = family.chance(0.05) ? 0 : family.integer(1, kMaxConstituents);
    const bool isGrey = family.chance(0.3), isExtreme = random.chance(0.4);
    const auto sigma = [&] {
      if (random.chance(0.05)) return 0.0F;
      return static_cast<float>(isExtreme ? random.logUniform(1e-7, 1e4) : random.logUniform(1e-3, 1));
    };
    const auto colour = [&] {
      const float grey = sigma();
      return isGrey ? Rgb{grey, grey, grey} : Rgb{sigma(), sigma(), sigma()};
    };
    for (int i = 0; i < count; ++i) {
      Constituent constituent;
      constituent.scattering = colour();
      constituent.phase = static_cast<Phase>(family.integer(0, 3));
      constituent.g = static_cast<float>(random.chance(0.3) ? random.pick({-0.999, 0.999, 0.0, 0.99, -0.99})
                                                            : random.uniform(-0.95, 0.95));
      medium.constituents.push_back(constituent);
    }
    if (family.chance(0.3)) medium.absorption = colour();
  }
  if (Random random(made.seed, Axis::FarDistance); !simple.has(Axis::FarDistance))
    medium.farDistance = random.chance(0.3) ? kInfinity : random.logUniform(0.01, 1e4);
  else
    medium.farDistance = 30;
  // A ray without end in a medium without extinction has no finite answer, in some channel, with light without end.
  for (std::size_t c = 0; c < 3; ++c) {
    float extinction = medium.absorption[c];
    for (const Constituent& constituent : medium.constituents)
      extinction += constituent.scattering[c];
    if (extinction < 1e-6F && std::isinf(medium.farDistance)) medium.farDistance = 100;
  }
}

// In every second family some of what is in the air follows one layer, or two.
void makeLayers(Case& made, const AxisSet& simple) {
  if (simple.has(Axis::Layers)) return;
  Medium& medium = made.frame.medium;
  Random random(made.seed, Axis::Layers), family = Random::ofFamily(made.seed, Axis::Layers);
  const int count = std::max(family.integer(-1, kMaxHeightLayers), 0);
  const bool isExtreme = random.chance(0.2);
  for (int i = 0; i < count; ++i) {
    HeightLayer layer;
    layer.scale = isExtreme ? random.logUniform(1e-3, 1e9) : random.logUniform(0.3, 100);
    layer.height = random.uniform(-4, 4) * std::min(layer.scale, 100.0) + random.uniform(-3, 3);
    if (random.chance(0.5)) layer.ground = layer.height + random.uniform(-9, 2) * layer.scale;
    if (random.chance(0.05)) layer.scale = kInfinity;
    medium.layers.push_back(layer);
  }
  if (random.chance(0.5)) {
    const glm::dvec3 up = random.uniform(0.1, 9) * random.direction();
    medium.up = {up.x, up.y, up.z};
  }
  for (Constituent& constituent : medium.constituents)
    constituent.layer = family.integer(-1, count - 1);
  medium.absorptionLayer = family.integer(-1, count - 1);
}

// In every third family surroundings shine: alike from all sides, or by harmonics that may fall below 0.
void makeAmbient(Case& made, const AxisSet& simple) {
  if (simple.has(Axis::Ambient)) return;
  Random random(made.seed, Axis::Ambient), family = Random::ofFamily(made.seed, Axis::Ambient);
  made.frame.medium.dimsBackground = !random.chance(0.1);
  for (Light& light : made.frame.lights)
    if (random.chance(0.1)) light.scatteringScale = static_cast<float>(random.logUniform(0.1, 10));
  if (!family.chance(0.33)) return;
  const double bright = random.logUniform(1e-3, 10);
  for (float& channel : made.frame.ambient.radiance)
    channel = static_cast<float>(bright * random.uniform(0, 1));
  if (random.chance(0.5)) return;
  for (Rgb& harmonic : made.frame.ambient.harmonics)
    for (float& channel : harmonic)
      channel = static_cast<float>(0.5 * bright * random.uniform(-1, 1));
}

void makeLookup(Case& made, const AxisSet& simple) {
  Random random(made.seed, Axis::Lookup);
  if (simple.has(Axis::Lookup) || !random.chance(0.3)) return;
  made.lookup = {random.integer(1, 40), random.integer(1, 40), random.integer(2, 12)};
  made.lookupNear = made.worldScale * random.logUniform(1e-3, 10);
  made.lookupFar = made.lookupNear * random.logUniform(1.001, 1e4);
}

// Of curves before the eye every second one is fog: what they take is scattered, and they may dim the picture behind.
void makeFog(Case& made, Random& random) {
  const Medium& medium = made.frame.medium;
  const bool hasFourDark = medium.constituents.size() == kMaxConstituents; // which may be dark in a channel
  if (random.chance(0.5) || medium.absorptionLayer >= 0 || hasFourDark) return;
  // Fog has no sheets: what is taken at one depth is lit where a piece of light is, to a few hundredths.
  for (std::vector<glm::dvec2>& curve : made.eyeCurves.curves)
    for (std::size_t i = 0; i < curve.size(); ++i)
      curve[i].x = glm::round((0.9 * curve[i].x + 0.02 * static_cast<double>(i)) * 65535.0) / 65535.0;
  EyeCurves& eye = made.frame.eyeCurves;
  for (float& channel : eye.albedo)
    channel = random.chance(0.15) ? 0.0F : static_cast<float>(random.uniform());
  eye.phase = static_cast<Phase>(random.integer(0, 3));
  eye.g = static_cast<float>(random.uniform(-0.95, 0.95));
  eye.dimsBackground = random.chance(0.5);
}

// In every fourth family but the first few something stands before the eye: curves of four nodes, 16 bits a number. Of
// the first, of which a test draws hundreds of frames, none: their reference takes three times as long.
void makeEyeCurves(Case& made, const AxisSet& simple) {
  Random random(made.seed, Axis::EyeCurves), family = Random::ofFamily(made.seed, Axis::EyeCurves);
  constexpr std::uint64_t kFirstFamily = 7;
  if (simple.has(Axis::EyeCurves) || made.seed / kFamilySize % kFamilies < kFirstFamily || !family.chance(0.25)) return;
  made.eyeCurves.size = random.integer(1, 8);
  const double most = random.uniform(); // of what each node lets through
  for (int texel = 0; texel < made.eyeCurves.size * made.eyeCurves.size; ++texel) {
    std::vector<glm::dvec2> curve;
    glm::dvec2 node(random.chance(0.2) ? 0 : random.uniform(), 1);
    for (int i = 0; i < 4; ++i) {
      curve.push_back(glm::round(node * 65535.0) / 65535.0);
      node.x += random.chance(0.2) ? 0 : (1 - node.x) * random.uniform();
      node.y *= random.chance(0.1) ? 0 : random.uniform(1 - most, 1);
    }
    made.eyeCurves.curves.push_back(curve);
  }
  made.frame.eyeCurves.nearDistance = random.logUniform(1e-3, 10);
  made.frame.eyeCurves.farDistance = made.frame.eyeCurves.nearDistance * random.logUniform(1.001, 1e4);
  makeFog(made, random);
}

void makeSettings(Case& made, const AxisSet& simple) {
  Settings& settings = made.anySettings;
  if (Random random = Random::ofFamily(made.seed, Axis::Filter); !simple.has(Axis::Filter) && random.chance(0.4))
    made.frame.settings.shadowFilter = ShadowFilter::Bilinear;
  settings.shadowFilter = made.frame.settings.shadowFilter;
  if (Random random(made.seed, Axis::Settings); !simple.has(Axis::Settings)) {
    Random family = Random::ofFamily(made.seed, Axis::Settings);
    settings.technique = family.pick({Technique::Tree, Technique::Epipolar, Technique::Epipolar, Technique::LowRank});
    settings.minMaxTree = family.chance(0.9);
    settings.lowRankTerms = family.integer(1, 8);
    const bool spreads = family.chance(0.4);
    settings.slices = static_cast<int>(random.logUniform(1, 8192));
    settings.samples = 64 * static_cast<int>(random.logUniform(1, 128));
    settings.rowStep = random.integer(1, 8);
    settings.breakThreshold = static_cast<float>(random.logUniform(1e-6, 1e3));
    settings.bendThreshold =
        random.chance(0.2) ? std::numeric_limits<float>::infinity() : static_cast<float>(random.logUniform(1e-6, 1e3));
    settings.leastWeight = static_cast<float>(random.pick({0.0, 1.0, random.uniform()}));
    settings.averageThreshold = static_cast<float>(random.pick({0.0, 1.0, random.uniform()}));
    if (spreads) settings.spreadThreshold = static_cast<float>(random.logUniform(1e-6, 10));
    settings.sampleBudget = random.chance(0.3) ? static_cast<int>(random.logUniform(4096, 1e7)) : 0;
    if (random.chance(0.4)) settings.errorTarget = static_cast<float>(random.logUniform(1e-6, 1));
  }
}

Case makeCase(std::uint64_t seed, const AxisSet& simple) {
  Case made;
  made.seed = seed;
  makePicture(made, simple);
  makeLights(made, simple);
  makeMaps(made, simple);
  makeMedium(made, simple);
  makeLayers(made, simple);
  makeAmbient(made, simple);
  makeLookup(made, simple);
  makeEyeCurves(made, simple);
  makeSettings(made, simple);
  if (Random random = Random::ofFamily(seed, Axis::Relation); !simple.has(Axis::Relation))
    made.relation = static_cast<Relation>(random.integer(0, kRelations - 1));
  if (Random random(seed, Axis::World); !simple.has(Axis::World)) {
    made.worldScale = random.chance(0.5) ? 1 : random.logUniform(1e-4, 1e5);
    const double most = std::min(1e7, 1e9 * made.worldScale); // beyond that doubles do not hold the scene
    const double offset = random.chance(0.5) ? 0 : random.logUniform(1, most);
    tests::transformWorld(made.frame, made.worldScale, offset * random.direction());
  }
  return made;
}

} // namespace stress
