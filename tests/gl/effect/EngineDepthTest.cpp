// The scene depth as engines have it: a part of a larger texture, one of another size, a layer, other encodings.
#include "SceneRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <cmath>
#include <limits>

using namespace tyndall;
using host::gl;

namespace {

constexpr int kWidth = 24, kHeight = 16;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

const std::vector<Technique> kTechniques = {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank};

tests::SceneRig litRig() {
  tests::SceneRig rig(kWidth, kHeight);
  rig.addLight(LightKind::Directional);
  rig.addLight(LightKind::Spot);
  rig.frame.settings.slices = 64;
  rig.frame.settings.samples = 64;
  return rig;
}

// Pictures of all techniques, as the numbers in both outputs.
std::vector<std::vector<float>> pictures(tests::SceneRig& rig, const std::vector<Technique>& techniques = kTechniques) {
  std::vector<std::vector<float>> all;
  for (const Technique technique : techniques) {
    rig.frame.settings.technique = technique;
    const Status status = tests::testEffect().render(rig.frame);
    INFO(status.message);
    REQUIRE(status);
    for (const std::uint32_t output : {rig.frame.output.inscatter, rig.frame.output.transmittance})
      all.push_back(host::readColour(output, kWidth, kHeight, 3));
  }
  return all;
}

void checkBitEqual(const std::vector<std::vector<float>>& a, const std::vector<std::vector<float>>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CAPTURE(i);
    CHECK(tests::bitEqual(a[i], b[i]));
  }
}

bool isDepthFormat(GLenum format) {
  return format == GL_DEPTH_COMPONENT16 || format == GL_DEPTH_COMPONENT24 || format == GL_DEPTH_COMPONENT32F;
}

// One channel of numbers; of an array, layer by layer.
host::GlTexture depthTexture(GLenum format, int width, int height, const std::vector<float>& values) {
  host::GlTexture texture = host::makeTexture2D(format, width, height);
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, isDepthFormat(format) ? GL_DEPTH_COMPONENT : GL_RED,
                     GL_FLOAT, values.data());
  return texture;
}

// The values in a part of a texture of `width` x `height` texels, NaN around them.
std::vector<float> inside(const std::vector<float>& values, const Rectangle& part, int width, int height) {
  std::vector<float> all(static_cast<std::size_t>(width * height), kNan);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x)
      all[static_cast<std::size_t>((part.y + y) * width + part.x + x)] =
          values[static_cast<std::size_t>(y * part.width + x)];
  return all;
}

// What the header says that a pixel's depth is.
std::vector<float> stretched(const std::vector<float>& values, int width, int height) {
  std::vector<float> all;
  for (int j = 0; j < kHeight; ++j)
    for (int i = 0; i < kWidth; ++i) {
      const int x = static_cast<int>(std::floor((i + 0.5) * width / kWidth)),
                y = static_cast<int>(std::floor((j + 0.5) * height / kHeight));
      all.push_back(values[static_cast<std::size_t>(y * width + x)]);
    }
  return all;
}

std::vector<float> someDepth(const tests::SceneRig& rig, int width, int height) {
  std::vector<float> depth;
  for (const double distance : tests::wallDistances(width, height))
    depth.push_back(rig.convention().windowDepth(distance));
  return depth;
}

} // namespace

TEST_CASE("scene depth in a part of a larger texture gives the picture of a texture of just that size", "[sweep]") {
  tests::SceneRig rig = litRig();
  const std::vector<std::vector<float>> expected = pictures(rig);
  const Rectangle part{5, 3, kWidth, kHeight};
  for (const GLenum format : {GL_R32F, GL_DEPTH_COMPONENT32F}) {
    const host::GlTexture larger = depthTexture(format, 40, 30, inside(rig.depth(), part, 40, 30));
    rig.frame.depth.texture = larger.name();
    rig.frame.depth.rectangle = part;
    checkBitEqual(pictures(rig), expected);
  }
  const Rectangle corner{0, 0, kWidth, kHeight}; // needs no copy
  const host::GlTexture larger = depthTexture(GL_R32F, 40, 30, inside(rig.depth(), corner, 40, 30));
  rig.frame.depth.texture = larger.name();
  rig.frame.depth.rectangle = corner;
  checkBitEqual(pictures(rig), expected);
}

