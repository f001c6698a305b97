#include "SceneRig.h"

#include "gl/ReadBack.h"
#include "reference/CameraRays.h"
#include "reference/Metrics.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

using namespace tyndall;
using host::gl;

namespace tests {

namespace {

constexpr int kShadowSize = 32;
constexpr double kShadowNear = 0.1, kShadowFar = 12; // of point and spot lights

float uniform(std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24F; }

std::size_t countOf(int a, int b, int c = 1) {
  return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
}

// Writes one sample of every pixel of the bound multisample framebuffer from a depth texture.
const char* const kFullScreen = "#version 330 core\n"
                                "void main() {\n"
                                "  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
                                "  gl_Position = vec4(p, 0.0, 1.0);\n"
                                "}\n";
const char* const kCopyDepth = "#version 330 core\n"
                               "uniform sampler2D depth;\n"
                               "layout(location = 0) out vec4 value;\n"
                               "void main() {\n"
                               "  value = texelFetch(depth, ivec2(gl_FragCoord.xy), 0);\n"
                               "  gl_FragDepth = value.r;\n"
                               "}\n";

void drawSample(host::Program& program, int sample, const host::GlTexture& values) {
  gl().SampleMaski(0, 1U << sample);
  gl().ActiveTexture(GL_TEXTURE0);
  gl().BindTexture(GL_TEXTURE_2D, values.name());
  program.set("depth", 0);
  gl().DrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace

Mat4 DepthConvention::clipFromView(double size, double aspect) const {
  glm::dmat4 m(0); // to z in [0, 1]
  m[0][0] = 1 / (size * aspect);
  m[1][1] = 1 / size;
  if (orthographic) {
    m[2][2] = (reversed ? 1 : -1) / (far - near);
    m[3][2] = (reversed ? far : -near) / (far - near);
    m[3][3] = 1;
  } else {
    m[2][3] = -1;
    const double k = infinite ? 1 : far / (far - near);
    m[2][2] = reversed ? k - 1 : -k;
    m[3][2] = near * (reversed ? k : -k);
  }
  if (clipDepth == ClipDepth::NegativeOneToOne)
    for (int c = 0; c < 4; ++c)
      m[c][2] = 2 * m[c][2] - m[c][3];
  return toMat4(m);
}

float DepthConvention::windowDepth(double viewDistance) const {
  double d = 1; // standard
  if (!std::isfinite(viewDistance))
    d = 1;
  else if (orthographic)
    d = (viewDistance - near) / (far - near);
  else
    d = (1 - near / viewDistance) * (infinite ? 1 : far / (far - near));
  if (!reversed) return static_cast<float>(d);
  if (infinite && std::isfinite(viewDistance)) return static_cast<float>(near / viewDistance);
  return static_cast<float>(1 - d);
}

std::vector<double> wallDistances(int width, int height) {
  std::vector<double> distances;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      distances.push_back((x / 5 + y / 4) % 5 == 0 ? kInfinity : 3 + 6 * (x + 0.5) / width + 0.1 * (y % 7));
  return distances;
}

std::vector<float> casterDepths(Casters casters, LightKind kind, int size, int layers, unsigned seed) {
  std::vector<float> depths(countOf(size, size, layers), casters == Casters::AllDark ? 0.0F : 1.0F);
  if (casters != Casters::Blocks) return depths;
  std::mt19937 random(seed);
  const auto side = static_cast<float>(size);
  for (int block = 0; block < 30 * layers; ++block) {
    const int layer = block % layers;
    const int x0 = static_cast<int>(uniform(random) * side), y0 = static_cast<int>(uniform(random) * side);
    const int extent = 1 + static_cast<int>(uniform(random) * side / 6);
    const float base = 0.1F + 0.8F * uniform(random), slope = 0.2F * (uniform(random) - 0.5F) / side;
    for (int y = y0; y < std::min(size, y0 + extent); ++y)
      for (int x = x0; x < std::min(size, x0 + extent); ++x) {
        float& depth = depths[countOf(layer, size, size) + countOf(y, size) + static_cast<std::size_t>(x)];
        depth = std::min(depth, base + slope * static_cast<float>(x - x0));
      }
  }
  if (kind == LightKind::Directional) return depths;
  // Perspective crowds depth near 1: what was linear becomes a distance.
  for (float& depth : depths)
    if (depth < 1) {
      const double distance = kShadowNear + (kShadowFar - kShadowNear) * depth;
      depth = static_cast<float>((1 - kShadowNear / distance) * kShadowFar / (kShadowFar - kShadowNear));
    }
  return depths;
}

std::vector<ShadowView> shadowViewsOf(const Light& light) {
  const glm::dvec3 position = reference::toVec3(light.position), direction = reference::toVec3(light.direction);
  if (light.kind == LightKind::Directional) {
    const glm::dmat4 view = glm::lookAt(-30.0 * glm::normalize(direction), glm::dvec3(0), glm::dvec3(0, 0, 1));
    return {{toMat4(glm::ortho(-20.0, 20.0, -20.0, 20.0, 1.0, 60.0) * view), 0}};
  }
  if (light.kind == LightKind::Spot)
    return {{toMat4(glm::perspective(2 * light.outerConeAngle + 0.01, 1.0, kShadowNear, kShadowFar) *
                    glm::lookAt(position, position + direction, glm::dvec3(0, 0, 1))),
             0}};
  std::vector<ShadowView> faces;
  for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0),
                                 glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)}) {
    const glm::dvec3 up = axis.y != 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    faces.push_back({toMat4(glm::perspective(glm::radians(90.0), 1.0, kShadowNear, kShadowFar) *
                            glm::lookAt(position, position + axis, up)),
                     static_cast<int>(faces.size())});
  }
  return faces;
}

