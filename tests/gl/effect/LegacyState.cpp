#include "LegacyState.h"

#include "LegacyGl.h"

#include <array>

using host::gl;

namespace tests {

namespace {

using Rows = std::vector<HostileRow>;
using Engine = HostileEngine;
using namespace legacy;

const std::map<std::string, GLenum> kCapabilities = {
    {"alpha test", ALPHA_TEST},
    {"polygon stipple", POLYGON_STIPPLE},
    {"line stipple", LINE_STIPPLE},
    {"point smooth", POINT_SMOOTH},
    {"point sprite", POINT_SPRITE},
    {"fog", FOG},
    {"colour sum", COLOR_SUM},
    {"lighting", LIGHTING},
    {"normalize", NORMALIZE},
    {"two-sided vertex program", VERTEX_PROGRAM_TWO_SIDE},
    {"vertex program", VERTEX_PROGRAM},
    {"fragment program", FRAGMENT_PROGRAM},
    {"stencil test two-sided", STENCIL_TEST_TWO_SIDE},
};

const std::map<std::string, GLenum> kNumbers = {
    {"alpha func", ALPHA_TEST_FUNC},
    {"alpha reference", ALPHA_TEST_REF},
    {"clamp vertex colour", CLAMP_VERTEX_COLOR},
    {"clamp fragment colour", CLAMP_FRAGMENT_COLOR},
    {"clamp read colour", CLAMP_READ_COLOR},
    {"map colour", MAP_COLOR},
    {"map stencil", MAP_STENCIL},
    {"index shift", INDEX_SHIFT},
    {"index offset", INDEX_OFFSET},
    {"red scale", RED_SCALE},
    {"red bias", RED_BIAS},
    {"green scale", GREEN_SCALE},
    {"green bias", GREEN_BIAS},
    {"blue scale", BLUE_SCALE},
    {"blue bias", BLUE_BIAS},
    {"alpha scale", ALPHA_SCALE},
    {"alpha bias", ALPHA_BIAS},
    {"depth scale", DEPTH_SCALE},
    {"depth bias", DEPTH_BIAS},
    {"active stencil face", ACTIVE_STENCIL_FACE},
    {"shade model", SHADE_MODEL},
    {"matrix mode", MATRIX_MODE},
    {"render mode", RENDER_MODE},
};

void transfer(GLenum name, GLfloat value) { call<void, GLenum, GLfloat>("glPixelTransferf", name, value); }

void setTransfer(GLfloat scale, GLfloat bias) {
  for (const GLenum name : {RED_SCALE, GREEN_SCALE, BLUE_SCALE, ALPHA_SCALE, DEPTH_SCALE})
    transfer(name, scale);
  for (const GLenum name : {RED_BIAS, GREEN_BIAS, BLUE_BIAS, ALPHA_BIAS, DEPTH_BIAS})
    transfer(name, bias);
}

// Every value to one of two.
void setMaps(std::array<GLfloat, 2> values) {
  for (GLenum map = PIXEL_MAP_R_TO_R; map < PIXEL_MAP_R_TO_R + 4; ++map)
    call<void, GLenum, GLsizei, const GLfloat*>("glPixelMapfv", map, 2, values.data());
}

void stippleNothing() {
  const std::array<GLubyte, 128> none{};
  call<void, const GLubyte*>("glPolygonStipple", none.data());
}

void clampColours(GLenum target, GLenum clamp) { gl().ClampColor(target, clamp); }

HostileRow enabled(const std::string& name, GLenum capability, const std::function<void()>& more = {}) {
  return {name, [=](Engine&) {
            gl().Enable(capability);
            if (more) more();
          }};
}

HostileRow everywhere(HostileRow row) {
  row.where = Where::Everywhere;
  return row;
}

// --- what is done to fragments

void addFragments(Rows& rows) {
  const auto alpha = [](GLenum function, GLfloat reference) {
    return [=] { call<void, GLenum, GLfloat>("glAlphaFunc", function, reference); };
  };
  rows.push_back(everywhere(enabled("alpha test of more than 0", ALPHA_TEST, alpha(GL_GREATER, 0))));
  rows.push_back(enabled("alpha test that fails", ALPHA_TEST, alpha(GL_NEVER, 0)));
  rows.push_back(everywhere(enabled("polygon stipple of nothing", POLYGON_STIPPLE, stippleNothing)));
  rows.push_back(enabled("line stipple", LINE_STIPPLE, [] { call<void, GLint, GLushort>("glLineStipple", 1, 0); }));
  rows.push_back(
      {"fragment colours clamped", [](Engine&) { clampColours(CLAMP_FRAGMENT_COLOR, GL_TRUE); }, Where::Everywhere});
  rows.push_back({"colours of vertices and of reading clamped",
                  [](Engine&) {
                    clampColours(CLAMP_VERTEX_COLOR, GL_TRUE);
                    clampColours(CLAMP_READ_COLOR, GL_TRUE);
                  },
                  Where::Everywhere});
  rows.push_back(enabled("fog", FOG));
  rows.push_back(enabled("colour sum", COLOR_SUM));
  rows.push_back(enabled("logic operation of indices", INDEX_LOGIC_OP, [] { gl().LogicOp(GL_CLEAR); }));
  rows.push_back({"stencil: two-sided, the back active",
                  [](Engine&) {
                    gl().Enable(GL_STENCIL_TEST);
                    gl().Enable(STENCIL_TEST_TWO_SIDE);
                    for (const GLenum face : {GL_FRONT, GL_BACK}) {
                      call<void, GLenum>("glActiveStencilFaceEXT", face);
                      gl().StencilFunc(GL_NEVER, face == GL_BACK ? 3 : 5, 0x55);
                      gl().StencilOp(GL_INCR, GL_ZERO, face == GL_BACK ? GL_INVERT : GL_DECR);
                      gl().StencilMask(face == GL_BACK ? 0U : 0x3U);
                    }
                  },
                  Where::Everywhere});
}

// --- what is done to vertices, primitives and texture coordinates

void addVertices(Rows& rows) {
  rows.push_back(enabled("smooth points", POINT_SMOOTH, [] {
    gl().PointSize(17);
    gl().Enable(POINT_SPRITE);
  }));
  rows.push_back({"flat shading", [](Engine&) { call<void, GLenum>("glShadeModel", FLAT); }});
  rows.push_back(enabled("two-sided vertex programs", VERTEX_PROGRAM_TWO_SIDE));
  rows.push_back(enabled("lighting", LIGHTING, [] { gl().Enable(NORMALIZE); }));
  rows.push_back(everywhere(enabled("a clip plane before everything", CLIP_PLANE0, [] {
    const std::array<GLdouble, 4> plane = {0, 0, 0, -1};
    call<void, GLenum, const GLdouble*>("glClipPlane", CLIP_PLANE0, plane.data());
  })));
  rows.push_back({"matrices", [](Engine&) {
                    for (const GLenum mode : {MODELVIEW, PROJECTION, TEXTURE}) {
                      call<void, GLenum>("glMatrixMode", mode);
                      call<void, GLfloat, GLfloat, GLfloat>("glScalef", 3, 0, 2);
                    }
                  }});
  rows.push_back(enabled("texture environment", GL_TEXTURE_2D, [] {
    gl().Enable(TEXTURE_GEN_S);
    call<void, GLenum, GLenum, GLint>("glTexEnvi", TEXTURE_ENV, TEXTURE_ENV_MODE, GL_BLEND);
    call<void, GLenum, GLenum, GLfloat>("glTexEnvf", TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, 5);
  }));
  rows.push_back(enabled("programs of assembly", VERTEX_PROGRAM, [] { gl().Enable(FRAGMENT_PROGRAM); }));
  rows.push_back({"arrays of the client's", [](Engine&) {
                    static const std::array<GLfloat, 4> one{};
                    for (const GLenum array : {VERTEX_ARRAY, COLOR_ARRAY})
                      call<void, GLenum>("glEnableClientState", array);
                    call<void, GLint, GLenum, GLsizei, const void*>("glVertexPointer", 4, GL_FLOAT, 0, one.data());
                  }});
  rows.push_back({"hints of OpenGL 1", [](Engine&) { gl().Hint(PERSPECTIVE_CORRECTION_HINT, GL_FASTEST); }});
}

// --- what is done to pixels on their way

void addPixels(Rows& rows) {
  rows.push_back({"pixels scaled and biased", [](Engine&) { setTransfer(0.5F, 0.25F); }, Where::Everywhere});
  rows.push_back({"pixels mapped",
                  [](Engine&) {
                    setMaps({0.25F, 0.75F});
                    transfer(MAP_COLOR, GL_TRUE);
                    transfer(MAP_STENCIL, GL_TRUE);
                    transfer(INDEX_SHIFT, 1);
                    transfer(INDEX_OFFSET, 3);
                  },
                  Where::Everywhere});
  rows.push_back({"depth that gives alpha",
                  [](Engine& e) {
                    gl().BindTexture(GL_TEXTURE_2D, e.frame.depth.texture);
                    gl().TexParameteri(GL_TEXTURE_2D, DEPTH_TEXTURE_MODE, GL_ALPHA);
                  },
                  Where::Once, 33, "GL_DEPTH_TEXTURE_MODE must not be GL_ALPHA"});
}

// --- what is under way

void addModes(Rows& rows) {
  static std::array<GLfloat, 64> values{};
  static std::array<GLuint, 64> names{};
  const auto render = [] { call<GLint, GLenum>("glRenderMode", RENDER); };
  rows.push_back({"feedback",
                  [](Engine&) {
                    call<void, GLsizei, GLenum, GLfloat*>("glFeedbackBuffer", 64, 0x0600 /*GL_2D*/, values.data());
                    call<GLint, GLenum>("glRenderMode", FEEDBACK);
                  },
                  Where::Once,
                  33,
                  "glRenderMode is GL_FEEDBACK",
                  {},
                  render});
  rows.push_back({"selection",
                  [](Engine&) {
                    call<void, GLsizei, GLuint*>("glSelectBuffer", 64, names.data());
                    call<GLint, GLenum>("glRenderMode", SELECT);
                  },
                  Where::Once,
                  33,
                  "glRenderMode is GL_SELECT",
                  {},
                  render});
}

} // namespace

bool isCompatibility() {
  testContext();
  GLint profile = 0;
  gl().GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  return (profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
}

void addLegacyState(GlState& state) {
  if (!isCompatibility()) return;
  for (const auto& [name, capability] : kCapabilities)
    state["legacy " + name] = {static_cast<double>(gl().IsEnabled(capability))};
  for (const auto& [name, query] : kNumbers) {
    std::array<GLfloat, 16> values{};
    gl().GetFloatv(query, values.data());
    state["legacy " + name] = {values[0]};
  }
  // Queries of these are clamped as fragments are.
  clampColours(CLAMP_FRAGMENT_COLOR, GL_FALSE);
  std::array<GLfloat, 4> colour{};
  gl().GetFloatv(GL_COLOR_CLEAR_VALUE, colour.data());
  state["clear colour"].assign(colour.begin(), colour.end());
  gl().GetFloatv(GL_BLEND_COLOR, colour.data());
  state["blend colour"].assign(colour.begin(), colour.end());
  clampColours(CLAMP_FRAGMENT_COLOR, static_cast<GLenum>(state["legacy clamp fragment colour"][0]));
}

GlState leftLegacyState() {
  GlState state;
  if (!isCompatibility()) return state;
  for (const char* zero : {"alpha test", "polygon stipple", "stencil test two-sided", "map colour", "red bias",
                           "green bias", "blue bias", "alpha bias"})
    state[std::string("legacy ") + zero] = {0};
  for (const char* one : {"red scale", "green scale", "blue scale", "alpha scale"})
    state[std::string("legacy ") + one] = {1};
  state["legacy clamp fragment colour"] = {GL_FIXED_ONLY};
  state["legacy active stencil face"] = {GL_FRONT};
  return state;
}

void poisonLegacyState() {
  if (!isCompatibility()) return;
  for (const auto& entry : kCapabilities)
    gl().Enable(entry.second);
  call<void, GLenum, GLfloat>("glAlphaFunc", GL_NEVER, 0.5F);
  stippleNothing();
  for (const GLenum target : {CLAMP_VERTEX_COLOR, CLAMP_FRAGMENT_COLOR, CLAMP_READ_COLOR})
    clampColours(target, GL_TRUE);
  setTransfer(0.5F, 0.25F);
  transfer(MAP_COLOR, GL_TRUE);
  call<void, GLenum>("glActiveStencilFaceEXT", GL_BACK);
}

void addLegacyRows(Rows& rows) {
  if (!isCompatibility()) return;
  addFragments(rows);
  addVertices(rows);
  addPixels(rows);
  addModes(rows);
}

void leaveCleanLegacyState() {
  if (!isCompatibility()) return;
  for (const auto& entry : kCapabilities)
    gl().Disable(entry.second);
  for (const GLenum capability : {INDEX_LOGIC_OP, TEXTURE_GEN_S, TEXTURE_2D})
    gl().Disable(capability);
  call<void, GLenum, GLfloat>("glAlphaFunc", GL_ALWAYS, 0);
  for (const GLenum target : {CLAMP_VERTEX_COLOR, CLAMP_FRAGMENT_COLOR, CLAMP_READ_COLOR})
    clampColours(target, target == CLAMP_VERTEX_COLOR ? GL_TRUE : GL_FIXED_ONLY);
  setTransfer(1, 0);
  setMaps({0, 0});
  for (const GLenum name : {MAP_COLOR, MAP_STENCIL, INDEX_SHIFT, INDEX_OFFSET})
    transfer(name, 0);
  for (const GLenum face : {GL_BACK, GL_FRONT}) {
    call<void, GLenum>("glActiveStencilFaceEXT", face);
    gl().StencilFunc(GL_ALWAYS, 0, ~0U);
    gl().StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gl().StencilMask(~0U);
  }
  call<void, GLenum>("glShadeModel", SMOOTH);
  for (const GLenum mode : {TEXTURE, PROJECTION, MODELVIEW}) {
    call<void, GLenum>("glMatrixMode", mode);
    call<void>("glLoadIdentity");
  }
  call<void, GLenum, GLenum, GLint>("glTexEnvi", TEXTURE_ENV, TEXTURE_ENV_MODE, MODULATE);
  call<void, GLenum, GLenum, GLfloat>("glTexEnvf", TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, 0);
  for (const GLenum array : {VERTEX_ARRAY, COLOR_ARRAY})
    call<void, GLenum>("glDisableClientState", array);
  gl().Hint(PERSPECTIVE_CORRECTION_HINT, GL_DONT_CARE);
}

} // namespace tests