TEST_CASE("scene depth of another size is stretched to the nearest texel") {
  for (const auto& [width, height] : {std::pair{12, 8}, {17, 11}, {48, 32}, {1, 1}, {25, 15}}) {
    CAPTURE(width, height);
    tests::SceneRig rig = litRig();
    const std::vector<float> depth = someDepth(rig, width, height);
    rig.setDepth(stretched(depth, width, height));
    const std::vector<std::vector<float>> expected = pictures(rig);
    const Rectangle part{2, 1, width, height};
    const host::GlTexture other = depthTexture(GL_R32F, 64, 64, inside(depth, part, 64, 64));
    rig.frame.depth.texture = other.name();
    rig.frame.depth.rectangle = part;
    checkBitEqual(pictures(rig), expected);
  }
}

TEST_CASE("scene depth in a layer of an array gives the picture of a texture") {
  tests::SceneRig rig = litRig();
  const std::vector<std::vector<float>> expected = pictures(rig);
  std::vector<float> layers(rig.depth().size(), kNan);
  layers.insert(layers.end(), rig.depth().begin(), rig.depth().end());
  layers.resize(3 * rig.depth().size(), kNan);
  const host::GlTexture array = tests::floatTextureArray(GL_DEPTH_COMPONENT32F, kWidth, kHeight, 3, layers);
  rig.frame.depth.texture = array.name();
  rig.frame.depth.layer = 1;
  checkBitEqual(pictures(rig), expected);
}

TEST_CASE("multisampled scene depth in a part of a larger texture, or a layer, gives the picture of one of that size") {
  tests::SceneRig rig = litRig();
  const auto depthOf = [depth = rig.depth()](int pixel, int sample) {
    return depth[static_cast<std::size_t>(pixel)] * (1 - 0.01F * static_cast<float>(sample));
  };
  rig.setMultisampledDepth(4, GL_R32F, depthOf);
  const reference::ImageAnswer expected = rig.render();
  tests::SceneRig larger(40, 30);
  const Rectangle part{5, 3, kWidth, kHeight};
  const auto inLarger = [&](int pixel, int sample) {
    const int x = pixel % 40 - part.x, y = pixel / 40 - part.y;
    return x >= 0 && y >= 0 && x < kWidth && y < kHeight ? depthOf(y * kWidth + x, sample) : kNan;
  };
  larger.setMultisampledDepth(4, GL_R32F, inLarger);
  rig.frame.depth.texture = larger.frame.depth.texture;
  rig.frame.depth.rectangle = part;
  const reference::ImageAnswer answer = rig.render();
  CHECK(answer.inscatter == expected.inscatter);
  CHECK(answer.transmittance == expected.transmittance);
}

