#include "RandomGlState.h"

#include "gl/Gl.h"
#include "support/TestContext.h"

using host::gl;

namespace stress {

namespace {

using Names = std::vector<GLenum>;

const Names kCapabilities = {GL_BLEND,
                             GL_CULL_FACE,
                             GL_DEPTH_TEST,
                             GL_STENCIL_TEST,
                             GL_SCISSOR_TEST,
                             GL_DITHER,
                             GL_COLOR_LOGIC_OP,
                             GL_RASTERIZER_DISCARD,
                             GL_FRAMEBUFFER_SRGB,
                             GL_MULTISAMPLE,
                             GL_SAMPLE_MASK,
                             GL_SAMPLE_COVERAGE,
                             GL_SAMPLE_ALPHA_TO_COVERAGE,
                             GL_SAMPLE_ALPHA_TO_ONE,
                             GL_POLYGON_SMOOTH,
                             GL_LINE_SMOOTH,
                             GL_POLYGON_OFFSET_FILL,
                             GL_DEPTH_CLAMP,
                             GL_PRIMITIVE_RESTART,
                             GL_PROGRAM_POINT_SIZE};
const Names kComparisons = {GL_NEVER, GL_LESS, GL_EQUAL, GL_LEQUAL, GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
const Names kStencilOps = {GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR, GL_DECR, GL_INVERT, GL_INCR_WRAP, GL_DECR_WRAP};
const Names kEquations = {GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX};
const Names kFactors = {GL_ZERO,
                        GL_ONE,
                        GL_SRC_COLOR,
                        GL_ONE_MINUS_SRC_COLOR,
                        GL_DST_COLOR,
                        GL_SRC_ALPHA,
                        GL_DST_ALPHA,
                        GL_SRC1_COLOR,
                        GL_ONE_MINUS_SRC1_ALPHA,
                        GL_CONSTANT_COLOR,
                        GL_CONSTANT_ALPHA,
                        GL_SRC_ALPHA_SATURATE};
const Names kLogicOps = {GL_CLEAR, GL_AND, GL_COPY, GL_XOR, GL_NOR, GL_INVERT, GL_SET};

class Setter {
public:
  explicit Setter(Random& random) : random_(random) {}

  void capabilities() {
    for (const GLenum capability : kCapabilities)
      set(capability);
    for (GLuint i = 0; i < 8; ++i)
      set(GL_CLIP_DISTANCE0 + i);
    for (GLuint i = 0; i < 8; ++i)
      (flag() ? gl().Enablei : gl().Disablei)(GL_BLEND, i);
  }

  void blending() {
    gl().BlendColor(value(), value(), value(), value());
    gl().BlendFuncSeparate(pick(kFactors), pick(kFactors), pick(kFactors), pick(kFactors));
    gl().BlendEquationSeparate(pick(kEquations), pick(kEquations));
    gl().LogicOp(pick(kLogicOps));
    for (GLuint i = 0; i < 8; ++i) {
      gl().ColorMaski(i, flag(), flag(), flag(), flag());
      if (!gl().BlendFuncSeparatei) continue;
      gl().BlendFuncSeparatei(i, pick(kFactors), pick(kFactors), pick(kFactors), pick(kFactors));
      gl().BlendEquationSeparatei(i, pick(kEquations), pick(kEquations));
    }
  }

  void rasterisation() {
    gl().CullFace(pick({GL_FRONT, GL_BACK, GL_FRONT_AND_BACK}));
    gl().FrontFace(pick({GL_CW, GL_CCW}));
    gl().PolygonMode(GL_FRONT_AND_BACK, pick({GL_POINT, GL_LINE, GL_FILL}));
    gl().PolygonOffset(value(), value());
    gl().PointSize(1 + 16 * value());
    gl().PrimitiveRestartIndex(static_cast<GLuint>(random_.below(5)));
    gl().ProvokingVertex(pick({GL_FIRST_VERTEX_CONVENTION, GL_LAST_VERTEX_CONVENTION}));
    gl().Viewport(random_.between(-9, 9), random_.between(-9, 9), random_.below(40), random_.below(40));
    gl().Scissor(random_.between(-9, 9), random_.between(-9, 9), random_.below(40), random_.below(40));
    gl().DepthRange(static_cast<double>(value()), static_cast<double>(value()));
    gl().SampleMaski(0, static_cast<GLuint>(random_.next()));
    gl().SampleCoverage(value(), flag());
    for (const GLenum hint : {GL_FRAGMENT_SHADER_DERIVATIVE_HINT, GL_POLYGON_SMOOTH_HINT})
      gl().Hint(hint, pick({GL_FASTEST, GL_NICEST, GL_DONT_CARE}));
    if (tests::testContext().glVersion() >= 45)
      gl().ClipControl(pick({GL_LOWER_LEFT, GL_UPPER_LEFT}), pick({GL_NEGATIVE_ONE_TO_ONE, GL_ZERO_TO_ONE}));
    if (!gl().ViewportIndexedf) return;
    for (GLuint i = 0; i < 16; ++i) {
      gl().ViewportIndexedf(i, 9 * value(), 9 * value(), 40 * value(), 40 * value());
      gl().ScissorIndexed(i, random_.below(9), random_.below(9), random_.below(40), random_.below(40));
      (flag() ? gl().Enablei : gl().Disablei)(GL_SCISSOR_TEST, i);
    }
  }

  void depthAndStencil() {
    gl().DepthFunc(pick(kComparisons));
    gl().DepthMask(flag());
    for (const GLenum face : {GL_FRONT, GL_BACK}) {
      gl().StencilFuncSeparate(face, pick(kComparisons), random_.below(256), static_cast<GLuint>(random_.below(256)));
      gl().StencilOpSeparate(face, pick(kStencilOps), pick(kStencilOps), pick(kStencilOps));
      gl().StencilMaskSeparate(face, static_cast<GLuint>(random_.below(256)));
    }
    gl().ClearStencil(random_.below(256));
    gl().ClearColor(value(), value(), value(), value());
    gl().ClearDepth(static_cast<double>(value()));
  }

  void pixels() {
    for (const GLenum name : {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST})
      gl().PixelStorei(name, flag());
    for (const GLenum name : {GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT})
      gl().PixelStorei(name, 1 << random_.below(4));
    for (const GLenum name : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES,
                              GL_PACK_IMAGE_HEIGHT, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
                              GL_UNPACK_SKIP_IMAGES, GL_UNPACK_IMAGE_HEIGHT})
      gl().PixelStorei(name, random_.below(50));
    gl().ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(random_.below(32)));
  }

private:
  void set(GLenum capability) { (flag() ? gl().Enable : gl().Disable)(capability); }
  GLboolean flag() { return random_.chance(0.5) ? GL_TRUE : GL_FALSE; }
  GLfloat value() { return static_cast<GLfloat>(random_.uniform()); }
  GLenum pick(const Names& names) { return random_.pick(names); }

  Random& random_;
};

} // namespace

void setRandomGlState(Random& random) {
  Setter setter(random);
  setter.capabilities();
  setter.blending();
  setter.rasterisation();
  setter.depthAndStencil();
  setter.pixels();
}

} // namespace stress
