#include "AvsmRig.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace tests {

namespace {

using host::gl;

constexpr GLuint kInput = 6, kOutput = 7;

// A compute program, for one test.
class ComputeProgram {
public:
  explicit ComputeProgram(const std::string& source) : name_(gl().CreateProgram()) {
    const GLuint shader = gl().CreateShader(GL_COMPUTE_SHADER);
    const char* text = source.c_str();
    gl().ShaderSource(shader, 1, &text, nullptr);
    gl().CompileShader(shader);
    char log[4096] = "";
    gl().GetShaderInfoLog(shader, sizeof log, nullptr, log);
    INFO(log);
    GLint ok = 0;
    gl().GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    REQUIRE(ok);
    gl().AttachShader(name_, shader);
    gl().LinkProgram(name_);
    gl().DeleteShader(shader);
    gl().GetProgramiv(name_, GL_LINK_STATUS, &ok);
    REQUIRE(ok);
  }
  ~ComputeProgram() {
    gl().UseProgram(0);
    gl().DeleteProgram(name_);
  }
  ComputeProgram(const ComputeProgram&) = delete;
  ComputeProgram& operator=(const ComputeProgram&) = delete;
  void run(std::size_t count) const {
    gl().UseProgram(name_);
    gl().DispatchCompute(static_cast<GLuint>((count + 63) / 64), 1, 1);
    gl().MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  }

private:
  GLuint name_;
};

void fillBuffer(const host::GlBuffer& buffer, GLuint binding, std::size_t bytes, const void* data) {
  gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
  gl().BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_DYNAMIC_COPY);
}

void unbind() {
  for (const GLuint binding : {kInput, kOutput})
    gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, 0);
}

constexpr const char* kCapture = R"(
layout(local_size_x = 64) in;
struct Segment { ivec4 texel; vec4 values; };
layout(std430, binding = 6) readonly buffer Input { Segment segments[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(segments.length())) return;
  tyndallCapture(segments[i].texel.xyz, segments[i].values.x, segments[i].values.y, segments[i].values.z);
}
)";

constexpr const char* kCaptureLastFirst = R"(
layout(local_size_x = 1) in;
struct Segment { ivec4 texel; vec4 values; };
layout(std430, binding = 6) readonly buffer Input { Segment segments[]; };
void main() {
  if (gl_GlobalInvocationID.x > 0u) return;
  for (int i = segments.length() - 1; i >= 0; --i)
    tyndallCapture(segments[i].texel.xyz, segments[i].values.x, segments[i].values.y, segments[i].values.z);
}
)";

constexpr const char* kInsert = R"(
layout(local_size_x = 1) in;
struct Segment { ivec4 texel; vec4 values; };
layout(std430, binding = 6) readonly buffer Input { Segment segments[]; };
void main() {
  if (gl_GlobalInvocationID.x > 0u) return;
  for (int i = 0; i < segments.length(); ++i)
    tyndallInsertAt(segments[i].texel.xyz, segments[i].values.x, segments[i].values.y, segments[i].values.z);
}
)";

} // namespace

bool hasAvsm() {
  GLint major = 0, minor = 0;
  testContext();
  gl().GetIntegerv(GL_MAJOR_VERSION, &major);
  gl().GetIntegerv(GL_MINOR_VERSION, &minor);
  if (10 * major + minor >= 43) return true;
  WARN("skipped: the context is older than OpenGL 4.3");
  return false;
}

bool hasExtension(const std::string& name) {
  GLint count = 0;
  gl().GetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i)
    if (name == reinterpret_cast<const char*>(gl().GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)))) return true;
  return false;
}

std::vector<Captured> segmentsOf(const Puffs& puffs, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  const auto within = [&](const glm::vec2& range) { return range.x + range.y * uniform(random); };
  std::vector<Captured> all;
  for (int view = 0; view < puffs.views; ++view)
    for (int puff = 0; puff < puffs.count; ++puff) {
      glm::vec2 middle; // in this order, whatever the compiler
      middle.x = static_cast<float>(puffs.size) * uniform(random);
      middle.y = static_cast<float>(puffs.size) * uniform(random);
      const float radius = static_cast<float>(puffs.size) * within(puffs.radius);
      const float at = within(puffs.depth);
      const float thickness = within(puffs.thickness);
      for (int y = 0; y < puffs.size; ++y)
        for (int x = 0; x < puffs.size; ++x) {
          const float off = glm::length(glm::vec2(x, y) + 0.5F - middle) / radius;
          if (off >= 1) continue;
          const float half = thickness * std::sqrt(1 - off * off);
          const float passed = puffs.solid && puff == 0 ? 0 : std::exp(-puffs.density * half);
          all.push_back({{x, y, view}, at - half, at + half, passed});
        }
    }
  return all;
}