TEST_CASE("multisampled scene depth in a layer, or encoded, gives the picture of one that passes can read as it is") {
  for (const Technique technique : {Technique::Exact, Technique::Epipolar, Technique::Tree}) {
    CAPTURE(static_cast<int>(technique));
    tests::SceneRig rig = litRig();
    rig.frame.settings.technique = technique;
    const int width = kWidth, height = kHeight;
    const auto distanceOf = [](int pixel, int sample) { return 3 + 0.01 * pixel + 0.2 * sample; };
    rig.setMultisampledDepth(
        4, GL_R32F, [&](int pixel, int sample) { return rig.convention().windowDepth(distanceOf(pixel, sample)); });
    const reference::ImageAnswer expected = rig.render();
    const host::GlTexture array = host::makeTexture();
    gl().BindTexture(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, array.name());
    gl().TexImage3DMultisample(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, 4, GL_R32F, width, height, 3, GL_TRUE);
    const host::GlFramebuffer from = host::makeFramebuffer(), to = host::makeFramebuffer();
    gl().BindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
    gl().FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE,
                              rig.frame.depth.texture, 0);
    gl().BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.name());
    gl().FramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, array.name(), 0, 2);
    gl().BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
    tests::testContext().takeErrors();
    rig.frame.depth.texture = array.name();
    rig.frame.depth.layer = 2;
    const reference::ImageAnswer layered = rig.render();
    CHECK(layered.inscatter == expected.inscatter);
    CHECK(layered.transmittance == expected.transmittance);
    rig.setMultisampledDepth(4, GL_R32F,
                             [&](int pixel, int sample) { return static_cast<float>(distanceOf(pixel, sample) / 40); });
    rig.frame.depth.encoding = DepthEncoding::Axial;
    rig.frame.depth.scale.unit = 40;
    const reference::ImageAnswer encoded = rig.render();
    CHECK(tests::difference(encoded.inscatter, expected.inscatter) <= 1e-5);
    CHECK(tests::difference(encoded.transmittance, expected.transmittance) <= 1e-5);
  }
}

// ---------------------------------------------------------------------------------------------------------------------

namespace {

// How a distance is stored.
struct Encoding {
  DepthEncoding encoding;
  DepthScale scale;
  double valueOf(double axial, double radial) const {
    if (encoding == DepthEncoding::Logarithmic)
      return std::log1p(scale.constant * axial) / std::log1p(scale.constant * scale.farDistance);
    return ((encoding == DepthEncoding::Radial ? radial : axial) - scale.offset) / scale.unit;
  }
  double axialOf(double value, double radialPerAxial) const {
    if (encoding == DepthEncoding::Logarithmic)
      return std::expm1(value * std::log1p(scale.constant * scale.farDistance)) / scale.constant;
    return (scale.unit * value + scale.offset) / (encoding == DepthEncoding::Radial ? radialPerAxial : 1);
  }
};

// Length of the ray through a pixel where it is 1 away along the axis.
double lengthOf(const tests::SceneRig& rig, std::size_t pixel) {
  const Mat4& p = rig.frame.camera.clipFromView;
  const double x = (2 * (static_cast<int>(pixel) % kWidth + 0.5) / kWidth - 1) / p[0],
               y = (2 * (static_cast<int>(pixel) / kWidth + 0.5) / kHeight - 1) / p[5];
  return std::sqrt(1 + x * x + y * y);
}

// Depth as the encoding has it, skies as `sky`; leaves the rig with the distances that the stored values stand for.
host::GlTexture encode(tests::SceneRig& rig, const Encoding& encoding, GLenum format, double sky) {
  std::vector<float> values;
  for (std::size_t i = 0; i < rig.distances.size(); ++i) {
    const double d = rig.distances[i];
    values.push_back(static_cast<float>(std::isfinite(d) ? encoding.valueOf(d, d * lengthOf(rig, i)) : sky));
  }
  host::GlTexture texture = depthTexture(format, kWidth, kHeight, values);
  const std::vector<float> stored = isDepthFormat(format) ? host::readDepth(texture.name(), kWidth, kHeight)
                                                          : host::readColour(texture.name(), kWidth, kHeight, 1);
  for (std::size_t i = 0; i < rig.distances.size(); ++i)
    if (std::isfinite(rig.distances[i])) rig.distances[i] = encoding.axialOf(stored[i], lengthOf(rig, i));
  return texture;
}

double worst(const std::vector<std::vector<float>>& a, const std::vector<std::vector<float>>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    double mean = 0;
    for (const float v : b[i])
      mean += v / static_cast<double>(b[i].size());
    for (std::size_t k = 0; k < a[i].size(); ++k) {
      const double off = std::abs(a[i][k] - b[i][k]) / std::max<double>(mean, b[i][k]);
      if (!(off <= most)) most = off;
    }
  }
  return most;
}

