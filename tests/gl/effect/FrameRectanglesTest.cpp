// Every rule about the viewport, layers, rectangles and encodings of a frame: a frame that breaks one is refused with
// field, value and rule; one that just keeps it is drawn.
#include "RefusalRig.h"
#include "support/Catch.h"

#include <functional>
#include <limits>

using namespace tyndall;

namespace {

constexpr int kSize = tests::RefusalRig::kSize;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kHuge = std::numeric_limits<int>::max();

// What a frame of the rig is refused for.
struct Broken {
  const char* name;
  std::function<void(Frame&)> spoil;
  std::vector<std::string> words;
};

void encode(Frame& frame, DepthEncoding encoding, const DepthScale& scale = {}) {
  frame.depth.encoding = encoding;
  frame.depth.scale = scale;
}

void refuseAll(tests::RefusalRig& rig, const std::vector<Broken>& all) {
  for (const Broken& broken : all) {
    CAPTURE(broken.name);
    Frame frame = rig.frame;
    broken.spoil(frame);
    rig.checkRefused(frame, broken.words);
  }
}

void makeOrthographic(Frame& frame) {
  tests::DepthConvention convention;
  convention.orthographic = true;
  frame.camera.clipFromView = convention.clipFromView(2, 1);
  frame.camera.clipDepth = convention.clipDepth;
}

} // namespace

TEST_CASE("a viewport that is outside the textures is refused, with both sizes") {
  tests::RefusalRig rig;
  refuseAll(rig, {{"before the first column", [](Frame& f) { f.viewport.x = -1; }, {"Frame::viewport.x is -1", ">= 0"}},
                  {"before the first row", [](Frame& f) { f.viewport.y = -5; }, {"Frame::viewport.y is -5", ">= 0"}},
                  {"too wide",
                   [](Frame& f) { f.viewport.width = 9; },
                   {"Frame::viewport is 9 x 8 at (0, 0)", "within colour, which is 8 x 8"}},
                  {"too high",
                   [](Frame& f) { f.viewport.height = 9; },
                   {"Frame::viewport is 8 x 9 at (0, 0)", "within colour, which is 8 x 8"}},
                  {"beyond the last column",
                   [](Frame& f) { f.viewport.x = 1; },
                   {"Frame::viewport is 8 x 8 at (1, 0)", "within colour, which is 8 x 8"}},
                  {"beyond the last row",
                   [](Frame& f) { f.viewport = {0, 3, 8, 6}; },
                   {"Frame::viewport is 8 x 6 at (0, 3)", "within colour"}},
                  {"beyond all numbers",
                   [](Frame& f) { f.viewport.x = kHuge; },
                   {"Frame::viewport is 8 x 8 at (2147483647, 0)", "within colour"}},
                  {"no colour",
                   [](Frame& f) {
                     f.colour = 0;
                     f.viewport.y = 2;
                   },
                   {"Frame::viewport is 8 x 8 at (0, 2)", "within output.inscatter, which is 8 x 8"}},
                  {"transmittance alone",
                   [](Frame& f) {
                     f.colour = f.output.inscatter = 0;
                     f.viewport.y = 2;
                   },
                   {"Frame::viewport is", "within output.transmittance"}}});
  Frame part = rig.frame;
  part.viewport = {2, 1, 6, 7};
  rig.checkAccepted(part);
}

TEST_CASE("colour and outputs of different sizes are refused, whatever the viewport") {
  tests::RefusalRig rig;
  const host::GlTexture larger = host::makeTexture2D(GL_RGBA16F, kSize + 1, kSize + 2);
  for (const Rectangle& viewport : {Rectangle{0, 0, kSize, kSize}, Rectangle{1, 2, 3, 4}}) {
    rig.frame.viewport = viewport;
    Frame frame = rig.frame;
    frame.colour = larger.name();
    rig.checkRefused(frame, {"Frame::output.inscatter is texture", "is 8 x 8, must be 9 x 10", "as colour"});
    frame = rig.frame;
    frame.output.inscatter = larger.name();
    rig.checkRefused(frame, {"Frame::output.inscatter is texture", "is 9 x 10, must be 8 x 8", "as colour"});
    frame = rig.frame;
    frame.colour = 0;
    frame.output.transmittance = larger.name();
    rig.checkRefused(frame,
                     {"Frame::output.transmittance is texture", "is 9 x 10, must be 8 x 8", "as output.inscatter"});
  }
}

