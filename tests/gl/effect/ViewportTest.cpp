// The viewport as a rectangle of larger textures, and layers of arrays: the picture in it is bit by bit that of
// textures of just that size, and around it nothing is read or written.
#include "SceneRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

using namespace tyndall;
using host::gl;

namespace {

constexpr int kWidth = 37, kHeight = 22; // neither a multiple of a tile
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
constexpr Rectangle kAlone{0, 0, kWidth, kHeight};

using Bytes = std::vector<std::uint8_t>;

struct Transfer {
  GLenum channels, type;
  std::size_t bytes; // of a texel
};

Transfer transferOf(GLenum format) {
  if (format == GL_RGBA32F) return {GL_RGBA, GL_FLOAT, 16};
  if (format == GL_R11F_G11F_B10F) return {GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV, 4};
  return {GL_RGBA, GL_HALF_FLOAT, 8};
}

// Where the engine's textures are larger than the viewport: by how much, and which layer is drawn into.
struct Place {
  Rectangle viewport = kAlone;
  int width = kWidth, height = kHeight;
  int layers = 0, layer = -1; // 0: no array
  int outputLayer = -1;       // of the outputs, where it is another
};

// A texture that holds values inside the viewport and poison everywhere else.
class Poisoned {
public:
  Poisoned(GLenum format, const Place& place, int layer, const std::vector<float>& rgba)
      : format_(format), place_(place), layer_(layer) {
    std::vector<float> poison = {kNan, 1234.5F, kInf, -7.0F, 0.25F};
    if (format == GL_R11F_G11F_B10F) poison = {1234.5F, 0.25F, 63000}; // NaN has many bits there: drivers choose
    std::vector<float> all(4 * texels());
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = poison[i % poison.size()];
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (std::size_t c = 0; c < 4; ++c)
          all[4 * indexOf(x, y) + c] = rgba[4 * static_cast<std::size_t>(y * kWidth + x) + c];
    texture_ = place.layers == 0 ? host::makeTexture2D(format, place.width, place.height)
                                 : host::makeTextureArray(format, place.width, place.height, place.layers);
    const GLenum channels = format == GL_R32F ? GL_RED : GL_RGBA; // a depth has its value four times
    if (format == GL_R32F)
      for (std::size_t i = 0; i < texels(); ++i)
        all[i] = all[4 * i];
    if (place.layers == 0)
      gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, place.width, place.height, channels, GL_FLOAT, all.data());
    else
      gl().TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, place.width, place.height, place.layers, channels, GL_FLOAT,
                         all.data());
    if (format != GL_R32F) before_ = read();
  }

  GLuint name() const { return texture_.name(); }

  Bytes inside() const {
    const Bytes all = read();
    Bytes part;
    const std::size_t bytes = transferOf(format_).bytes;
    for (int y = 0; y < kHeight; ++y) {
      const auto* row = all.data() + bytes * indexOf(0, y);
      part.insert(part.end(), row, row + bytes * kWidth);
    }
    return part;
  }

  // Bits that have changed around the viewport.
  std::size_t changedOutside() const {
    const std::size_t bytes = transferOf(format_).bytes;
    Bytes now = read();
    for (int y = 0; y < kHeight; ++y)
      std::memcpy(now.data() + bytes * indexOf(0, y), before_.data() + bytes * indexOf(0, y), bytes * kWidth);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < now.size(); ++i)
      changed += now[i] != before_[i] ? 1 : 0;
    return changed;
  }

private:
  std::size_t texels() const {
    return static_cast<std::size_t>(place_.width * place_.height * std::max(place_.layers, 1));
  }
  std::size_t indexOf(int x, int y) const {
    return static_cast<std::size_t>((std::max(layer_, 0) * place_.height + place_.viewport.y + y) * place_.width +
                                    place_.viewport.x + x);
  }
  Bytes read() const {
    const Transfer transfer = transferOf(format_);
    Bytes bytes(transfer.bytes * texels());
    const GLenum target = place_.layers == 0 ? GL_TEXTURE_2D : GL_TEXTURE_2D_ARRAY;
    gl().PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl().BindTexture(target, name());
    gl().GetTexImage(target, 0, transfer.channels, transfer.type, bytes.data());
    return bytes;
  }

  GLenum format_;
  Place place_;
  int layer_;
  host::GlTexture texture_;
  Bytes before_;
};

std::size_t differences(const Bytes& a, const Bytes& b) {
  REQUIRE(a.size() == b.size());
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    differing += a[i] != b[i] ? 1 : 0;
  return differing;
}

// What a frame is made of but for where its textures are.
struct Case {
  Technique technique = Technique::Epipolar;
  GLenum format = GL_RGBA16F;
  bool colour = true, outputs = false;
  DebugView view = DebugView::Composite;
  bool reuses = false;
};

