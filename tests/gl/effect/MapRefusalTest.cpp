// Layouts and encodings of shadow maps that cannot be meant: each is refused in one line, and nothing is drawn.
#include "FakeContext.h"
#include "RefusalRig.h"
#include "support/Catch.h"

#include <functional>

using namespace tyndall;
using host::gl;

namespace {

struct Breakage {
  const char* name;
  std::function<void(Frame&)> apply;
  std::vector<std::string> words;
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kMost = std::numeric_limits<int>::max();

ShadowMap& sun(Frame& f) { return f.lights[0].shadow; }
ShadowMap& lamp(Frame& f) { return f.lights[1].shadow; }
ShadowMap& spot(Frame& f) { return f.lights[2].shadow; }

Breakage rectangle(const char* name, const Rectangle& r, std::vector<std::string> words) {
  words.insert(words.begin(), "lights[2].shadow.views[0].rectangle is ");
  return {name, [r](Frame& f) { spot(f).views[0].rectangle = r; }, std::move(words)};
}

// A lamp's cube map, but for its texture.
void makeCube(ShadowMap& shadow) {
  shadow.views.clear();
  shadow.array = false;
  shadow.cube = {true, 0, 0.1, 10};
}

Breakage cube(const char* name, const std::function<void(ShadowMap&)>& apply, std::vector<std::string> words) {
  return {name,
          [apply](Frame& f) {
            makeCube(lamp(f));
            apply(lamp(f));
          },
          std::move(words)};
}

// Shadow maps are 4 x 4.
const std::vector<Breakage> kBreakages = {
    rectangle("wide", {0, 0, 5, 4}, {"5 x 4 at (0, 0)", "4 x 4 texels"}),
    rectangle("high", {0, 1, 4, 4}, {"4 x 4 at (0, 1)", "4 x 4 texels"}),
    rectangle("beside the map", {4, 0, 1, 1}, {"4 x 4 texels"}),
    rectangle("far beyond it", {kMost, kMost, kMost, kMost}, {"4 x 4 texels"}),
    rectangle("no width", {0, 0, 0, 4}, {"hold a texel"}),
    rectangle("no height", {1, 1, 1, 0}, {"hold a texel"}),
    rectangle("neither, but elsewhere", {1, 0, 0, 0}, {"hold a texel"}),
    rectangle("negative x", {-1, 0, 2, 2}, {"begin at 0"}),
    rectangle("negative y", {0, -1, 2, 2}, {"begin at 0"}),
    rectangle("negative width", {3, 0, -2, 2}, {"hold a texel"}),
    {"overlapping cascades",
     [](Frame& f) {
       sun(f).views[0].rectangle = {0, 0, 3, 3};
       sun(f).views[1].rectangle = {2, 2, 2, 2};
       sun(f).views[1].layer = sun(f).views[0].layer;
     },
     {"lights[0].shadow.views[1].rectangle is 2 x 2 at (2, 2)", "overlaps that of views[0]"}},
    {"a rectangle of a layer that another view has whole",
     [](Frame& f) {
       sun(f).views[1].rectangle = {2, 2, 2, 2};
       sun(f).views[1].layer = sun(f).views[0].layer;
     },
     {"lights[0].shadow.views[1].rectangle", "overlaps that of views[0]"}},
    {"several views of a texture, one without a rectangle",
     [](Frame& f) {
       sun(f).array = false;
       for (ShadowView& view : sun(f).views)
         view.layer = 0;
       sun(f).views[0].rectangle = {0, 0, 2, 2};
     },
     {"lights[0].shadow.array is false", "or a rectangle each"}},
    {"a sun's cube",
     [](Frame& f) { makeCube(sun(f)); },
     {"lights[0].shadow.cube.enabled is true", "only a point light"}},
    {"a spot's cube", [](Frame& f) { makeCube(spot(f)); }, {"lights[2].shadow.cube.enabled", "only a point light"}},
    cube("a cube with views", [](ShadowMap& s) { s.views.resize(6); },
         {"lights[1].shadow.views is 6 long", "must be empty"}),
    cube("cube -1",
         [](ShadowMap& s) {
           s.cube.index = -1;
           s.array = true;
         },
         {"lights[1].shadow.cube.index is -1"}),
    cube("cube 1 of one", [](ShadowMap& s) { s.cube.index = 1; },
         {"lights[1].shadow.cube.index is 1", "GL_TEXTURE_CUBE_MAP"}),
    cube("no near plane", [](ShadowMap& s) { s.cube.nearDistance = 0; },
         {"lights[1].shadow.cube.nearDistance is 0", "> 0"}),
    cube("an endless near plane", [](ShadowMap& s) { s.cube.nearDistance = kInfinity; },
         {"lights[1].shadow.cube.nearDistance is inf", "finite"}),
    cube("no far plane", [](ShadowMap& s) { s.cube.farDistance = 0.1; },
         {"lights[1].shadow.cube.farDistance is 0.1", "> nearDistance"}),
    cube("a far plane that is not a number", [](ShadowMap& s) { s.cube.farDistance = kNan; },
         {"lights[1].shadow.cube.farDistance is nan"}),
    cube("an array as a cube", [](ShadowMap&) {}, {"lights[1].shadow.texture", "must be a GL_TEXTURE_CUBE_MAP"}),
    {"encoding 4",
     [](Frame& f) { sun(f).encoding = static_cast<DepthEncoding>(4); },
     {"lights[0].shadow.encoding is 4", "enumerators"}},
    {"logarithmic",
     [](Frame& f) { lamp(f).encoding = DepthEncoding::Logarithmic; },
     {"lights[1].shadow.encoding is Logarithmic", "Window, Axial or Radial"}},
    {"a sun's distances",
     [](Frame& f) { sun(f).encoding = DepthEncoding::Radial; },
     {"lights[0].shadow.encoding is Radial", "directional"}},
    {"distances of an orthographic spot",
     [](Frame& f) {
       spot(f).encoding = DepthEncoding::Radial;
       spot(f).views[0].clipFromWorld = sun(f).views[0].clipFromWorld;
     },
     {"lights[2].shadow.encoding is Radial", "views[0] is orthographic"}},
    {"no unit",
     [](Frame& f) {
       spot(f).encoding = DepthEncoding::Axial;
       spot(f).scale.unit = 0;
     },
     {"lights[2].shadow.scale.unit is 0", "not 0"}},
    {"a unit that is not a number",
     [](Frame& f) {
       spot(f).encoding = DepthEncoding::Axial;
       spot(f).scale.unit = kNan;
     },
     {"lights[2].shadow.scale.unit is nan"}},
    {"an endless offset",
     [](Frame& f) {
       spot(f).encoding = DepthEncoding::Axial;
       spot(f).scale.offset = kInfinity;
     },
     {"lights[2].shadow.scale.offset is inf"}},
    {"a unit of window depth",
     [](Frame& f) { spot(f).scale.unit = 5; },
     {"lights[2].shadow.scale.unit is 5", "Window"}},
    {"an offset of window depth",
     [](Frame& f) { spot(f).scale.offset = 1; },
     {"lights[2].shadow.scale.offset is 1", "Window"}},
    {"a logarithm's constant", [](Frame& f) { spot(f).scale.constant = 2; }, {"lights[2].shadow.scale.constant is 2"}},
    {"a logarithm's far plane",
     [](Frame& f) { spot(f).scale.farDistance = 9; },
     {"lights[2].shadow.scale.farDistance is 9"}},
};

host::GlTexture makeFaces(const std::vector<int>& sizes, const std::vector<GLenum>& formats) {
  host::GlTexture texture = host::makeTexture();
  gl().BindTexture(GL_TEXTURE_CUBE_MAP, texture.name());
  for (std::size_t i = 0; i < 6; ++i)
    if (const int size = sizes[i % sizes.size()])
      gl().TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(i), 0,
                      static_cast<GLint>(formats[i % formats.size()]), size, size, 0, GL_RED, GL_FLOAT, nullptr);
  return texture;
}

} // namespace