// A wall without two equal slopes, about which rounding alone would decide; a grey medium, whose light epipolar
// textures hold in 32 bits.
tests::SceneRig bentRig() {
  tests::SceneRig rig = litRig();
  rig.frame.medium.constituents = {{{0.1F, 0.1F, 0.1F}, Phase::HenyeyGreenstein, 0.3F}};
  for (std::size_t i = 0; i < rig.distances.size(); ++i)
    rig.distances[i] += 0.31 * std::sin(1.3 * static_cast<double>(i % kWidth) + 0.77 * static_cast<double>(i / kWidth));
  return rig;
}

// The picture with encoded depth is that with window depth of the distances that it stands for. Coarse formats have
// equal slopes in any case: for them exact's.
void checkEncoding(const tests::DepthConvention& convention, const Encoding& encoding, GLenum format, double sky) {
  CAPTURE(static_cast<int>(encoding.encoding), encoding.scale.unit, encoding.scale.offset, format, sky);
  tests::SceneRig rig = bentRig();
  rig.setConvention(convention);
  const host::GlTexture texture = encode(rig, encoding, format, sky);
  rig.setConvention(convention);
  const std::vector<std::vector<float>> expected = pictures(rig);
  rig.frame.depth = {texture.name()};
  rig.frame.depth.encoding = encoding.encoding;
  rig.frame.depth.scale = encoding.scale;
  const std::vector<std::vector<float>> found = pictures(rig);
  CHECK(worst({found[0], found[1]}, {expected[0], expected[1]}) <= 1e-5); // exact
  const bool isCoarse = format == GL_R16F || format == GL_DEPTH_COMPONENT16;
  if (!isCoarse) CHECK(worst(found, expected) <= 2e-5);
}

tests::DepthConvention infinite() {
  tests::DepthConvention convention; // window depth that rounds as little as possible
  convention.reversed = convention.infinite = true;
  convention.clipDepth = ClipDepth::ZeroToOne;
  convention.near = 0.05;
  return convention;
}

} // namespace

TEST_CASE("every encoding of scene depth gives the picture of window depth") {
  for (const DepthEncoding encoding : {DepthEncoding::Axial, DepthEncoding::Radial}) {
    for (const GLenum format : {GL_R32F, GL_RG32F, GL_R16F}) {
      checkEncoding(infinite(), {encoding, {}}, format, kInfinity);
      checkEncoding(infinite(), {encoding, {40, 0.5}}, format, 1);
      checkEncoding(infinite(), {encoding, {-1}}, format, -kInfinity);
    }
    for (const GLenum format : {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT16})
      checkEncoding(infinite(), {encoding, {40}}, format, 1);
  }
  for (const GLenum format : {GL_R32F, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT16, GL_R16F})
    checkEncoding(infinite(), {DepthEncoding::Logarithmic, {1, 0, 1, 40}}, format, 1);
}

TEST_CASE("scene depth at the far plane is sky in every encoding, as near as its format comes") {
  tests::DepthConvention convention;
  convention.far = 41.3; // in no format exactly
  for (const bool reversed : {false, true}) {
    convention.reversed = reversed;
    for (const GLenum format : {GL_R32F, GL_R16F}) {
      checkEncoding(convention, {DepthEncoding::Axial, {}}, format, convention.far);
      checkEncoding(convention, {DepthEncoding::Axial, {convention.far}}, format, 1);
      checkEncoding(convention, {DepthEncoding::Radial, {convention.far}}, format, 1);
      checkEncoding(convention, {DepthEncoding::Radial, {}}, format, 2 * convention.far);
      checkEncoding(convention, {DepthEncoding::Logarithmic, {1, 0, 0.5, convention.far}}, format, 1);
    }
    checkEncoding(convention, {DepthEncoding::Axial, {convention.far}}, GL_DEPTH_COMPONENT16, 1);
  }
}

