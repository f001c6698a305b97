#include "gl/Objects.h"
#include "gl/ReadBack.h"
#include "gl/RenderTargets.h"
#include "scene/Error.h"
#include "support/Catch.h"
#include "support/TestContext.h"

using host::gl;
using host::GlTexture;

TEST_CASE("a GL object is deleted once, by its last owner", "[objects]") {
  tests::testContext();
  GLuint name = 0;
  {
    GlTexture first = host::makeTexture2D(GL_RGBA8, 2, 2);
    name = first.name();
    GlTexture second = std::move(first);
    CHECK(first.name() == 0); // NOLINT(bugprone-use-after-move,clang-analyzer-cplusplus.Move): a moved-from name is 0
    CHECK(second.name() == name);
    first = std::move(second);
    GlTexture& same = first;
    first = std::move(same);
    CHECK(first.name() == name);
    CHECK(gl().IsTexture(name));
  }
  CHECK(!gl().IsTexture(name));
}

TEST_CASE("a shader that does not compile says which and why", "[objects]") {
  tests::testContext();
  const char* vertex = "#version 330 core\nvoid main() { gl_Position = vec4(0); }\n";
  const char* fragment = "#version 330 core\nvoid main() { nonsense; }\n";
  CHECK_THROWS_WITH(host::Program("spoilt", vertex, fragment),
                    Catch::Contains("spoilt (fragment)") && Catch::Contains("nonsense"));
}

TEST_CASE("read-back gives rows from the bottom, layer by layer", "[objects]") {
  tests::testContext();
  const GlTexture picture = host::makeTexture2D(GL_RGBA32F, 3, 2);
  std::vector<float> texels(4 * 3 * 2);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    texels[i] = static_cast<float>(i) - 7.5F;
  }
  gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 3, 2, GL_RGBA, GL_FLOAT, texels.data());
  CHECK(host::readColour(picture.name(), 3, 2) == texels);
  CHECK(host::readColour(picture.name(), 3, 2, 1) == std::vector<float>{-7.5F, -3.5F, 0.5F, 4.5F, 8.5F, 12.5F});
  CHECK_THROWS_AS(host::readColour(picture.name(), 3, 2, 5), host::Error);

  const GlTexture depths = host::makeTextureArray(GL_DEPTH_COMPONENT32F, 2, 1, 2);
  const std::vector<float> values = {0.0F, 0.25F, 0.5F, 1.0F};
  gl().TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, 2, 1, 2, GL_DEPTH_COMPONENT, GL_FLOAT, values.data());
  CHECK(host::readDepthArray(depths.name(), 2, 1, 0) == std::vector<float>{0.0F, 0.25F});
  CHECK(host::readDepthArray(depths.name(), 2, 1, 1) == std::vector<float>{0.5F, 1.0F});
}

TEST_CASE("render targets refuse sizes that are not", "[objects]") {
  tests::testContext();
  CHECK_THROWS_WITH(host::RenderTargets({0, 4}), Catch::Contains("render target 0x4"));
  CHECK_THROWS_AS(host::RenderTargets({4, 20000}), host::Error);
}

TEST_CASE("render targets come in the formats asked for", "[objects]") {
  tests::testContext();
  for (const GLenum format :
       {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8, GL_DEPTH32F_STENCIL8}) {
    for (const int samples : {1, 4}) {
      host::RenderTargets targets({8, 4, GL_RGBA32F, format, samples});
      gl().BindFramebuffer(GL_FRAMEBUFFER, targets.framebuffer());
      gl().ClearColor(1, 2, 3, 4);
      gl().Clear(GL_COLOR_BUFFER_BIT);
      targets.resolve();
      const std::vector<float> colour = host::readColour(targets.colour(), 8, 4);
      CHECK(std::vector<float>(colour.begin(), colour.begin() + 4) == std::vector<float>{1, 2, 3, 4});
    }
  }
}