TEST_CASE("layers that an array lacks, arrays without a layer and layers without an array are refused") {
  tests::RefusalRig rig;
  refuseAll(rig,
            {{"colour",
              [](Frame& f) { f.colourLayer = 0; },
              {"Frame::colour is texture", "must be a GL_TEXTURE_2D_ARRAY", "colourLayer is 0"}},
             {"colour", [](Frame& f) { f.colourLayer = -2; }, {"Frame::colourLayer is -2", "or -1"}},
             {"outputs",
              [](Frame& f) { f.output.layer = 3; },
              {"Frame::output.inscatter is texture", "must be a GL_TEXTURE_2D_ARRAY", "output.layer is 3"}},
             {"outputs", [](Frame& f) { f.output.layer = -7; }, {"Frame::output.layer is -7", "or -1"}},
             {"depth",
              [](Frame& f) { f.depth.layer = 1; },
              {"Frame::depth.texture is texture", "must be a GL_TEXTURE_2D_ARRAY", "depth.layer is 1"}},
             {"depth", [](Frame& f) { f.depth.layer = -2; }, {"Frame::depth.layer is -2", "or -1"}},
             {"depth of samples",
              [](Frame& f) {
                f.depth.layer = 1;
                f.depth.multisampled = true;
              },
              {"Frame::depth.texture is texture", "must be a GL_TEXTURE_2D_MULTISAMPLE_ARRAY", "depth.layer is 1"}}});
  const host::GlTexture colours = host::makeTextureArray(GL_RGBA16F, kSize, kSize, 2),
                        more = host::makeTextureArray(GL_RGBA32F, kSize, kSize, 3),
                        depths = host::makeTextureArray(GL_DEPTH_COMPONENT24, kSize, kSize, 4);
  const auto inLayers = [&](int colour, int output, int depth) {
    Frame frame = rig.frame;
    frame.colour = colours.name();
    frame.colourLayer = colour;
    frame.output = {more.name(), 0, output};
    frame.depth.texture = depths.name();
    frame.depth.layer = depth;
    return frame;
  };
  const auto refuse = [&](const Frame& frame, const std::vector<std::string>& words) {
    const Status status = tests::testEffect().render(frame);
    INFO(status.message);
    CHECK(status.code == StatusCode::InvalidFrame);
    for (const std::string& word : words)
      CHECK(status.message.find(word) != std::string::npos);
    tests::testContext().takeErrors();
  };
  refuse(inLayers(2, 2, 3), {"Frame::colourLayer is 2: colour has 2 layers"});
  refuse(inLayers(1, 3, 3), {"Frame::output.layer is 3: output.inscatter has 3 layers"});
  refuse(inLayers(1, 2, 4), {"Frame::depth.layer is 4: depth.texture has 4 layers"});
  refuse(inLayers(-1, 2, 3), {"Frame::colour is texture", "must be a GL_TEXTURE_2D,", "colourLayer is -1"});
  refuse(inLayers(1, -1, 3), {"Frame::output.inscatter is texture", "must be a GL_TEXTURE_2D,", "output.layer is -1"});
  refuse(inLayers(1, 2, -1), {"Frame::depth.texture is texture", "must be a GL_TEXTURE_2D,", "depth.layer is -1"});
  Frame shared = inLayers(1, 1, 3);
  shared.output.inscatter = shared.colour;
  refuse(shared, {"Frame::output.inscatter is texture", "must differ from colour"});
  shared.output = {0, shared.colour, 1};
  refuse(shared, {"Frame::output.transmittance is texture", "must differ from colour"});
  shared.output.layer = 0;
  rig.checkAccepted(shared);
  rig.checkAccepted(inLayers(1, 2, 3));
  rig.checkAccepted(inLayers(0, 0, 0));
}

