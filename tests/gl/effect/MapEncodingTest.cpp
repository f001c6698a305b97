// Depths that are distances, in every format that holds them: the picture is that of window depths of the same texels.
#include "MapLayoutRig.h"
#include "reference/CameraRays.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

using namespace tyndall;
using tests::LaidMaps;
using tests::Layout;
using tests::Measure;
using tests::ShaftRig;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Encoded {
  const char* name;
  DepthEncoding encoding;
  GLenum format;
  bool worldUnits; // else 0 to 1 at the far plane
  double offset = 0;
};

const std::vector<Encoded> kEncodings = {
    {"axial, world units, R32F", DepthEncoding::Axial, GL_R32F, true},
    {"axial, 0 to 1, D32F", DepthEncoding::Axial, GL_DEPTH_COMPONENT32F, false},
    {"axial, world units, R16F", DepthEncoding::Axial, GL_R16F, true},
    {"axial, world units from 3 on, RG32F", DepthEncoding::Axial, GL_RG32F, true, 3},
    {"radial, world units, R32F", DepthEncoding::Radial, GL_R32F, true},
    {"radial, 0 to 1, D24", DepthEncoding::Radial, GL_DEPTH_COMPONENT24, false},
    {"radial, 0 to 1, R16F", DepthEncoding::Radial, GL_R16F, false},
    {"radial, world units, RG32F", DepthEncoding::Radial, GL_RG32F, true},
};

float stored(GLenum format, double value) {
  const auto v = static_cast<float>(value);
  if (format == GL_R16F) return glm::unpackHalf1x16(glm::packHalf1x16(v));
  if (format == GL_DEPTH_COMPONENT24) return static_cast<float>(std::round(value * 16777215.0) / 16777215.0);
  return v;
}

// The maps as an encoding holds them, and, in the light's own, the window depths that those stand for.
reference::ShadowImage encode(const Encoded& how, const Light& light, reference::ShadowImage& image, double far) {
  const Measure measure = how.encoding == DepthEncoding::Radial ? Measure::Radial : Measure::Axial;
  const double unit = how.worldUnits ? 1 : far;
  reference::ShadowImage encoded = image;
  for (std::vector<float> reference::ShadowImage::* maps :
       {&reference::ShadowImage::depth, &reference::ShadowImage::glassDepth}) {
    std::size_t next = 0;
    for (const ShadowView& view : light.shadow.views)
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width && next < (image.*maps).size(); ++x, ++next) {
          const glm::dvec2 ndc(2 * (x + 0.5) / image.width - 1, 2 * (y + 0.5) / image.height - 1);
          float& depth = (image.*maps)[next];
          const double distance =
              depth < 1 ? tests::distanceOf(light, view, ndc, static_cast<double>(depth), measure) : far;
          const float value = stored(how.format, std::min(distance, far) / unit - how.offset);
          (encoded.*maps)[next] = value;
          const double back = how.offset + unit * static_cast<double>(value);
          depth = depth < 1 && distance < far * 0.999
                      ? static_cast<float>(tests::depthOf(light, view, ndc, back, measure))
                      : 1.0F;
        }
  }
  return encoded;
}

void check(LightKind kind, const Encoded& how, Layout layout, bool glass, ShadowFilter filter) {
  CAPTURE(static_cast<int>(kind), how.name, static_cast<int>(layout), glass, static_cast<int>(filter));
  const std::unique_ptr<ShaftRig> rig = tests::layoutRig(kind, glass);
  Light& light = rig->scene.frame.lights[0];
  const double far = kind == LightKind::Directional ? 59 : kind == LightKind::Spot ? 60 : tests::kFaceFar;
  rig->scene.frame.settings.shadowFilter = filter;
  reference::ShadowImage image = rig->scene.shadow(0);
  const reference::ShadowImage encoded = encode(how, light, image, far);
  rig->scene.setShadow(0, image);
  const Light array = light;
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank}) {
    CAPTURE(static_cast<int>(technique));
    const reference::Image truth = rig->picture(technique);
    const LaidMaps maps(encoded, layout, kNan, how.format);
    maps.enter(light);
    light.shadow.encoding = how.encoding;
    light.shadow.scale.unit = how.worldUnits ? 1 : far;
    light.shadow.scale.offset = how.offset;
    CHECK(tests::relativeError(rig->picture(technique), truth) <= 1e-4);
    light = array;
  }
}