tyndall::Light parallelLight() {
  tyndall::Light light;
  light.direction = {0, 0, -1};
  light.shadow.views = {{toMat4(glm::scale(glm::dmat4(1), glm::dvec3(1, 1, -1))), 0}};
  return light;
}

tyndall::Light spotLight(bool reversed) {
  tyndall::Light light;
  light.kind = tyndall::LightKind::Spot;
  light.position = {0, 0, 2};
  const glm::dmat4 view = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -2));
  glm::dmat4 projection = glm::perspective(1.0, 1.0, kSpotNear, kSpotFar);
  if (reversed) projection = glm::scale(glm::dmat4(1), glm::dvec3(1, 1, -1)) * projection;
  light.shadow.views = {{toMat4(projection * view), 0}};
  return light;
}

double depthOfSpot() { return -kSpotNear / (kSpotFar - kSpotNear); }

double curveAt(const Curve& curve, double depth, bool exponential) {
  glm::dvec2 before(0, 1);
  for (const glm::dvec2& node : curve) {
    if (depth < node.x) {
      if (&node == &curve.front()) return 1;
      const double share = (depth - before.x) / (node.x - before.x);
      return exponential ? before.y * std::pow(std::max(node.y, 1e-7) / before.y, share)
                         : before.y + (node.y - before.y) * share;
    }
    before = node;
  }
  return before.y;
}

double curveError(const Curve& curve, const std::vector<reference::Segment>& segments) {
  constexpr int kDepths = 2000;
  double sum = 0;
  for (int i = 0; i < kDepths; ++i) {
    const double depth = (i + 0.5) / kDepths;
    sum += std::abs(curveAt(curve, depth) - reference::transmittanceAt(segments, depth));
  }
  return sum / kDepths;
}

AvsmRig::AvsmRig(const tyndall::AvsmConfig& config) : config_(config) {
  config_.loader = testContext().loader();
  tyndall::AvsmResult result = tyndall::Avsm::create(config_);
  INFO(result.status.message);
  REQUIRE(result.avsm);
  avsm_ = std::move(result.avsm);
}

namespace {

struct Input {
  glm::ivec4 texel;
  glm::vec4 values;
};

std::vector<Input> inputsOf(const std::vector<Captured>& segments) {
  std::vector<Input> inputs;
  inputs.reserve(segments.size());
  for (const Captured& s : segments)
    inputs.push_back({glm::ivec4(s.texel, 0), glm::vec4(s.entry, s.exit, s.transmittance, 0)});
  return inputs;
}

void captureBy(tyndall::Avsm& avsm, const std::vector<Input>& inputs, const char* shader, std::size_t invocations) {
  const tyndall::Status began = avsm.begin(2);
  INFO(began.message);
  REQUIRE(began);
  if (inputs.empty()) return;
  const ComputeProgram program(
      std::string("#version 430 core\n#define TYNDALL_LISTS_BINDING 2\n#define TYNDALL_SEGMENTS_BINDING 3\n") +
      tyndall::avsmCaptureSource() + shader);
  const host::GlBuffer buffer = host::makeBuffer();
  fillBuffer(buffer, kInput, inputs.size() * sizeof(Input), inputs.data());
  program.run(invocations);
  unbind();
}

} // namespace

tyndall::AvsmConfig configOf(tyndall::CurveReduction reduction, int size, int nodes, bool packed) {
  tyndall::AvsmConfig config;
  config.size = size;
  config.nodes = nodes;
  config.packed = packed;
  config.reduction = reduction;
  return config;
}

void checkNear(const Curve& a, const Curve& b, double margin) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CAPTURE(i);
    CHECK(a[i].x == Approx(b[i].x).margin(margin));
    CHECK(a[i].y == Approx(b[i].y).margin(margin));
  }
}

void captureInto(tyndall::Avsm& avsm, const std::vector<Captured>& segments) {
  captureBy(avsm, inputsOf(segments), kCapture, segments.size());
}

void captureLastFirst(tyndall::Avsm& avsm, const std::vector<Captured>& segments) {
  captureBy(avsm, inputsOf(segments), kCaptureLastFirst, 1);
}

