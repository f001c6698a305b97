// Shadow and glass maps of a random frame.
#include "Case.h"

#include "reference/CameraRays.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace stress {

namespace {

struct ViewForm {
  bool reversed = false;
  ClipDepth clipDepth = ClipDepth::NegativeOneToOne;
  bool isOfFloats = false; ///< matrices as most engines have them
  double near = 0.1, far = 60;
};

/// From a matrix for z from -1 to 1.
glm::dmat4 inForm(glm::dmat4 clip, const ViewForm& form) {
  for (int c = 0; c < 4; ++c) {
    if (form.reversed) clip[c][2] = -clip[c][2];
    if (form.clipDepth == ClipDepth::ZeroToOne) clip[c][2] = 0.5 * (clip[c][2] + clip[c][3]);
  }
  return clip;
}

Mat4 finished(const glm::dmat4& clip, const glm::dmat4& view, const ViewForm& form) {
  const glm::dmat4 whole = inForm(clip, form) * view;
  return tests::toMat4(form.isOfFloats ? glm::dmat4(glm::mat4(whole)) : whole);
}

glm::dvec3 upFor(const glm::dvec3& direction, Random& random) {
  const glm::dvec3 up = random.direction();
  return std::abs(glm::dot(glm::normalize(direction), up)) < 0.99 ? up : glm::dvec3(up.y, up.z, -up.x);
}

void viewSun(const Case& made, Light& light, const ViewForm& form, bool isSimple, Random& random, Random& family) {
  const EyeFrame eye(made.frame.camera);
  const glm::dvec3 direction = glm::normalize(reference::toVec3(light.direction));
  const int cascades = isSimple || family.chance(0.5) ? 1 : family.integer(2, 4);
  const bool fades = family.chance(0.3);
  double extent = isSimple ? 12 : random.logUniform(0.5, 30);
  for (int i = 0; i < cascades; ++i, extent *= isSimple ? 2 : random.uniform(1.2, 4)) {
    const glm::dvec3 centre = eye.position + (isSimple ? 0 : random.uniform(0, extent)) * eye.forward() +
                              (isSimple ? 0 : 0.3 * extent) * random.direction();
    const glm::dmat4 view = glm::lookAt(centre - 30.0 * direction, centre, upFor(direction, random));
    light.shadow.views.push_back({finished(glm::ortho(-extent, extent, -extent, extent, 1.0, 60.0), view, form), i});
  }
  if (!isSimple && fades) light.cascadeFade = random.uniform(0, 0.5);
}

void viewSpot(const Case& made, Light& light, ViewForm form, bool isSimple, Random& random) {
  const glm::dvec3 position = reference::toVec3(light.position),
                   direction = glm::normalize(reference::toVec3(light.direction));
  double width = isSimple ? 1.1 : random.pick({1.0, 1 + 1e-6, 1.2, 0.7, random.uniform(1, 2)});
  const EyeFrame eye(made.frame.camera);
  const double ofEye = glm::dot(eye.position - position, direction);
  if (!isSimple && random.chance(0.1) && ofEye > 1e-3) form.near = ofEye; // the eye on the map's near plane
  form.far = std::max(form.far, 1.5 * form.near);
  width = std::clamp(2 * width * light.outerConeAngle, 1e-4, 3.12);
  const bool isInfinite = !isSimple && random.chance(0.1);
  const glm::dmat4 clip =
      isInfinite ? glm::infinitePerspective(width, 1.0, form.near) : glm::perspective(width, 1.0, form.near, form.far);
  light.shadow.views = {
      {finished(clip, glm::lookAt(position, position + direction, upFor(direction, random)), form), 0}};
}

void viewPoint(Light& light, const ViewForm& form) {
  light.shadow.views = tests::faceViews(light);
  glm::dmat4 clip = glm::perspective(glm::half_pi<double>(), 1.0, form.near, form.far);
  clip[0][0] = clip[1][1] = 1;
  const glm::dmat4 faceClip = [&] {
    glm::dmat4 m = glm::perspective(glm::half_pi<double>(), 1.0, tests::kFaceNear, tests::kFaceFar);
    m[0][0] = m[1][1] = 1;
    return m;
  }();
  for (ShadowView& view : light.shadow.views)
    view.clipFromWorld = finished(clip, glm::inverse(faceClip) * reference::toMat4(view.clipFromWorld), form);
}

/// What blocks the light, as shares of the distance from the near to the far plane; 1: nothing.
struct Casters {
  enum Kind { Lit, Dark, Blocks, Noise, Bars, Ramp, Checker } kind = Blocks;
  double litShare = 0.5;
  int period = 3;