TEST_CASE("an orthographic camera's distances are from its near plane") {
  tests::DepthConvention convention;
  convention.orthographic = true;
  convention.near = -2;
  convention.far = 30;
  for (const ClipDepth clipDepth : {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne}) {
    convention.clipDepth = clipDepth;
    tests::SceneRig rig = bentRig();
    rig.setConvention(convention);
    const std::vector<std::vector<float>> expected = pictures(rig);
    for (const DepthScale& scale : {DepthScale{convention.far - convention.near}, DepthScale{1, -convention.near}}) {
      std::vector<float> values; // from 0 at the near plane to 1; view distance, which begins elsewhere
      for (const double d : rig.distances)
        values.push_back(static_cast<float>((d - convention.near - scale.offset) / scale.unit));
      const host::GlTexture texture = depthTexture(GL_R32F, kWidth, kHeight, values);
      rig.frame.depth = {texture.name()};
      rig.frame.depth.encoding = DepthEncoding::Axial;
      rig.frame.depth.scale = scale;
      CHECK(worst(pictures(rig), expected) <= 2e-5);
    }
  }
}

// Outerra's and three.js' convention, where window depth of 24 bits would end at a metre.
TEST_CASE("logarithmic depth spans ten million times the near distance") {
  tests::DepthConvention convention = infinite();
  convention.near = 1e-2;
  const Encoding logarithmic{DepthEncoding::Logarithmic, {1, 0, 1, 1e5}};
  // Terms of low rank, and slopes beside the sky, depend on the far plane.
  const std::vector<Technique> techniques = {Technique::Exact, Technique::Tree};
  for (const double scale : {0.01, 1.0, 100.0, 5000.0})
    for (const GLenum format : {GL_R32F, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24}) {
      CAPTURE(scale, format);
      tests::SceneRig rig = bentRig();
      for (double& distance : rig.distances)
        distance *= scale;
      for (float& s : rig.frame.medium.constituents[0].scattering)
        s = static_cast<float>(s / scale);
      rig.setConvention(convention);
      const host::GlTexture texture = encode(rig, logarithmic, format, 1);
      rig.setConvention(convention);
      const std::vector<std::vector<float>> expected = pictures(rig, techniques);
      convention.infinite = convention.reversed =
          false; // the camera's own far plane, which float's depth could not bear
      convention.far = 1e5;
      rig.frame.camera.clipFromView = convention.clipFromView(0.5, 1.5);
      convention = infinite();
      convention.near = 1e-2;
      rig.frame.depth = {texture.name()};
      rig.frame.depth.encoding = logarithmic.encoding;
      rig.frame.depth.scale = logarithmic.scale;
      CHECK(worst(pictures(rig, techniques), expected) <= 2e-5);
    }
}

TEST_CASE("a pixel whose encoded depth is NaN, or at the eye, gets no light") {
  for (const DepthEncoding encoding : {DepthEncoding::Axial, DepthEncoding::Radial, DepthEncoding::Logarithmic}) {
    tests::SceneRig rig = litRig();
    std::vector<float> values(static_cast<std::size_t>(kWidth * kHeight), kNan);
    values[40] = values[41] = 0;
    const host::GlTexture texture = depthTexture(GL_R32F, kWidth, kHeight, values);
    rig.frame.depth = {texture.name()};
    rig.frame.depth.encoding = encoding;
    if (encoding == DepthEncoding::Logarithmic) rig.frame.depth.scale.farDistance = 50;
    for (const Technique technique : kTechniques) {
      rig.frame.settings.technique = technique;
      const reference::ImageAnswer answer = rig.render();
      for (const double v : answer.inscatter.rgb)
        CHECK(std::abs(v) <= 1e-20);
      for (const double v : answer.transmittance.rgb)
        CHECK(std::abs(v - 1) <= 1e-6);
    }
  }
}
