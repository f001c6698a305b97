// Textures back to the CPU as floats. Row 0 is the bottom row, as in GL.
#pragma once

#include "gl/Gl.h"

#include <vector>

namespace host {

/// Level 0 of a GL_TEXTURE_2D; channels 1 to 4, interleaved.
std::vector<float> readColour(GLuint texture, int width, int height, int channels = 4);

/// One layer of a GL_TEXTURE_2D_ARRAY.
std::vector<float> readColourArray(GLuint texture, int width, int height, int layer, int channels = 4);

/// A depth texture, GL_TEXTURE_2D.
std::vector<float> readDepth(GLuint texture, int width, int height);

/// One layer of a depth GL_TEXTURE_2D_ARRAY.
std::vector<float> readDepthArray(GLuint texture, int width, int height, int layer);

} // namespace host