TEST_CASE("a layout or an encoding that cannot be meant is refused, field and rule named") {
  tests::RefusalRig rig;
  for (const Breakage& breakage : kBreakages) {
    CAPTURE(breakage.name);
    Frame broken = rig.frame;
    breakage.apply(broken);
    rig.checkRefused(broken, breakage.words);
  }
  rig.checkAccepted(rig.frame);
}

TEST_CASE("a cube map whose faces are missing or differ is refused, the face named") {
  tests::RefusalRig rig;
  Frame frame = rig.frame;
  makeCube(lamp(frame));
  frame.lights[1].glass = {};
  const auto refuse = [&](const host::GlTexture& texture, const std::vector<std::string>& words) {
    lamp(frame).texture = texture.name();
    rig.checkRefused(frame, words);
  };
  refuse(makeFaces({4, 4, 4, 0, 4, 4}, {GL_R32F}),
         {"lights[1].shadow.texture", "its face GL_TEXTURE_CUBE_MAP_NEGATIVE_Y has no level 0"});
  refuse(makeFaces({0, 4, 4, 4, 4, 4}, {GL_R32F}), {"GL_TEXTURE_CUBE_MAP_POSITIVE_X has no level 0"});
  refuse(makeFaces({4, 4, 4, 4, 8, 4}, {GL_R32F}), {"GL_TEXTURE_CUBE_MAP_POSITIVE_Z must have the size and format"});
  refuse(makeFaces({4}, {GL_R32F, GL_R32F, GL_R32F, GL_R32F, GL_R32F, GL_R16F}),
         {"GL_TEXTURE_CUBE_MAP_NEGATIVE_Z must have the size and format"});
  refuse(makeFaces({4}, {GL_RGBA32F}), {"must have a depth format, R16F, R32F or RG32F"});
  const host::GlTexture good = makeFaces({4}, {GL_R32F});
  lamp(frame).texture = good.name();
  rig.checkAccepted(frame);
  lamp(frame).array = true;
  rig.checkRefused(frame, {"lights[1].shadow.texture", "must be a GL_TEXTURE_CUBE_MAP_ARRAY"});
}

