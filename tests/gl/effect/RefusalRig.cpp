#include "RefusalRig.h"

#include "gl/ReadBack.h"
#include "support/Catch.h"

using namespace tyndall;
using host::gl;

namespace tests {

RefusalRig::RefusalRig() {
  testEffect();
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
    scene_.addLight(kind, Casters::None);
  std::vector<Light>& lights = scene_.frame.lights;
  for (Light& light : lights)
    light.shadow.views = shadowViewsOf(light);
  lights[0].shadow.views.push_back({lights[0].shadow.views[0].clipFromWorld, 1});
  const std::size_t texels = kShadowSize * kShadowSize;
  reference::ShadowImage image{kShadowSize,
                               kShadowSize,
                               2,
                               std::vector<float>(2 * texels, 0.5F),
                               std::vector<float>(6 * texels, 0.7F),
                               std::vector<float>(2 * texels, 0.2F)};
  scene_.setShadow(0, image);
  scene_.setShadow(1, {kShadowSize, kShadowSize, 6, std::vector<float>(6 * texels, 0.5F), {}, {}});
  map2D_ = floatTexture(GL_DEPTH_COMPONENT32F, kShadowSize, kShadowSize, image.depth);
  glassDepth2D_ = floatTexture(GL_R32F, kShadowSize, kShadowSize, image.glassDepth);
  glass2D_ = floatTexture(GL_RGB8, kShadowSize, kShadowSize, image.glassColour);
  lights[2].shadow.texture = map2D_.name();
  lights[2].glass = {glass2D_.name(), glassDepth2D_.name()};
  colour_ = scene_.makeColour(GL_RGBA16F, std::vector<float>(4 * kSize * kSize, 0.25F));
  frame = scene_.frame;
}

void RefusalRig::fillTargets() {
  const std::vector<float> values(4 * kSize * kSize, 0.25F);
  for (const GLuint texture : {frame.colour, frame.output.inscatter, frame.output.transmittance}) {
    gl().BindTexture(GL_TEXTURE_2D, texture);
    gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kSize, kSize, GL_RGBA, GL_FLOAT, values.data());
  }
}

std::vector<float> RefusalRig::readTargets() const {
  std::vector<float> all;
  for (const GLuint texture : {frame.colour, frame.output.inscatter, frame.output.transmittance}) {
    const std::vector<float> values = host::readColour(texture, kSize, kSize);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

void RefusalRig::checkRefused(const Frame& broken, const std::vector<std::string>& words) {
  fillTargets();
  const std::vector<float> before = readTargets();
  testContext().takeErrors();
  const Status status = testEffect().render(broken);
  CHECK(gl().GetError() == GL_NO_ERROR);
  testContext().takeErrors(); // the debug messages of a binding that the check tried
  INFO(status.message);
  CHECK(status.code == StatusCode::InvalidFrame);
  CHECK(status.message.find('\n') == std::string::npos);
  CHECK(status.message.rfind("Frame::", 0) == 0);
  for (const std::string& word : words) {
    INFO(word);
    CHECK(status.message.find(word) != std::string::npos);
  }
  CHECK(bitEqual(readTargets(), before));
}

void RefusalRig::checkAccepted(const Frame& good) {
  const Status status = testEffect().render(good);
  INFO(status.message);
  CHECK(status.code == StatusCode::Ok);
  CHECK(status.message.empty());
  CHECK(testContext().takeErrors().empty());
}

} // namespace tests