  /// Of a map that is so many texels wide.
  bool isNoise(int width) const {
    return kind == Noise || (kind == Bars && period == 2) || (kind == Checker && period <= 2) ||
           (kind == Blocks && width < 8);
  }

  std::vector<double> shares(int width, int height, Random& random) const {
    std::vector<double> shares(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                               kind == Dark ? 0.0 : 1.0);
    const auto each = [&](auto&& at) {
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          shares[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
              at(x, y);
    };
    const double level = random.uniform(0.02, 0.9);
    switch (kind) {
    case Noise:
      each([&](int, int) { return random.chance(litShare) ? 1 : random.uniform(); });
      break;
    case Bars:
      each([&](int x, int) { return x % period == 0 ? level : 1; });
      break;
    case Ramp:
      each([&](int x, int y) { return level * (x + 0.5) / width + 0.1 * (y + 0.5) / height; });
      break;
    case Checker:
      each([&](int x, int y) { return (x / period + y / period) % 2 == 0 ? level : 1; });
      break;
    case Blocks:
      for (int block = 0; block < 12; ++block) {
        const int x0 = random.integer(0, width - 1), y0 = random.integer(0, height - 1),
                  size = random.integer(1, std::max(1, width / 4));
        const double depth = random.uniform(0.02, 0.95), slope = random.uniform(-0.1, 0.1) / width;
        each([&, i = std::size_t{0}](int x, int y) mutable {
          const double old = shares[i++];
          const bool isInside = x >= x0 && x < x0 + size && y >= y0 && y < y0 + size;
          return isInside ? std::min(old, depth + slope * (x - x0)) : old;
        });
      }
      break;
    default:
      break;
    }
    return shares;
  }
};

/// Window depth of a share of the way from near to far, along the axis.
float windowDepth(const ViewForm& form, LightKind kind, double share) {
  if (share >= 1) return form.reversed ? 0 : 1;
  double depth = std::clamp(share, 0.0, 1.0);
  if (kind != LightKind::Directional) {
    const double distance = form.near * std::pow(form.far / form.near, depth);
    depth = (1 - form.near / distance) * form.far / (form.far - form.near);
  }
  return static_cast<float>(form.reversed ? 1 - depth : depth);
}

std::vector<float> makeTexels(const ViewForm& form, LightKind kind, const reference::ShadowImage& image,
                              const Casters& casters, Random& random) {
  std::vector<float> texels;
  for (int layer = 0; layer < image.layers; ++layer)
    for (const double share : casters.shares(image.width, image.height, random))
      texels.push_back(windowDepth(form, kind, share));
  return texels;
}

void addOddTexels(Case& made, LightMaps& maps, Random& random) {
  for (int i = random.integer(1, 6); i > 0; --i)
    maps.image.depth[static_cast<std::size_t>(random.integer(0, static_cast<int>(maps.image.depth.size()) - 1))] =
        static_cast<float>(random.pick({std::nan(""), kInfinity, -kInfinity, -0.5, 1.5, -1e30, 1e30}));
  made.hasOddTexels = true;
  maps.format = GL_R32F;
}

void makeGlass(LightMaps& maps, const ViewForm& form, LightKind kind, Random& random) {
  for (std::size_t i = 0; i < 3 * maps.image.depth.size(); ++i)
    maps.image.glassColour.push_back(
        static_cast<float>(random.chance(0.2) ? random.pick({0.0, 1.0}) : random.uniform()));
  Casters panes{random.pick({Casters::Blocks, Casters::Checker, Casters::Noise, Casters::Dark}), 0.3,
                random.integer(1, 4)};
  maps.image.glassDepth = makeTexels(form, kind, maps.image, panes, random);
}

void makeLayout(LightMaps& maps, Random& random) {
  using tests::Layout;
  maps.layout = random.pick({Layout::Array, Layout::Array, Layout::Atlas, Layout::Sheets});
  if (maps.image.width > 4096) maps.layout = Layout::Array; // tiles side by side would pass what textures may have
  if (maps.format == GL_R32F) return;
  maps.format = random.pick({GL_R32F, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT32F});
  if (maps.layout == Layout::Array)
    maps.format = random.pick({GL_R32F, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT16});
  maps.isCompared = maps.format != GL_R32F && random.chance(0.3);
}

} // namespace

void makeMaps(Case& made, const AxisSet& simple) {
  Random views(made.seed, Axis::Views), sizes(made.seed, Axis::MapSize), texels(made.seed, Axis::Texels),
      odd(made.seed, Axis::OddTexels), panes(made.seed, Axis::Glass);
  Random forms = Random::ofFamily(made.seed, Axis::Views), hasMap = Random::ofFamily(made.seed, Axis::Texels),
         odds = Random::ofFamily(made.seed, Axis::OddTexels), layouts = Random::ofFamily(made.seed, Axis::Layout),
         glass = Random::ofFamily(made.seed, Axis::Glass);
  const bool isSimple = simple.has(Axis::Views);
  for (Light& light : made.frame.lights) {
    LightMaps maps;
    made.maps.emplace_back();
    if (!simple.has(Axis::Texels) && hasMap.chance(0.1)) continue; // no map at all
    const bool hasGlass = glass.chance(0.25) && !simple.has(Axis::Glass);
    ViewForm form;
    if (!isSimple) {
      form.reversed = forms.chance(0.3);
      form.clipDepth = forms.chance(0.3) ? ClipDepth::ZeroToOne : ClipDepth::NegativeOneToOne;
      form.isOfFloats = views.chance(0.2);
      form.near = views.logUniform(1e-3, 0.5);
      form.far = form.near * views.logUniform(50, 1e5);
    }
    light.shadow.clipDepth = form.clipDepth;
    maps.isOfFloats = form.isOfFloats;
    if (light.kind == LightKind::Directional) viewSun(made, light, form, isSimple, views, forms);
    if (light.kind == LightKind::Spot) viewSpot(made, light, form, isSimple, views);
    if (light.kind == LightKind::Point) viewPoint(light, form);
    maps.image.width = maps.image.height = 32;
    if (!simple.has(Axis::MapSize)) {
      maps.image.width = maps.image.height = sizes.pick({1, 2, 3, 8, 16, 17, 32, 64, 100});
      if (sizes.chance(0.1)) maps.image.height = sizes.integer(1, 40);
      // With glass or several views a ray could take more than the 65,535 steps after which llvmpipe ends a loop.
      const bool mayBeWide = !hasGlass && light.shadow.views.size() == 1;
      if (sizes.chance(0.01) && mayBeWide) maps.image.width = 8192, maps.image.height = sizes.integer(1, 2);
    }
    maps.image.layers = static_cast<int>(light.shadow.views.size());
    Casters casters;
    if (!simple.has(Axis::Texels)) {
      casters.kind = static_cast<Casters::Kind>(texels.integer(Casters::Lit, Casters::Checker));
      casters.litShare = texels.uniform();
      casters.period = texels.integer(1, 6);
    }
    maps.isNoise = casters.isNoise(maps.image.width);
    maps.image.depth = makeTexels(form, light.kind, maps.image, casters, texels);
    if (const bool isOdd = odds.chance(0.15); isOdd && !simple.has(Axis::OddTexels)) addOddTexels(made, maps, odd);
    if (!simple.has(Axis::Layout)) makeLayout(maps, layouts);
    if (hasGlass) makeGlass(maps, form, light.kind, panes);
    made.maps.back() = std::move(maps);
  }
}

} // namespace stress