TEST_CASE("a cube that an array does not have is refused") {
  tests::RefusalRig rig;
  Frame frame = rig.frame;
  makeCube(lamp(frame));
  lamp(frame).array = true;
  const host::GlTexture texture = host::makeTexture();
  gl().BindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, texture.name());
  gl().TexImage3D(GL_TEXTURE_CUBE_MAP_ARRAY, 0, GL_R32F, 4, 4, 12, 0, GL_RED, GL_FLOAT, nullptr);
  lamp(frame).texture = texture.name();
  lamp(frame).cube.index = 2;
  rig.checkRefused(frame, {"lights[1].shadow.cube.index is 2", "2 cubes"});
  lamp(frame).cube.index = 1;
  rig.checkAccepted(frame);
}

TEST_CASE("distances that a fixed-point format cannot hold up to the far plane are refused") {
  tests::RefusalRig rig;
  Frame frame = rig.frame;
  const host::GlTexture fixed = host::makeTexture2D(GL_DEPTH_COMPONENT24, 4, 4);
  frame.lights[2].glass = {};
  spot(frame).texture = fixed.name();
  spot(frame).encoding = DepthEncoding::Axial;
  rig.checkRefused(frame, {"lights[2].shadow.scale.unit is 1", "does not reach the far plane"});
  spot(frame).scale.unit = 1e4;
  rig.checkAccepted(frame);
}

namespace {

void GLAD_API_PTR sayCore33(GLenum name, GLint* value) {
  gl().GetIntegerv(name, value);
  if (name == GL_MAJOR_VERSION || name == GL_MINOR_VERSION) *value = 3;
}
const GLubyte* GLAD_API_PTR hideCubeArrays(GLenum name, GLuint index) {
  const GLubyte* text = gl().GetStringi(name, index);
  const bool hidden = text && std::string(reinterpret_cast<const char*>(text)) == "GL_ARB_texture_cube_map_array";
  return hidden ? reinterpret_cast<const GLubyte*>("GL_TYNDALL_hidden") : text;
}

} // namespace

TEST_CASE("a context without arrays of cube maps refuses one") {
  tests::RefusalRig rig;
  const tests::FakeContext fake(
      {}, {{"glGetIntegerv", tests::address(sayCore33)}, {"glGetStringi", tests::address(hideCubeArrays)}});
  const CreateResult created = fake.create();
  INFO(created.status.message);
  REQUIRE(created.effect);
  Frame frame = rig.frame;
  makeCube(lamp(frame));
  const Status before = created.effect->render(rig.frame);
  CHECK(before);
  lamp(frame).array = true;
  const Status status = created.effect->render(frame);
  CHECK(status.code == StatusCode::InvalidFrame);
  CHECK(status.message.find("Frame::lights[1].shadow.texture") == 0);
  CHECK(status.message.find("GL_TEXTURE_CUBE_MAP_ARRAY needs OpenGL 4.0") != std::string::npos);
  CHECK(created.effect->prepare(frame).status.message == status.message);
}