std::vector<float> someColour() {
  std::mt19937 random(3);
  std::vector<float> rgba;
  for (int i = 0; i < 4 * kWidth * kHeight; ++i)
    rgba.push_back(static_cast<float>(random() % 1000) * 0.01F);
  return rgba;
}

tests::SceneRig litRig() {
  tests::SceneRig rig(kWidth, kHeight);
  rig.addLight(LightKind::Directional);
  rig.addLight(LightKind::Spot);
  rig.frame.settings.slices = 64;
  rig.frame.settings.samples = 64;
  return rig;
}

std::vector<float> fourTimes(const std::vector<float>& values) {
  std::vector<float> all;
  for (const float v : values)
    all.insert(all.end(), 4, v);
  return all;
}

// A box that comes near, in the second frame and in the third.
std::vector<float> depthOf(const tests::SceneRig& rig, int frame) {
  std::vector<float> depth = rig.depth();
  for (int y = 4; y < 9 && frame > 0; ++y)
    for (int x = 6 + 3 * frame; x < 12 + 3 * frame; ++x)
      depth[static_cast<std::size_t>(y * kWidth + x)] = rig.convention().windowDepth(2);
  return depth;
}

std::uint64_t newEye() {
  static std::uint64_t eyes = 7000;
  return ++eyes;
}

// The pictures that the frames of a case leave in the viewport, colour and outputs; nothing else may have changed.
std::vector<Bytes> draw(Effect& effect, tests::SceneRig& rig, const Case& what, const Place& place) {
  std::vector<Bytes> pictures;
  Frame frame = rig.frame;
  const int outputLayer = place.outputLayer < 0 ? place.layer : place.outputLayer;
  frame.viewport = place.viewport;
  frame.settings.technique = what.technique;
  frame.settings.debugView = what.view;
  frame.colourLayer = frame.depth.layer = place.layer;
  frame.reuse.changes = what.reuses ? Changes::Detect : Changes::Unknown;
  frame.reuse.eye = newEye();
  const Poisoned inscatter(what.format, place, outputLayer, someColour()),
      transmittance(what.format, place, outputLayer, someColour());
  frame.output = {};
  if (what.outputs) frame.output = {inscatter.name(), transmittance.name(), outputLayer};
  for (int i = 0; i < (what.reuses ? 4 : 1); ++i) {
    const Poisoned colour(what.format, place, place.layer, someColour());
    const Poisoned depth(GL_R32F, place, place.layer, fourTimes(depthOf(rig, std::min(i, 2))));
    frame.colour = what.colour ? colour.name() : 0;
    frame.depth.texture = depth.name();
    const Status status = effect.render(frame);
    INFO(status.message);
    REQUIRE(status);
    for (const Poisoned* texture : {&colour, &inscatter, &transmittance}) {
      pictures.push_back(texture->inside());
      CHECK(texture->changedOutside() == 0);
    }
  }
  return pictures;
}

void checkCase(Effect& effect, tests::SceneRig& rig, const Case& what, const std::vector<Place>& places) {
  CAPTURE(static_cast<int>(what.technique), what.format, what.colour, what.outputs, static_cast<int>(what.view),
          what.reuses);
  const std::vector<Bytes> expected = draw(effect, rig, what, {});
  for (const Place& place : places) {
    CAPTURE(place.viewport.x, place.viewport.y, place.layers, place.layer);
    const std::vector<Bytes> found = draw(effect, rig, what, place);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      CAPTURE(i);
      CHECK(differences(found[i], expected[i]) == 0);
    }
  }
}

const Place kInside{{13, 6, kWidth, kHeight}, 61, 40}, kCorner{kAlone, 61, 40},
    kFarCorner{{24, 18, kWidth, kHeight}, 61, 40}, kLayer{kAlone, kWidth, kHeight, 3, 1},
    kInsideLayer{{13, 6, kWidth, kHeight}, 61, 40, 2, 1};

std::vector<Place> everywhere() { return {kInside, kCorner, kFarCorner, kLayer, kInsideLayer}; }

std::unique_ptr<Effect> effectWith(Masking masking, Compositing compositing, double band = 0) {
  Config config;
  config.tuning.reuse = config.tuning.fixup = masking;
  config.tuning.compositing = compositing;
  config.tuning.bandMilliseconds = band;
  return tests::newEffect(config);
}

std::vector<std::unique_ptr<Effect>> effects() {
  std::vector<std::unique_ptr<Effect>> all;
  all.push_back(effectWith(Masking::Stencil, Compositing::DualSource));
  all.push_back(effectWith(Masking::Tiles, Compositing::Copy, 0.002));
  return all;
}

} // namespace

TEST_CASE(
    "a viewport or a layer of larger textures holds the picture of textures of just that size, by every technique") {
  tests::SceneRig rig = litRig();
  for (const auto& effect : effects())
    for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank})
      for (const auto& [colour, outputs] : {std::pair{true, false}, {false, true}, {true, true}}) {
        Case what;
        what.technique = technique;
        what.colour = colour;
        what.outputs = outputs;
        checkCase(*effect, rig, what, everywhere());
      }
}