SceneRig::SceneRig(int width, int height, RigContext context) : distances(wallDistances(width, height)) {
  if (context == RigContext::Test) testContext();
  frame.viewport.width = width;
  frame.viewport.height = height;
  frame.settings.technique = Technique::Exact;
  frame.camera.viewFromWorld = lookAt({0, 1, 6}, {0.1, 0.4, 0});
  frame.medium.constituents = {{{0.05F, 0.1F, 0.2F}, Phase::HenyeyGreenstein, 0.3F},
                               {{0.02F, 0.02F, 0.02F}, Phase::Rayleigh, 0}};
  inscatter_ = host::makeTexture2D(GL_RGBA32F, width, height);
  transmittance_ = host::makeTexture2D(GL_RGBA32F, width, height);
  frame.output = {inscatter_.name(), transmittance_.name()};
  DepthConvention precise; // reversed, infinite, [0, 1]: what float32 holds best
  precise.reversed = precise.infinite = true;
  precise.clipDepth = ClipDepth::ZeroToOne;
  precise.near = 0.05;
  setConvention(precise);
}

void SceneRig::setConvention(const DepthConvention& convention, GLenum format) {
  convention_ = convention;
  frame.camera.clipDepth = convention.clipDepth;
  frame.camera.clipFromView = convention.clipFromView(convention.orthographic ? 2.5 : 0.5, 1.5);
  std::vector<float> depth;
  for (const double distance : distances)
    depth.push_back(convention.windowDepth(distance));
  setDepth(depth, format);
}

void SceneRig::setDepth(const std::vector<float>& depth, GLenum format) {
  depthTexture_ = floatTexture(format, frame.viewport.width, frame.viewport.height, depth);
  depth_ =
      format == GL_R32F ? depth : host::readDepth(depthTexture_.name(), frame.viewport.width, frame.viewport.height);
  samples_ = 1;
  frame.depth = {depthTexture_.name(), false};
}

