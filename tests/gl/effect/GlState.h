// Rows of the GL state, for tests that it is on return what it was on entry.
#pragma once

#include "gl/Objects.h"

#include <map>
#include <string>
#include <vector>

namespace tests {

using GlState = std::map<std::string, std::vector<double>>;

/// Every row that the effect or an AVSM could change, and some that they could not.
GlState captureGlState();

/// How many objects of each kind live in the current context.
std::vector<int> liveGlObjects();

/// Sets every row to something that no renderer has by default.
struct Poison {
  std::vector<host::GlTexture> textures;
  std::vector<host::GlSampler> samplers;
  host::GlBuffer uniforms = host::makeBuffer(), vertices = host::makeBuffer(), storage = host::makeBuffer();
  host::GlBuffer unpack = host::makeBuffer(), pack = host::makeBuffer();
  host::GlVertexArray vertexArray = host::makeVertexArray();
  host::GlTexture target = host::makeTexture2D(GL_RGBA16F, 8, 8);
  host::GlFramebuffer framebuffer = host::makeFramebuffer();
  host::Program program{"poison", "#version 330 core\nvoid main() { gl_Position = vec4(0); }",
                        "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1); }"};

  Poison();

  /// Back to GL's defaults; while the objects still live.
  static void lift();
};

} // namespace tests