void checkAll(LightKind kind, const std::vector<Layout>& layouts) {
  std::size_t turn = 0;
  for (const Encoded& how : kEncodings) {
    if (kind == LightKind::Directional && how.encoding == DepthEncoding::Radial) continue;
    for (const bool glass : {false, true})
      for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear})
        check(kind, how, layouts[turn++ % layouts.size()], glass, filter); // each layout with most of the others
  }
}

} // namespace

TEST_CASE("a sun's depths along its views' axes give the picture of window depths", "[sweep]") {
  checkAll(LightKind::Directional, {Layout::Array, Layout::Atlas, Layout::Sheets});
}

TEST_CASE("a lamp's depths that are distances give the picture of window depths", "[sweep]") {
  checkAll(LightKind::Point, {Layout::Cube, Layout::CubeArray, Layout::Atlas, Layout::Array, Layout::Sheets});
}

TEST_CASE("a spot's depths that are distances give the picture of window depths") {
  checkAll(LightKind::Spot, {Layout::Array, Layout::Atlas, Layout::Sheets});
}

TEST_CASE("formats of one and two channels hold window depth, too") {
  for (const GLenum format : {GL_R16F, GL_RG32F}) {
    const std::unique_ptr<ShaftRig> rig = tests::layoutRig(LightKind::Point, true);
    Light& light = rig->scene.frame.lights[0];
    reference::ShadowImage image = rig->scene.shadow(0);
    for (std::vector<float>* maps : {&image.depth, &image.glassDepth})
      for (float& depth : *maps)
        depth = stored(format, static_cast<double>(depth));
    rig->scene.setShadow(0, image);
    const Light array = light;
    for (const Technique technique : {Technique::Exact, Technique::Epipolar}) {
      const reference::Image truth = rig->picture(technique);
      for (const Layout layout : {Layout::Atlas, Layout::Cube}) {
        CAPTURE(format, static_cast<int>(technique), static_cast<int>(layout));
        const LaidMaps maps(image, layout, kNan, format);
        maps.enter(light);
        CHECK(tests::identical(rig->picture(technique), truth));
        light = array;
      }
    }
  }
}

TEST_CASE("distances that are none, at or beyond the far plane, or before the near plane, block as window depth does") {
  for (const DepthEncoding encoding : {DepthEncoding::Axial, DepthEncoding::Radial}) {
    const std::unique_ptr<ShaftRig> rig = tests::layoutRig(LightKind::Point, false);
    Light& light = rig->scene.frame.lights[0];
    const reference::ShadowImage before = rig->scene.shadow(0);
    const Light array = light;
    const auto pictureOf = [&](float value, bool window) {
      reference::ShadowImage image = before;
      std::fill(image.depth.begin(), image.depth.end(), value);
      const LaidMaps maps(image, Layout::Cube, 0);
      maps.enter(light);
      if (!window) light.shadow.encoding = encoding;
      const reference::Image picture = rig->picture(Technique::Exact);
      light = array;
      return picture;
    };
    const reference::Image lit = pictureOf(1, true), dark = pictureOf(0, true);
    const auto far = static_cast<float>(tests::kFaceFar);
    CHECK(tests::relativeError(dark, lit) > 0.1);
    for (const float value :
         {far, 2 * far, std::numeric_limits<float>::infinity(), kNan, -std::numeric_limits<float>::infinity()}) {
      CAPTURE(static_cast<int>(encoding), value);
      CHECK(tests::identical(pictureOf(value, false), lit));
    }
    for (const float value : {0.0F, -3.0F, 0.1F}) {
      CAPTURE(static_cast<int>(encoding), value);
      CHECK(tests::identical(pictureOf(value, false), dark));
    }
  }
}
