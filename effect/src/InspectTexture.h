// One texture of the engine's, and whether it may be what a field of a frame asks for.
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"

#include <string>
#include <tyndall/tyndall.h>

namespace tyndall {

/// What a frame does with a texture.
enum class Use { Colour, Output, Depth, Map, Tint, Curves, Occlusion };

/// Level 0, of a cube map of one face.
struct TextureInfo {
  gl::Int width = 0;
  gl::Int height = 0;
  gl::Int layers = 1;
  gl::Int format = 0;
  gl::Int samples = 0;
};

/// "Frame::depth.texture is texture 7: the rule".
Status invalid(const std::string& field, gl::Uint name, const std::string& rule);

bool isFloatColour(gl::Int format);

/// R8, R16, R16F or R32F: one number a texel, of what is no depth.
bool isOneChannel(gl::Int format);

/// Binds a texture to the active unit, if it is of the target.
bool bindIfOf(const gl::Functions& gl, gl::Uint name, gl::Enum target);

/// Integers that stand for 0 to 1.
bool isFixedPoint(gl::Int format);

/// Largest radiance that a colour format holds.
float largestValue(gl::Int format);

/// Share of a distance by which a format of depths rounds it, or the shader that makes it one.
float roundingOf(gl::Int format);

/// All that is asked of one texture but its size. Leaves it bound to the active unit.
Status checkTexture(const gl::Functions& gl, const std::string& field, gl::Uint name, gl::Enum target, Use use,
                    TextureInfo& info);

Status checkSize(const std::string& field, gl::Uint name, const TextureInfo& info, int width, int height);

} // namespace tyndall
