#include "gl/RenderState.h"

#include "gl/Gl.h"

#include <initializer_list>

namespace host {

void resetRenderState() {
  for (const GLenum capability :
       {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_POLYGON_OFFSET_FILL, GL_DEPTH_CLAMP,
        GL_RASTERIZER_DISCARD, GL_FRAMEBUFFER_SRGB, GL_COLOR_LOGIC_OP, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_COVERAGE,
        GL_PROGRAM_POINT_SIZE, GL_LINE_SMOOTH, GL_PRIMITIVE_RESTART}) {
    gl().Disable(capability);
  }
  gl().Enable(GL_DEPTH_TEST);
  gl().Enable(GL_MULTISAMPLE);
  gl().DepthMask(GL_TRUE);
  gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl().PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  gl().BlendEquation(GL_FUNC_ADD);
}

} // namespace host