TEST_CASE("a viewport of larger textures holds the same picture in every format", "[sweep]") {
  tests::SceneRig rig = litRig();
  for (const auto& effect : effects())
    for (const GLenum format : {GL_RGBA32F, GL_R11F_G11F_B10F})
      for (const bool outputs : {false, true}) {
        Case what;
        what.format = format;
        what.outputs = outputs;
        checkCase(*effect, rig, what, {kInside, kCorner, kInsideLayer});
      }
}

TEST_CASE("a viewport of larger textures holds the same debug views", "[sweep]") {
  tests::SceneRig rig = litRig();
  for (const auto& effect : effects())
    for (int view = 1; view <= static_cast<int>(DebugView::Redrawn); ++view)
      for (const bool outputs : {false, true}) {
        Case what;
        what.view = static_cast<DebugView>(view);
        what.outputs = outputs;
        checkCase(*effect, rig, what, {kInside, kCorner, kLayer});
      }
}

TEST_CASE("a viewport of larger textures holds the same picture of frames that reuse the last one") {
  tests::SceneRig rig = litRig();
  for (const auto& effect : effects())
    for (const auto& [colour, outputs] : {std::pair{true, false}, {false, true}, {true, true}})
      for (const DebugView view : {DebugView::Composite, DebugView::Redrawn}) {
        if (view == DebugView::Redrawn && !colour) continue;
        Case what;
        what.reuses = true;
        what.colour = colour;
        what.outputs = outputs;
        what.view = view;
        checkCase(*effect, rig, what, {kInside, kCorner, kInsideLayer});
      }
}

TEST_CASE("pixels marched between slices, and lights that are added up apart, stay inside the viewport") {
  tests::SceneRig rig = litRig();
  const auto all = effects();
  rig.frame.settings.spreadThreshold = 0.02F;
  for (const auto& effect : all)
    checkCase(*effect, rig, {}, {kInside, kCorner, kLayer});
  rig = litRig();
  for (Light& light : rig.frame.lights)
    light.colour = {5e5F, 5e5F, 5e5F};
  Case what;
  what.outputs = true;
  for (const auto& effect : all)
    checkCase(*effect, rig, what, {kInside, kCorner, kLayer});
}

TEST_CASE("colour and outputs may be layers of one array") {
  tests::SceneRig rig = litRig();
  for (const auto& effect : effects()) {
    Case what;
    what.outputs = true;
    const std::vector<Bytes> expected = draw(*effect, rig, what, {});
    Place place = kLayer;
    place.outputLayer = 2;
    const std::vector<Bytes> apart = draw(*effect, rig, what, place);
    for (std::size_t i = 0; i < expected.size(); ++i)
      CHECK(differences(apart[i], expected[i]) == 0);
    const Poisoned both(what.format, kLayer, 1, someColour()), transmittance(what.format, kLayer, 2, someColour());
    rig.frame.colour = both.name();
    rig.frame.colourLayer = 1;
    const std::uint32_t transmittanceOfRig = rig.frame.output.transmittance;
    rig.frame.output = {both.name(), transmittance.name(), 2};
    rig.frame.settings.technique = what.technique;
    const Status status = effect->render(rig.frame);
    INFO(status.message);
    REQUIRE(status);
    CHECK(differences(both.inside(), expected[0]) == 0);
    CHECK(differences(transmittance.inside(), expected[2]) == 0);
    CHECK(transmittance.changedOutside() == 0);
    rig.frame.output.transmittance = transmittanceOfRig;
  }
}

// An origin that moves makes no other picture, and nothing of what is kept is wrong.
TEST_CASE("a viewport that moves between frames that reuse each other holds the same picture") {
  tests::SceneRig rig = litRig();
  rig.frame.lights.pop_back(); // two are added up in the colour's format, or apart
  for (const auto& effect : effects()) {
    Case what;
    const std::vector<Bytes> expected = draw(*effect, rig, what, {});
    Frame frame = rig.frame;
    frame.settings.technique = what.technique;
    frame.output = {};
    frame.reuse.changes = Changes::Detect;
    frame.reuse.eye = newEye();
    for (const Place& place : {kInside, kInside, kFarCorner, kCorner, Place{}, kInside}) {
      const Poisoned colour(what.format, place, -1, someColour());
      const Poisoned depth(GL_R32F, place, -1, fourTimes(rig.depth()));
      frame.viewport = place.viewport;
      frame.colour = colour.name();
      frame.depth.texture = depth.name();
      const Status status = effect->render(frame);
      INFO(status.message);
      REQUIRE(status);
      CHECK(colour.changedOutside() == 0);
      CHECK(differences(colour.inside(), expected[0]) == 0);
    }
  }
}
