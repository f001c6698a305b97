#include "support/EffectRig.h"

#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tests {

namespace {

bool isDepth(GLenum format) {
  switch (format) {
  case GL_DEPTH_COMPONENT16:
  case GL_DEPTH_COMPONENT24:
  case GL_DEPTH_COMPONENT32:
  case GL_DEPTH_COMPONENT32F:
  case GL_DEPTH24_STENCIL8:
  case GL_DEPTH32F_STENCIL8:
    return true;
  default:
    return false;
  }
}

GLenum transferFormat(GLenum internalFormat) {
  if (isDepth(internalFormat)) return GL_DEPTH_COMPONENT;
  if (internalFormat == GL_R32F) return GL_RED;
  return internalFormat == GL_RGB32F || internalFormat == GL_RGB16F || internalFormat == GL_R11F_G11F_B10F ? GL_RGB
                                                                                                           : GL_RGBA;
}

} // namespace

std::unique_ptr<tyndall::Effect> newEffect(tyndall::Config config) {
  if (!config.loader) config.loader = testContext().loader();
  tyndall::CreateResult created = tyndall::Effect::create(config);
  INFO(created.status.message);
  REQUIRE(created.effect);
  return std::move(created.effect);
}

tyndall::Effect& testEffect() {
  static const std::unique_ptr<tyndall::Effect> effect = newEffect();
  return *effect;
}

host::GlTexture floatTexture(GLenum internalFormat, int width, int height, const std::vector<float>& values) {
  host::GlTexture texture = host::makeTexture2D(internalFormat, width, height);
  host::gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  host::gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, transferFormat(internalFormat), GL_FLOAT,
                           values.data());
  return texture;
}

host::GlTexture floatTextureArray(GLenum internalFormat, int width, int height, int layers,
                                  const std::vector<float>& values) {
  host::GlTexture texture = host::makeTextureArray(internalFormat, width, height, layers);
  host::gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  host::gl().TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, width, height, layers, transferFormat(internalFormat),
                           GL_FLOAT, values.data());
  return texture;
}

void ShadowRig::upload(tyndall::Light& light, bool array, GLenum depthFormat) {
  const auto make = [&](GLenum format, const std::vector<float>& values) {
    return array ? floatTextureArray(format, image.width, image.height, image.layers, values)
                 : floatTexture(format, image.width, image.height, values);
  };
  depth = make(depthFormat, image.depth);
  light.shadow.texture = depth.name();
  light.shadow.array = array;
  if (image.glassColour.empty()) return;
  glassColour = make(GL_RGB32F, image.glassColour);
  glassDepth = make(depthFormat, image.glassDepth);
  light.glass = {glassColour.name(), glassDepth.name()};
}

FrameRig::FrameRig(int width, int height, const std::vector<float>& depth, GLenum depthFormat) : depth_(depth) {
  testContext();
  depthTexture_ = floatTexture(depthFormat, width, height, depth);
  inscatter_ = host::makeTexture2D(GL_RGBA32F, width, height);
  transmittance_ = host::makeTexture2D(GL_RGBA32F, width, height);
  frame.viewport.width = width;
  frame.viewport.height = height;
  frame.depth.texture = depthTexture_.name();
  frame.output = {inscatter_.name(), transmittance_.name()};
  frame.settings.technique = tyndall::Technique::Exact;
}

reference::ImageAnswer FrameRig::render() {
  const tyndall::Status status = testEffect().render(frame);
  INFO(status.message);
  REQUIRE(status);
  const auto read = [&](const host::GlTexture& texture) {
    return reference::Image(frame.viewport.width, frame.viewport.height,
                            host::readColour(texture.name(), frame.viewport.width, frame.viewport.height, 3));
  };
  return {read(inscatter_), read(transmittance_)};
}

reference::ImageAnswer FrameRig::reference(const std::vector<reference::ShadowImage>& shadows) const {
  reference::MapScene scene;
  scene.camera = frame.camera;
  scene.lights = frame.lights;
  scene.shadows = shadows;
  scene.medium = frame.medium;
  scene.ambient = frame.ambient;
  scene.filter = frame.settings.shadowFilter;
  scene.width = frame.viewport.width;
  scene.height = frame.viewport.height;
  scene.depth = depth_;
  return reference::mapExact(scene);
}

tyndall::Mat4 reversedInfinite(double verticalFov, double aspect, double near) {
  const double f = 1 / std::tan(verticalFov / 2);
  return {f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, 0, -1, 0, 0, near, 0};
}

tyndall::Mat4 toMat4(const glm::dmat4& m) {
  tyndall::Mat4 result{};
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      result[static_cast<std::size_t>(4 * c + r)] = m[c][r];
  return result;
}

tyndall::Mat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 forward = glm::normalize(target - eye);
  const glm::dvec3 up = std::abs(forward.y) > 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  return toMat4(glm::lookAt(eye, target, up));
}

} // namespace tests
