// Programs that light something, and the lights as their uniforms and textures.
#pragma once

#include "gl/Objects.h"

#include <map>
#include <tyndall/tyndall.h>

namespace host {

/// A program whose fragment shader goes behind shaders::kLights, in a variant for each layout of a light's curves and
/// one without; each is compiled when first needed.
class LitProgram {
public:
  /// fragmentBody: without its #version line.
  LitProgram(std::string name, const char* vertexSource, const char* fragmentBody);

  Program& variantFor(const tyndall::AvsmCurves& curves);

private:
  std::string name_;
  const char* vertexSource_;
  const char* fragmentBody_;
  std::map<int, Program> variants_;
};

/// Texture units of the light's maps are below this one.
inline constexpr GLuint kFirstFreeUnit = 8;

class LightUniforms {
public:
  LightUniforms();

  /// The unit that no light uses.
  static constexpr GLuint kBaseUnit = 0;

  /// Sets a light, for positions that are relative to `origin`, in the program in use. medium: null for none.
  void set(Program& program, const tyndall::Light& light, const glm::dvec3& origin,
           const tyndall::Medium* medium) const;

  /// Ambient light, which needs only the sky.
  static void setAmbient(Program& program, const glm::vec3& skyRadiance);

  static void unbindSamplers();

private:
  static void setMedium(Program& program, const tyndall::Medium& medium, const glm::dvec3& origin);
  void setShadow(Program& program, const tyndall::Light& light, const glm::dvec3& origin) const;
  void setCurves(Program& program, const tyndall::Light& light, const glm::dvec3& origin) const;

  GlSampler comparison_[2]; ///< of standard and of reversed shadow maps, whatever their textures' own parameters
  GlSampler nearest_;
};

/// World size of a texel of a view of `size` texels a side at w = 1, which is everywhere for a directional light.
double texelSizeOf(const glm::dmat4& clipFromWorld, int size);

} // namespace host
