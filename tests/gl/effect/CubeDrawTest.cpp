// A cube map as a renderer draws and samples it: what the effect takes its faces for is what GL does.
#include "MapLayoutRig.h"
#include "gl/ReadBack.h"
#include "reference/CameraRays.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

using namespace tyndall;
using host::gl;

namespace {

constexpr int kSize = 128;
constexpr double kFar = tests::kFaceFar;

// Cubes from -1 to 1, placed around a lamp so that no turn or mirror image of the scene is the scene.
std::vector<glm::dmat4> boxes() {
  const auto box = [](const glm::dvec3& middle, const glm::dvec3& half) {
    return glm::scale(glm::translate(glm::dmat4(1), middle), half);
  };
  return {box({3, 3, 1}, {0.3, 1.5, 0.8}),       box({-4, 5, -0.5}, {0.5, 0.7, 2}), box({0.5, 7, 0.7}, {1, 0.2, 0.6}),
          box({-0.6, 1, -0.4}, {0.5, 0.2, 0.8}), box({1, 3.5, 4}, {0.7, 0.9, 0.3}), box({0.8, 5, -3}, {1.2, 0.5, 0.3}),
          box({0, -1, 0}, {30, 0.5, 30})};
}

double hitDistance(const glm::dvec3& origin, const glm::dvec3& direction) {
  double nearest = kFar;
  for (const glm::dmat4& worldFromCube : boxes()) {
    const glm::dmat4 inverse = glm::inverse(worldFromCube);
    const glm::dvec3 from(inverse * glm::dvec4(origin, 1)), along(inverse * glm::dvec4(direction, 0));
    const glm::dvec3 a = (-1.0 - from) / along, b = (1.0 - from) / along;
    const glm::dvec3 enter = glm::min(a, b), leave = glm::max(a, b);
    const double t = std::max({enter.x, enter.y, enter.z});
    if (t > 0 && t < nearest && t <= std::min({leave.x, leave.y, leave.z})) nearest = t;
  }
  return nearest;
}

constexpr const char* kCasterVertices = R"(#version 330 core
uniform mat4 worldFromCube, clipFromWorld;
out vec3 worldPosition;
void main() { // 36 corners of a cube's triangles
  const int kCorners[36] = int[](0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3);
  int corner = kCorners[gl_VertexID];
  vec4 position = worldFromCube * vec4(2.0 * vec3(corner & 1, (corner >> 1) & 1, corner >> 2) - 1.0, 1.0);
  worldPosition = position.xyz;
  gl_Position = clipFromWorld * position;
})";
constexpr const char* kCasterDistance = R"(#version 330 core
uniform vec3 lightPosition;
uniform float far;
in vec3 worldPosition;
layout(location = 0) out float outDistance;
void main() { outDistance = distance(worldPosition, lightPosition) / far; })";

constexpr const char* kScreen = R"(#version 330 core
void main() { gl_Position = vec4(4.0 * float(gl_VertexID & 1) - 1.0, 4.0 * float(gl_VertexID >> 1) - 1.0, 0.0, 1.0); })";
constexpr const char* kLookUp = R"(#version 330 core
uniform samplerCube map;
uniform sampler2D directions;
layout(location = 0) out float outDistance;
void main() { outDistance = texture(map, texelFetch(directions, ivec2(gl_FragCoord.xy), 0).xyz).r; })";

// Distances over the far plane's, as engines draw them: a face at a time.
host::GlTexture drawCube(const Light& light) {
  host::GlTexture cube = host::makeTexture();
  gl().BindTexture(GL_TEXTURE_CUBE_MAP, cube.name());
  for (GLenum face = 0; face < 6; ++face)
    gl().TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_R32F, kSize, kSize, 0, GL_RED, GL_FLOAT, nullptr);
  gl().TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl().TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  const host::GlTexture depth = host::makeTexture2D(GL_DEPTH_COMPONENT24, kSize, kSize);
  const host::GlFramebuffer framebuffer = host::makeFramebuffer();
  const host::GlVertexArray vertices = host::makeVertexArray();
  host::Program program("casters", kCasterVertices, kCasterDistance);
  program.use();
  program.set("lightPosition", glm::vec3(reference::toVec3(light.position)));
  program.set("far", static_cast<float>(kFar));
  gl().BindVertexArray(vertices.name());
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth.name(), 0);
  gl().Viewport(0, 0, kSize, kSize);
  gl().Enable(GL_DEPTH_TEST);
  const std::vector<ShadowView> views = tests::faceViews(light);
  for (std::size_t face = 0; face < 6; ++face) {
    gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                              GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), cube.name(), 0);
    host::requireCompleteFramebuffer("a face");
    gl().ClearColor(1, 0, 0, 0);
    gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    program.set("clipFromWorld", glm::mat4(reference::toMat4(views[face].clipFromWorld)));
    for (const glm::dmat4& box : boxes()) {
      program.set("worldFromCube", glm::mat4(box));
      gl().DrawArrays(GL_TRIANGLES, 0, 36);
    }
  }
  gl().Disable(GL_DEPTH_TEST);
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl().UseProgram(0);
  return cube;
}