int SceneRig::setMultisampledDepth(int samples, GLenum format, const std::function<float(int, int)>& depthOf) {
  host::Program program("copy depth", kFullScreen, kCopyDepth);
  const host::GlVertexArray vertexArray = host::makeVertexArray();
  const host::GlFramebuffer framebuffer = host::makeFramebuffer();
  depthTexture_ = host::makeTexture2DMultisample(format, frame.viewport.width, frame.viewport.height, samples);
  gl().GetTexLevelParameteriv(GL_TEXTURE_2D_MULTISAMPLE, 0, GL_TEXTURE_SAMPLES, &samples_);
  const bool isColour = format == GL_R32F;
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, isColour ? GL_COLOR_ATTACHMENT0 : host::depthAttachmentOf(format),
                            GL_TEXTURE_2D_MULTISAMPLE, depthTexture_.name(), 0);
  const GLenum buffer = isColour ? GL_COLOR_ATTACHMENT0 : GL_NONE;
  gl().DrawBuffers(1, &buffer);
  host::requireCompleteFramebuffer("multisampled depth");
  gl().BindVertexArray(vertexArray.name());
  gl().Viewport(0, 0, frame.viewport.width, frame.viewport.height);
  gl().Enable(GL_SAMPLE_MASK);
  gl().Enable(GL_DEPTH_TEST);
  gl().DepthFunc(GL_ALWAYS);
  program.use();
  const int pixels = frame.viewport.width * frame.viewport.height;
  depth_.assign(countOf(pixels, samples_), 0);
  for (int sample = 0; sample < samples_; ++sample) {
    std::vector<float> values;
    for (int pixel = 0; pixel < pixels; ++pixel) {
      values.push_back(depthOf(pixel, sample));
      depth_[countOf(pixel, samples_) + static_cast<std::size_t>(sample)] = values.back();
    }
    drawSample(program, sample, floatTexture(GL_R32F, frame.viewport.width, frame.viewport.height, values));
  }
  gl().SampleMaski(0, ~0U);
  gl().Disable(GL_SAMPLE_MASK);
  gl().Disable(GL_DEPTH_TEST);
  gl().DepthFunc(GL_LESS);
  gl().BindVertexArray(0);
  gl().UseProgram(0);
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  frame.depth = {depthTexture_.name(), true};
  return samples_;
}

Light& SceneRig::addLight(LightKind kind, Casters casters, bool glass) {
  Light light;
  light.kind = kind;
  light.direction = {0.4, -1, -0.3};
  light.position = {-0.7, 2.5, 0.4};
  light.colour = {5, 4, 3};
  light.outerConeAngle = 0.6;
  light.innerConeAngle = 0.4;
  const auto layers = static_cast<int>(shadowViewsOf(light).size());
  reference::ShadowImage image{};
  if (casters != Casters::None) {
    light.shadow.views = shadowViewsOf(light);
    image = {kShadowSize, kShadowSize, layers, casterDepths(casters, kind, kShadowSize, layers), {}, {}};
  }
  if (glass) {
    std::mt19937 random(11);
    image.glassColour.resize(3 * image.depth.size());
    for (float& c : image.glassColour)
      c = uniform(random);
    image.glassDepth = casterDepths(Casters::Blocks, kind, kShadowSize, layers, 13);
  }
  frame.lights.push_back(light);
  images_.emplace_back();
  maps_.emplace_back();
  if (casters != Casters::None) setShadow(frame.lights.size() - 1, image);
  return frame.lights.back();
}

void SceneRig::setShadow(std::size_t light, const reference::ShadowImage& image) {
  images_[light] = image;
  maps_[light].image = image;
  maps_[light].upload(frame.lights[light]);
}

host::GlTexture SceneRig::makeColour(GLenum format, const std::vector<float>& rgba) {
  host::GlTexture texture = host::makeTexture2D(format, frame.viewport.width, frame.viewport.height);
  gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, frame.viewport.width, frame.viewport.height, GL_RGBA, GL_FLOAT,
                     rgba.data());
  frame.colour = texture.name();
  return texture;
}

reference::ImageAnswer SceneRig::render(Effect& effect) {
  const Status status = effect.render(frame);
  INFO(status.message);
  REQUIRE(status);
  return outputs();
}

reference::ImageAnswer SceneRig::outputs() const {
  const auto read = [&](const host::GlTexture& texture) {
    return reference::Image(frame.viewport.width, frame.viewport.height,
                            host::readColour(texture.name(), frame.viewport.width, frame.viewport.height, 3));
  };
  return {read(inscatter_), read(transmittance_)};
}