TEST_CASE("a rectangle of depth that is outside its texture, or missing, is refused") {
  tests::RefusalRig rig;
  const auto part = [](const Rectangle& rectangle) { return [=](Frame& f) { f.depth.rectangle = rectangle; }; };
  refuseAll(rig,
            {{"too wide",
              part({0, 0, 9, 8}),
              {"Frame::depth.rectangle is 9 x 8 at (0, 0)", "within depth.texture, which is 8 x 8"}},
             {"too high", part({4, 4, 4, 5}), {"Frame::depth.rectangle is 4 x 5 at (4, 4)", "within depth.texture"}},
             {"beyond all numbers", part({kHuge, 0, kHuge, 5}), {"Frame::depth.rectangle is", "within depth.texture"}},
             {"empty", part({1, 1, 0, 0}), {"Frame::depth.rectangle is 0 x 0 at (1, 1)", "at least 1 x 1"}},
             {"no height", part({0, 0, 4, 0}), {"Frame::depth.rectangle is 4 x 0", "at least 1 x 1"}},
             {"negative", part({-1, 0, 4, 4}), {"Frame::depth.rectangle is 4 x 4 at (-1, 0)", "at (0, 0) or beyond"}},
             {"of negative width", part({4, 0, -4, 4}), {"Frame::depth.rectangle is -4 x 4", "at least 1 x 1"}}});
  const host::GlTexture half = host::makeTexture2D(GL_DEPTH_COMPONENT24, kSize / 2, kSize / 2);
  Frame frame = rig.frame;
  frame.depth.texture = half.name();
  rig.checkRefused(frame, {"Frame::depth.texture is texture", "is 4 x 4, must be 8 x 8", "depth.rectangle"});
  frame.depth.rectangle = {0, 0, 4, 4};
  rig.checkAccepted(frame);
}

TEST_CASE("encodings of depth that contradict themselves, the camera or the format are refused") {
  tests::RefusalRig rig;
  const auto encoded = [](DepthEncoding encoding, const DepthScale& scale) {
    return [=](Frame& f) { encode(f, encoding, scale); };
  };
  constexpr auto kLog = DepthEncoding::Logarithmic;
  refuseAll(
      rig,
      {{"none", encoded(static_cast<DepthEncoding>(4), {}), {"Frame::depth.encoding is 4", "enumerators"}},
       {"none", encoded(static_cast<DepthEncoding>(-1), {}), {"Frame::depth.encoding is -1", "enumerators"}},
       {"window", encoded(DepthEncoding::Window, {2}), {"Frame::depth.scale is set", "Window has none"}},
       {"window", encoded(DepthEncoding::Window, {1, 0, 1, 100}), {"Frame::depth.scale is set", "Window has none"}},
       {"no unit", encoded(DepthEncoding::Axial, {0}), {"Frame::depth.scale.unit is 0", "finite and not 0"}},
       {"no unit", encoded(DepthEncoding::Radial, {kNan}), {"Frame::depth.scale.unit is nan", "finite and not 0"}},
       {"endless", encoded(DepthEncoding::Axial, {kInfinity}), {"Frame::depth.scale.unit is inf", "finite and not 0"}},
       {"offset", encoded(DepthEncoding::Radial, {1, kNan}), {"Frame::depth.scale.offset is nan", "finite"}},
       {"no far", encoded(kLog, {}), {"Frame::depth.scale.farDistance is 0", "finite and > 0"}},
       {"far", encoded(kLog, {1, 0, 1, -3}), {"Frame::depth.scale.farDistance is -3", "finite and > 0"}},
       {"far", encoded(kLog, {1, 0, 1, kInfinity}), {"Frame::depth.scale.farDistance is inf", "finite and > 0"}},
       {"constant", encoded(kLog, {1, 0, 0, 100}), {"Frame::depth.scale.constant is 0", "finite and > 0"}},
       {"constant", encoded(kLog, {1, 0, kNan, 100}), {"Frame::depth.scale.constant is nan", "finite and > 0"}},
       {"orthographic",
        [](Frame& f) {
          makeOrthographic(f);
          encode(f, kLog, {1, 0, 1, 100});
        },
        {"Frame::depth.encoding is Logarithmic", "perspective camera"}},
       {"orthographic",
        [](Frame& f) {
          makeOrthographic(f);
          encode(f, DepthEncoding::Radial);
        },
        {"Frame::depth.encoding is Radial", "perspective camera"}}});
  for (const GLenum format : {GL_R16F, GL_RG32F}) {
    const host::GlTexture linear = host::makeTexture2D(format, kSize, kSize);
    Frame frame = rig.frame;
    frame.depth.texture = linear.name();
    rig.checkRefused(frame, {"Frame::depth.texture is texture", "must have a depth format or R32F"});
    encode(frame, DepthEncoding::Axial);
    rig.checkAccepted(frame);
  }
  const host::GlTexture eight = host::makeTexture2D(GL_R8, kSize, kSize);
  Frame frame = rig.frame;
  frame.depth.texture = eight.name();
  encode(frame, DepthEncoding::Radial);
  rig.checkRefused(frame, {"Frame::depth.texture is texture", "must have a depth format, R16F, R32F or RG32F"});
}