// As a surface's shader asks the map.
std::vector<float> lookUp(GLuint cube, const std::vector<glm::vec3>& directions) {
  std::vector<float> texels;
  for (const glm::vec3& d : directions)
    texels.insert(texels.end(), {d.x, d.y, d.z, 0});
  const auto count = static_cast<int>(directions.size());
  const host::GlTexture table = tests::floatTexture(GL_RGBA32F, count, 1, texels);
  const host::GlTexture target = host::makeTexture2D(GL_R32F, count, 1);
  const host::GlFramebuffer framebuffer = host::makeFramebuffer();
  const host::GlVertexArray vertices = host::makeVertexArray();
  host::Program program("look-up", kScreen, kLookUp);
  program.use();
  program.set("map", 0);
  program.set("directions", 1);
  gl().ActiveTexture(GL_TEXTURE1);
  gl().BindTexture(GL_TEXTURE_2D, table.name());
  gl().ActiveTexture(GL_TEXTURE0);
  gl().BindTexture(GL_TEXTURE_CUBE_MAP, cube);
  gl().BindVertexArray(vertices.name());
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.name(), 0);
  gl().Viewport(0, 0, count, 1);
  gl().DrawArrays(GL_TRIANGLES, 0, 3);
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl().UseProgram(0);
  return host::readColour(target.name(), count, 1, 1);
}

// Window depths of the same boxes through the same faces, by rays.
reference::ShadowImage castFaces(const Light& light) {
  reference::ShadowImage image{kSize, kSize, 6, {}, {}, {}};
  for (const ShadowView& view : tests::faceViews(light)) {
    const glm::dmat4 clip = reference::toMat4(view.clipFromWorld), inverse = glm::inverse(clip);
    const glm::dvec3 origin = reference::toVec3(light.position);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const glm::dvec4 far = inverse * glm::dvec4(2.0 * (glm::dvec2(x, y) + 0.5) / double(kSize) - 1.0, 0.5, 1);
        const glm::dvec3 direction = glm::normalize(glm::dvec3(far) / far.w - origin);
        const double hit = hitDistance(origin, direction);
        const glm::dvec4 at = clip * glm::dvec4(origin + hit * direction, 1);
        image.depth.push_back(hit < kFar ? static_cast<float>(0.5 + 0.5 * at.z / at.w) : 1.0F);
      }
  }
  return image;
}

Light lamp() {
  Light light = tests::shaftLight(LightKind::Point);
  light.position = {0.2, 3.6, 0.3};
  return light;
}

} // namespace

TEST_CASE("a cube map that GL draws face by face shades a surface and the air alike") {
  tests::SceneRig rig(48, 32);
  rig.addLight(LightKind::Point, tests::Casters::None);
  Light& light = rig.frame.lights[0];
  light = lamp();
  light.shadow.views = tests::faceViews(light);
  rig.setShadow(0, castFaces(light));
  const Light array = light;
  const host::GlTexture cube = drawCube(light);

  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<glm::vec3> directions;
  for (int i = 0; i < 1000; ++i)
    directions.emplace_back(uniform(random), uniform(random), uniform(random));
  const std::vector<float> found = lookUp(cube.name(), directions);
  int right = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(directions[i]));
    const double expected = hitDistance(reference::toVec3(light.position), direction) / kFar;
    if (std::abs(static_cast<double>(found[i]) - expected) <= 0.03 * expected) ++right;
  }
  CHECK(right >= 960); // the others lie along edges

  for (const Technique technique : {Technique::Exact, Technique::Epipolar}) {
    CAPTURE(static_cast<int>(technique));
    rig.frame.settings.technique = technique;
    const reference::Image truth = rig.render().inscatter;
    light.shadow.views.clear();
    light.shadow.texture = cube.name();
    light.shadow.array = false;
    light.shadow.cube = {true, 0, tests::kFaceNear, kFar};
    light.shadow.encoding = DepthEncoding::Radial;
    light.shadow.scale.unit = kFar;
    const double error = tests::relativeError(rig.render().inscatter, truth);
    light = array;
    light.shadow.texture = 0;
    const double ofAllShadows = tests::relativeError(rig.render().inscatter, truth);
    CAPTURE(error, ofAllShadows);
    CHECK(ofAllShadows > 0.05);
    CHECK(error <= 0.1 * ofAllShadows); // texels along edges
    light = array;
  }
}