reference::ImageAnswer SceneRig::reference() const {
  reference::MapScene scene;
  scene.camera = frame.camera;
  scene.lights = frame.lights;
  scene.shadows = images_;
  scene.curves = curves;
  const EyeCurves& eye = frame.eyeCurves;
  scene.eyeCurves = {eyeCurves, eye.nearDistance, eye.farDistance, {eye.albedo, eye.phase, eye.g}, eye.dimsBackground};
  scene.medium = frame.medium;
  scene.ambient = frame.ambient;
  scene.filter = frame.settings.shadowFilter;
  scene.width = frame.viewport.width;
  scene.height = frame.viewport.height;
  scene.occlusion = occlusion;
  scene.samples = samples_;
  scene.depth = depth_;
  return reference::mapExact(scene);
}

SceneRig threeLights() {
  SceneRig rig;
  rig.addLight(LightKind::Directional, Casters::Blocks, true);
  rig.addLight(LightKind::Point);
  rig.addLight(LightKind::Spot);
  return rig;
}

void checkFinite(SceneRig& rig) {
  const reference::ImageAnswer answer = rig.render();
  CHECK(isFiniteAndNonNegative(answer.inscatter));
  CHECK(isFiniteAndNonNegative(answer.transmittance));
}

double difference(const reference::Image& image, const reference::Image& expected) {
  const reference::ErrorMetrics metrics = reference::compare(image, expected);
  if (!std::isfinite(metrics.max)) return metrics.max;
  double worst = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    if (const double error = std::abs(image.rgb[i] - expected.rgb[i]); error > 0)
      worst = std::max(worst, error / std::max(metrics.mean, expected.rgb[i]));
  return worst;
}

bool isFiniteAndNonNegative(const reference::Image& image) {
  return std::all_of(image.rgb.begin(), image.rgb.end(), [](double v) { return std::isfinite(v) && v >= 0; });
}

bool bitEqual(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

void transformWorld(Frame& frame, double scale, const glm::dvec3& offset) {
  const glm::dmat4 worldFromOld = glm::scale(glm::translate(glm::dmat4(1), offset), glm::dvec3(scale));
  const glm::dmat4 oldFromWorld = glm::translate(glm::scale(glm::dmat4(1), glm::dvec3(1 / scale)), -offset);
  const auto move = [&](Vec3& point) {
    const glm::dvec3 p = glm::dvec3(worldFromOld * glm::dvec4(reference::toVec3(point), 1));
    point = {p.x, p.y, p.z};
  };
  // The view keeps its unit of length's share in the projection: view space is scaled too.
  Camera& camera = frame.camera;
  const glm::dmat4 viewScale = glm::scale(glm::dmat4(1), glm::dvec3(scale));
  camera.viewFromWorld = toMat4(viewScale * reference::toMat4(camera.viewFromWorld) * oldFromWorld);
  camera.clipFromView =
      toMat4(reference::toMat4(camera.clipFromView) * glm::scale(glm::dmat4(1), glm::dvec3(1 / scale)));
  for (Light& light : frame.lights) {
    move(light.position);
    move(light.boundary.point);
    light.range *= scale;
    if (light.kind != LightKind::Directional)
      for (float& c : light.colour)
        c = static_cast<float>(c * scale * scale);
    for (ShadowView& view : light.shadow.views)
      view.clipFromWorld = toMat4(reference::toMat4(view.clipFromWorld) * oldFromWorld);
  }
  for (Constituent& c : frame.medium.constituents)
    for (float& s : c.scattering)
      s = static_cast<float>(s / scale);
  for (float& a : frame.medium.absorption)
    a = static_cast<float>(a / scale);
  frame.eyeCurves.nearDistance *= scale;
  frame.eyeCurves.farDistance *= scale;
  frame.medium.farDistance *= scale;
  const double raised = glm::dot(glm::normalize(reference::toVec3(frame.medium.up)), offset);
  for (HeightLayer& layer : frame.medium.layers) {
    layer.height = layer.height * scale + raised;
    layer.ground = layer.ground * scale + raised;
    layer.scale *= scale;
  }
}

} // namespace tests