void insertByImage(tyndall::Avsm& avsm, const std::vector<Captured>& segments) {
  const tyndall::AvsmCurves curves = avsm.curves();
  const std::vector<Input> inputs = inputsOf(segments);
  const ComputeProgram program("#version 430 core\n#define TYNDALL_CURVES_IMAGE 1\n#define TYNDALL_CURVE_NODES " +
                               std::to_string(curves.nodes) + "\n#define TYNDALL_CURVE_PACKED " +
                               (curves.packed ? "1\n" : "0\n") + tyndall::avsmInsertSource() + kInsert);
  const host::GlBuffer buffer = host::makeBuffer();
  fillBuffer(buffer, kInput, inputs.size() * sizeof(Input), inputs.data());
  gl().BindImageTexture(1, curves.texture, 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32UI);
  program.run(1);
  gl().MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  gl().BindImageTexture(1, 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
  unbind();
}

void AvsmRig::capture(const std::vector<Captured>& segments) {
  captureInto(*avsm_, segments);
  const tyndall::Status resolved = avsm_->resolve();
  INFO(resolved.message);
  REQUIRE(resolved);
  gl().Finish(); // so that the next begin() knows of this frame
}

std::vector<std::uint32_t> AvsmRig::bits() const {
  const tyndall::AvsmCurves curves = avsm_->curves();
  REQUIRE(curves.texture != 0);
  const int layers = config_.layers * config_.nodes / (config_.packed ? 4 : 2);
  const auto size = static_cast<std::size_t>(config_.size);
  std::vector<std::uint32_t> bits(4 * size * size * static_cast<std::size_t>(layers));
  gl().BindTexture(GL_TEXTURE_2D_ARRAY, curves.texture);
  gl().GetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits.data());
  return bits;
}

reference::CurveMap AvsmRig::map() const {
  const std::size_t perTexel = config_.packed ? 4 : 2, layers = static_cast<std::size_t>(config_.nodes) / perTexel;
  const auto size = static_cast<std::size_t>(config_.size), texels = size * size;
  const std::vector<std::uint32_t> all = bits();
  reference::CurveMap map{config_.size, std::vector<Curve>(texels * static_cast<std::size_t>(config_.layers))};
  for (std::size_t i = 0; i < all.size() / 4; ++i) {
    const glm::uvec4 node(all[4 * i], all[4 * i + 1], all[4 * i + 2], all[4 * i + 3]);
    Curve& curve = map.curves[i / (texels * layers) * texels + i % texels];
    if (config_.packed) {
      for (int k = 0; k < 4; ++k)
        curve.emplace_back((node[k] >> 16) / 65535.0, (node[k] & 0xFFFFU) / 65535.0);
    } else {
      const glm::dvec4 values(glm::uintBitsToFloat(node));
      curve.emplace_back(values.x, values.y);
      curve.emplace_back(values.z, values.w);
    }
  }
  return map;
}

Curve AvsmRig::curve(const glm::ivec3& texel) const {
  const int index = (texel.z * config_.size + texel.y) * config_.size + texel.x;
  return map().curves[static_cast<std::size_t>(index)];
}

std::vector<float> AvsmRig::run(const std::string& expression, const std::vector<glm::vec4>& inputs,
                                bool exponential) const {
  const tyndall::AvsmCurves curves = avsm_->curves();
  REQUIRE(curves.texture != 0);
  const ComputeProgram program("#version 430 core\n#define TYNDALL_CURVE_NODES " + std::to_string(curves.nodes) +
                               "\n#define TYNDALL_CURVE_PACKED " + (curves.packed ? "1" : "0") +
                               "\n#define TYNDALL_CURVE_EXPONENTIAL " + (exponential ? "1\n" : "0\n") +
                               tyndall::avsmLookupSource() + R"(
layout(local_size_x = 64) in;
layout(binding = 0) uniform usampler2DArray curves;
layout(std430, binding = 6) readonly buffer Input { vec4 inputs[]; };
layout(std430, binding = 7) writeonly buffer Output { float results[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(inputs.length())) return;
  vec4 v = inputs[i];
  results[i] = )" + expression +
                               ";\n}\n");
  gl().ActiveTexture(GL_TEXTURE0);
  gl().BindTexture(GL_TEXTURE_2D_ARRAY, curves.texture);
  const host::GlBuffer input = host::makeBuffer(), output = host::makeBuffer();
  std::vector<float> results(inputs.size());
  fillBuffer(input, kInput, inputs.size() * sizeof(glm::vec4), inputs.data());
  fillBuffer(output, kOutput, results.size() * sizeof(float), nullptr);
  program.run(inputs.size());
  gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, output.name());
  gl().GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(results.size() * sizeof(float)),
                        results.data());
  unbind();
  return results;
}

std::vector<float> AvsmRig::lookUp(const std::vector<glm::ivec3>& texels, const std::vector<float>& depths,
                                   bool exponential) const {
  std::vector<glm::vec4> inputs;
  for (std::size_t i = 0; i < depths.size(); ++i)
    inputs.emplace_back(glm::vec3(texels[i]), depths[i]);
  return run("tyndallTransmittance(curves, ivec3(v.xyz), v.w)", inputs, exponential);
}

std::vector<float> AvsmRig::lookUpBilinear(const std::vector<glm::vec2>& places, int layer,
                                           const std::vector<float>& depths) const {
  std::vector<glm::vec4> inputs;
  for (std::size_t i = 0; i < depths.size(); ++i)
    inputs.emplace_back(places[i], layer, depths[i]);
  return run("tyndallTransmittanceBilinear(curves, v.xy, int(v.z), v.w)", inputs, false);
}

} // namespace tests
