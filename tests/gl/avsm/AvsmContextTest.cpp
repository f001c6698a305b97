// What Avsm::create() and the calls refuse, contexts that will not do, GL state and objects, and several side by side.
#include "AvsmRig.h"
#include "gl/effect/FakeContext.h"
#include "gl/effect/GlState.h"
#include "support/Catch.h"

#include <functional>
#include <utility>

using namespace tyndall;
using host::gl;
using tests::address;
using tests::AvsmRig;
using tests::Captured;
using tests::FakeContext;

namespace {

AvsmConfig smallConfig(GlLoader loader) {
  AvsmConfig config;
  config.loader = loader;
  config.size = 4;
  return config;
}

void checkRefused(const Status& status, StatusCode code, const std::vector<std::string>& words) {
  INFO(status.message);
  CHECK(status.code == code);
  for (const std::string& word : words) {
    CAPTURE(word);
    CHECK(status.message.find(word) != std::string::npos);
  }
  CHECK(status.message.find('\n') == std::string::npos);
}

void checkRefused(const AvsmConfig& config, StatusCode code, const std::vector<std::string>& words) {
  const AvsmResult result = Avsm::create(config);
  CHECK_FALSE(result.avsm);
  checkRefused(result.status, code, words);
}

const std::vector<Captured> kSmoke = {{{1, 1, 0}, 0.25F, 0.5F, 0.5F}, {{2, 1, 0}, 0.5F, 0.75F, 0.25F}};

void GLAD_API_PTR sayVersion42(GLenum name, GLint* value) {
  gl().GetIntegerv(name, value);
  if (name == GL_MAJOR_VERSION) *value = 4;
  if (name == GL_MINOR_VERSION) *value = 2;
}
const GLubyte* GLAD_API_PTR sayDesktop42(GLenum) { return reinterpret_cast<const GLubyte*>("4.2 Old Driver"); }
void GLAD_API_PTR saySmallStorage(GLenum name, GLint* value) {
  gl().GetIntegerv(name, value);
  if (name == GL_MAX_SHADER_STORAGE_BLOCK_SIZE) *value = 1 << 20;
}
void GLAD_API_PTR sayFewLayers(GLenum name, GLint* value) {
  gl().GetIntegerv(name, value);
  if (name == GL_MAX_ARRAY_TEXTURE_LAYERS) *value = 5;
  if (name == GL_MAX_TEXTURE_SIZE) *value = 512;
}
bool failing = false;

// Memory that has run out, behind GL's one error flag.
GLenum flag = GL_NO_ERROR;
void runOut() {
  if (flag == GL_NO_ERROR) flag = GL_OUT_OF_MEMORY;
}
GLenum GLAD_API_PTR askFlag() { return flag != GL_NO_ERROR ? std::exchange(flag, GL_NO_ERROR) : gl().GetError(); }
void GLAD_API_PTR storeNothing(GLenum, GLsizei, GLenum, GLsizei, GLsizei, GLsizei) { runOut(); }
void GLAD_API_PTR allocate(GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
  failing ? runOut() : gl().BufferData(target, size, data, usage);
}
GLboolean GLAD_API_PTR isArray(GLuint name) { return failing ? GL_FALSE : gl().IsVertexArray(name); }
GLenum GLAD_API_PTR errorOfLostContext() { return failing ? GL_CONTEXT_LOST : gl().GetError(); }
GLenum GLAD_API_PTR refuseFramebuffer(GLenum) { return GL_FRAMEBUFFER_UNSUPPORTED; }
void GLAD_API_PTR refuseShaders(GLuint shader, GLenum name, GLint* value) {
  gl().GetShaderiv(shader, name, value);
  if (name == GL_COMPILE_STATUS) *value = GL_FALSE;
}

} // namespace

TEST_CASE("avsm: a context below 4.3 is refused, and said so") {
  const GlLoader loader = tests::testContext().loader();
  if (tests::testContext().glVersion() < 43) {
    checkRefused(smallConfig(loader), StatusCode::ContextTooOld,
                 {"the context is \"", "OpenGL 4.3 core or later is needed for an adaptive volumetric shadow map"});
    return;
  }
  CHECK(Avsm::create(smallConfig(loader)).avsm);
  const FakeContext fake({}, {{"glGetIntegerv", address(sayVersion42)}, {"glGetString", address(sayDesktop42)}});
  checkRefused(smallConfig(fake.loader()), StatusCode::ContextTooOld, {"4.2 Old Driver", "OpenGL 4.3"});
}

TEST_CASE("avsm: every field of a config that breaks its rule is named") {
  if (!tests::hasAvsm()) return;
  const auto check = [](const std::string& field, const std::string& value, const std::string& rule,
                        const std::function<void(AvsmConfig&)>& change) {
    AvsmConfig config = smallConfig(tests::testContext().loader());
    change(config);
    CAPTURE(field);
    checkRefused(config, StatusCode::InvalidConfig, {"AvsmConfig::" + field + " is " + value, rule});
  };
  check("loader", "null", "must resolve", [](AvsmConfig& c) { c.loader = nullptr; });
  for (const int timing : {-1, 3})
    check("timing", std::to_string(timing), "enumerators",
          [&](AvsmConfig& c) { c.timing = static_cast<PassTiming>(timing); });
  for (const int size : {INT32_MIN, 0, 4097})
    check("size", std::to_string(size), "must be 1 to 4096", [&](AvsmConfig& c) { c.size = size; });
  for (const int layers : {-1, 0, 7})
    check("layers", std::to_string(layers), "must be 1 to 6", [&](AvsmConfig& c) { c.layers = layers; });
  for (const int nodes : {-4, 0, 5, 6, 20})
    check("nodes", std::to_string(nodes), "must be 4, 8, 12 or 16", [&](AvsmConfig& c) { c.nodes = nodes; });
  for (const int reduction : {-1, 4})
    check("reduction", std::to_string(reduction), "enumerators",
          [&](AvsmConfig& c) { c.reduction = static_cast<CurveReduction>(reduction); });
  for (const int state : {-1, 2})
    check("state", std::to_string(state), "enumerators",
          [&](AvsmConfig& c) { c.state = static_cast<StateMode>(state); });
}

TEST_CASE("avsm: a map that is too large for the context is refused") {
  if (!tests::hasAvsm()) return;
  {
    const FakeContext fake({}, {{"glGetIntegerv", address(saySmallStorage)}});
    AvsmConfig config = smallConfig(fake.loader());
    config.size = 256;
    checkRefused(config, StatusCode::InvalidConfig, {"size is 256", "this context has 1048576"});
    config.size = 255;
    CHECK(Avsm::create(config).avsm);
  }
  const FakeContext fake({}, {{"glGetIntegerv", address(sayFewLayers)}});
  AvsmConfig config = smallConfig(fake.loader());
  config.nodes = 16;
  config.layers = 2;
  checkRefused(config, StatusCode::InvalidConfig, {"layers is 2", "has 5 layers"});
  config.layers = 1;
  config.size = 513;
  checkRefused(config, StatusCode::InvalidConfig, {"size is 513", "512 texels"});
  config.size = 512;
  CHECK(Avsm::create(config).avsm);
}

TEST_CASE("avsm: a function that the loader does not know is named") {
  if (!tests::hasAvsm()) return;
  for (const char* name : {"glDispatchCompute", "glMemoryBarrier", "glBindImageTexture", "glTexStorage3D",
                           "glBufferSubData", "glClearBufferSubData", "glCopyBufferSubData", "glFenceSync",
                           "glClientWaitSync", "glDeleteSync", "glGenBuffers", "glBindBufferBase", "glGetIntegerv"}) {
    const FakeContext fake({name});
    checkRefused(smallConfig(fake.loader()), StatusCode::ContextTooOld, {std::string("the loader knows no ") + name});
  }
}

TEST_CASE("avsm: no current context is refused") {
  if (!tests::hasAvsm()) return;
  AvsmRig rig;
  host::Context& context = tests::testContext();
  context.releaseCurrent();
  checkRefused(smallConfig(context.loader()), StatusCode::NoContext, {"no GL context"});
  checkRefused(rig.avsm().begin(), StatusCode::NoContext, {"no GL context"});
  checkRefused(rig.avsm().resolve(), StatusCode::NoContext, {"no GL context"});
  context.makeCurrent();
}

TEST_CASE("avsm: calls out of order, and bindings that the context lacks") {
  if (!tests::hasAvsm()) return;
  AvsmConfig config;
  config.size = 4;
  AvsmRig rig(config);
  checkRefused(rig.avsm().resolve(), StatusCode::InvalidFrame, {"resolve", "begin()"});
  GLint bindings = 0;
  gl().GetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &bindings);
  for (const std::uint32_t binding : {static_cast<std::uint32_t>(bindings) - 1, UINT32_MAX})
    checkRefused(rig.avsm().begin(binding), StatusCode::InvalidConfig,
                 {"firstBinding is " + std::to_string(binding), std::to_string(bindings)});
  CHECK(rig.avsm().begin(static_cast<std::uint32_t>(bindings) - 2));
  CHECK(rig.avsm().resolve());
  checkRefused(rig.avsm().resolve(), StatusCode::InvalidFrame, {"begin()"});
  rig.capture(kSmoke);
  CHECK(rig.curve({1, 1, 0}).back().y == Approx(0.5).margin(1e-4));
  // A second begin() empties again.
  tests::captureInto(rig.avsm(), kSmoke);
  CHECK(rig.avsm().begin());
  CHECK(rig.avsm().resolve());
  CHECK(rig.avsm().statistics().segments == 0);
  // A begin() that fails leaves the last curves, and nothing to resolve.
  rig.capture(kSmoke);
  const std::vector<std::uint32_t> bits = rig.bits();
  CHECK_FALSE(rig.avsm().begin(UINT32_MAX));
  CHECK(rig.bits() == bits);
}

TEST_CASE("avsm: a lost context is never Ok, and stays lost") {
  if (!tests::hasAvsm()) return;
  const auto checkLost = [](const Status& status) { checkRefused(status, StatusCode::ContextLost, {"lost"}); };
  const FakeContext fake({}, {{"glGetError", address(errorOfLostContext)}, {"glIsVertexArray", address(isArray)}});
  failing = true;
  checkLost(Avsm::create(smallConfig(fake.loader())).status);
  const Light light;
  const std::vector<std::function<Status(Avsm&)>> calls = {
      [](Avsm& a) { return a.begin(); }, [](Avsm& a) { return a.beginStreaming(); },
      [](Avsm& a) { return a.bindCurves(0); }, [&](Avsm& a) { return a.drawParticles(light, {}); },
      [](Avsm& a) { return a.resolve(); }};
  for (const auto& call : calls) {
    failing = false;
    const AvsmResult result = Avsm::create(smallConfig(fake.loader()));
    REQUIRE(result.avsm);
    CHECK(result.avsm->beginStreaming());
    failing = true;
    checkLost(call(*result.avsm));
    failing = false;
    for (const auto& later : calls)
      checkLost(later(*result.avsm));
  }
}

TEST_CASE("avsm: calls that use programs are refused during transform feedback") {
  if (!tests::hasAvsm()) return;
  const FakeContext fake({}, {{"glGetIntegerv", address(+[](GLenum name, GLint* value) {
                                 gl().GetIntegerv(name, value);
                                 if (name == GL_TRANSFORM_FEEDBACK_ACTIVE) *value = failing ? 1 : 0;
                               })}});
  failing = false;
  const AvsmResult result = Avsm::create(smallConfig(fake.loader()));
  REQUIRE(result.avsm);
  CHECK(result.avsm->beginStreaming());
  failing = true;
  for (const Status& status :
       {result.avsm->beginStreaming(), result.avsm->drawParticles({}, {}), result.avsm->resolve()})
    checkRefused(status, StatusCode::InvalidFrame, {"transform feedback is active"});
  failing = false;
  CHECK(result.avsm->resolve());
}

TEST_CASE("avsm: running out of memory, and shaders that do not build, are reported") {
  if (!tests::hasAvsm()) return;
  {
    const FakeContext fake({}, {{"glGetError", address(askFlag)}, {"glTexStorage3D", address(storeNothing)}});
    for (const GLenum engines : {GL_NO_ERROR, GL_INVALID_VALUE}) {
      flag = engines;
      checkRefused(smallConfig(fake.loader()), StatusCode::OutOfMemory, {"bytes for curves"});
      CHECK(askFlag() == engines);
      CHECK(askFlag() == GL_NO_ERROR);
    }
    tests::testContext().takeErrors();
  }
  {
    const FakeContext fake({}, {{"glGetError", address(askFlag)}, {"glBufferData", address(allocate)}});
    failing = false;
    const AvsmResult result = Avsm::create(smallConfig(fake.loader()));
    REQUIRE(result.avsm);
    failing = true;
    checkRefused(result.avsm->begin(), StatusCode::OutOfMemory, {"bytes for captured segments"});
    checkRefused(result.avsm->resolve(), StatusCode::InvalidFrame, {"begin()"});
    CHECK(result.avsm->statistics().listBytes == 0);
    failing = false;
    tests::captureInto(*result.avsm, kSmoke);
    CHECK(result.avsm->resolve());
    CHECK(result.avsm->statistics().segments == kSmoke.size());
  }
  const FakeContext fake({}, {{"glGetShaderiv", address(refuseShaders)}});
  const AvsmResult result = Avsm::create(smallConfig(fake.loader()));
  REQUIRE(result.avsm);
  tests::captureInto(*result.avsm, kSmoke);
  const Status status = result.avsm->resolve();
  CHECK(status.code == StatusCode::ShaderError);
  CHECK(status.message.find("avsm") != std::string::npos);
  CHECK(result.avsm->curves().texture == 0);
}

TEST_CASE("avsm: a call that is refused leaves curves, lists and state as they were") {
  if (!tests::hasAvsm()) return;
  const FakeContext fake({}, {{"glGetShaderiv", address(+[](GLuint shader, GLenum name, GLint* value) {
                                 gl().GetShaderiv(shader, name, value);
                                 if (failing && name == GL_COMPILE_STATUS) *value = GL_FALSE;
                               })},
                              {"glCheckFramebufferStatus", address(refuseFramebuffer)},
                              {"glGetError", address(askFlag)},
                              {"glBufferData", address(allocate)}});
  failing = false;
  AvsmConfig config = smallConfig(fake.loader());
  const AvsmResult result = Avsm::create(config);
  REQUIRE(result.avsm);
  Avsm& avsm = *result.avsm;
  const auto checkNothing = [&](StatusCode code, const std::function<Status()>& call) {
    const AvsmCurves before = avsm.curves();
    const std::uint64_t bytes = avsm.statistics().listBytes;
    const tests::Poison poison;
    const tests::GlState state = tests::captureGlState();
    const Status status = call();
    const tests::GlState after = tests::captureGlState();
    tests::Poison::lift();
    INFO(status.message);
    CHECK(status.code == code);
    CHECK(avsm.curves().texture == before.texture);
    CHECK(avsm.curves().version == before.version);
    CHECK(avsm.statistics().listBytes == bytes);
    for (const auto& [name, values] : state) {
      CAPTURE(name);
      CHECK(after.at(name) == values);
    }
  };
  failing = true;
  checkNothing(StatusCode::ShaderError, [&] { return avsm.beginStreaming(); });
  checkNothing(StatusCode::OutOfMemory, [&] { return avsm.begin(); });
  failing = false;
  tests::captureInto(avsm, kSmoke);
  failing = true;
  checkNothing(StatusCode::ShaderError, [&] { return avsm.resolve(); });
  failing = false;
  CHECK(avsm.resolve()); // what was captured is there still
  CHECK(avsm.statistics().segments == kSmoke.size());
  checkNothing(StatusCode::InvalidFrame, [&] { return avsm.resolve(); });
  CHECK(avsm.beginStreaming());
  checkNothing(StatusCode::InvalidFrame, [&] { return avsm.bindCurves(0); });
  checkNothing(StatusCode::InvalidFrame, [&] { return avsm.drawParticles({}, {}); });
}

TEST_CASE("avsm: errors that the engine has not asked for are its own still") {
  if (!tests::hasAvsm()) return;
  const auto checkPending = [](const std::function<Status()>& call) {
    gl().Enable(GL_TEXTURE_2D_ARRAY);
    tests::testContext().takeErrors();
    gl().Enable(GL_TEXTURE_2D_ARRAY);
    const Status status = call();
    INFO(status.message);
    CHECK(status);
    CHECK(gl().GetError() == GL_INVALID_ENUM);
    CHECK(gl().GetError() == GL_NO_ERROR);
    CHECK(tests::testContext().takeErrors().size() <= 1); // the engine's own message
  };
  AvsmResult result;
  checkPending([&] {
    result = Avsm::create(smallConfig(tests::testContext().loader()));
    return result.status;
  });
  REQUIRE(result.avsm);
  for (int frame = 0; frame < 2; ++frame) {
    checkPending([&] { return result.avsm->begin(); });
    checkPending([&] { return result.avsm->resolve(); });
    checkPending([&] { return result.avsm->beginStreaming(); });
    checkPending([&] { return result.avsm->bindCurves(0); });
    checkPending([&] { return result.avsm->resolve(); });
    gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  }
}

TEST_CASE("avsm: with StateMode::Leave storage bindings are left empty, and the curves are the same") {
  if (!tests::hasAvsm()) return;
  AvsmConfig config = smallConfig(tests::testContext().loader());
  AvsmRig rig(config);
  rig.capture(kSmoke);
  config.state = StateMode::Leave;
  AvsmRig leaving(config);
  tests::captureInto(leaving.avsm(), kSmoke);
  const tests::Poison poison;
  const tests::GlState before = tests::captureGlState();
  CHECK(leaving.avsm().resolve());
  const tests::GlState after = tests::captureGlState();
  tests::Poison::lift();
  CHECK(leaving.bits() == rig.bits());
  CHECK(before.at("program") != std::vector<double>{0});
  for (const auto& [name, values] : after) {
    CAPTURE(name);
    const bool storage = name.find("storage binding") == 0,
               image = name.find("image " + std::to_string(GL_IMAGE_BINDING_NAME)) == 0;
    const bool ours = name.find("[0]") != std::string::npos ||
                      (storage && (name.find("[1]") != std::string::npos || name.find("[2]") != std::string::npos));
    if ((storage || image) && ours) CHECK(values == std::vector<double>{0});
    if ((storage || image) && !ours) CHECK(values == before.at(name));
    if (name == "program" || name == "shader storage buffer") CHECK(values == std::vector<double>{0});
    if (name.find("viewport") == 0) CHECK(values == before.at(name));
  }
}

TEST_CASE("avsm: a poisoned GL state is on return what it was on entry") {
  if (!tests::hasAvsm()) return;
  const GlLoader loader = tests::testContext().loader();
  for (const CurveReduction reduction : {CurveReduction::Fitted, CurveReduction::WholeCurve})
    for (const PassTiming timing : {PassTiming::Off, PassTiming::TimerQuery}) {
      AvsmConfig config = smallConfig(loader);
      config.reduction = reduction;
      config.timing = timing;
      std::vector<std::pair<std::string, tests::GlState>> states;
      std::vector<Status> status;
      AvsmResult result;
      {
        const tests::Poison poison;
        const auto step = [&](const std::string& name, const Status& s) {
          states.emplace_back(name, tests::captureGlState());
          status.push_back(s);
        };
        step("entry", {});
        result = Avsm::create(config);
        step("create", result.status);
        step("begin", result.avsm->begin(6));
        step("resolve, empty", result.avsm->resolve());
        step("begin again", result.avsm->begin(6));
        tests::Poison::lift();
      }
      tests::captureInto(*result.avsm, kSmoke);
      {
        const tests::Poison poison;
        const auto step = [&](const std::string& name, const Status& s) {
          states.emplace_back(name, tests::captureGlState());
          status.push_back(s);
        };
        step("entry with smoke", {});
        step("resolve", result.avsm->resolve());
        CHECK(result.avsm->statistics().segments == kSmoke.size());
        step("statistics", {});
        tests::Poison::lift();
      }
      for (std::size_t i = 1; i < states.size(); ++i) {
        CAPTURE(states[i].first);
        CHECK(status[i]);
        if (states[i].first == "entry with smoke") continue;
        for (const auto& [name, values] : states[i - 1].second) {
          // begin() leaves its two buffers bound.
          const bool own = states[i].first == "begin" && (name.find("storage binding") == 0) &&
                           (name.find("[6]") != std::string::npos || name.find("[7]") != std::string::npos);
          CAPTURE(name);
          if (own) continue;
          CHECK(states[i].second.at(name) == values);
        }
      }
    }
}

TEST_CASE("avsm: a poisoned GL state gives the same curves") {
  if (!tests::hasAvsm()) return;
  AvsmConfig config = smallConfig(nullptr);
  AvsmRig rig(config), poisoned(config);
  rig.capture(kSmoke);
  tests::captureInto(poisoned.avsm(), kSmoke);
  {
    const tests::Poison poison;
    CHECK(poisoned.avsm().resolve());
    tests::Poison::lift();
  }
  CHECK(poisoned.bits() == rig.bits());
}

TEST_CASE("avsm: several side by side do not disturb each other") {
  if (!tests::hasAvsm()) return;
  AvsmConfig config = smallConfig(nullptr);
  AvsmRig first(config), second(config);
  const std::vector<Captured> other = {{{3, 0, 0}, 0.125F, 0.25F, 0.75F}};
  tests::captureInto(first.avsm(), kSmoke);
  tests::captureInto(second.avsm(), other);
  CHECK(second.avsm().resolve());
  CHECK(first.avsm().resolve());
  CHECK(first.avsm().statistics().segments == 2);
  CHECK(second.avsm().statistics().segments == 1);
  CHECK(first.curve({1, 1, 0}).back().y == Approx(0.5).margin(1e-4));
  CHECK(first.curve({3, 0, 0}).back().y == 1);
  CHECK(second.curve({3, 0, 0}).back().y == Approx(0.75).margin(1e-4));
  CHECK(second.curve({1, 1, 0}).back().y == 1);
}

TEST_CASE("avsm: no GL object is left behind") {
  if (!tests::hasAvsm()) return;
  const std::vector<int> before = tests::liveGlObjects();
  for (const CurveReduction reduction : {CurveReduction::WholeCurve, CurveReduction::Sorted}) {
    AvsmConfig config = smallConfig(nullptr);
    config.timing = PassTiming::TimerQuery;
    config.reduction = reduction;
    AvsmRig rig(config);
    rig.capture(kSmoke);
    rig.capture(kSmoke);
    CHECK(rig.avsm().statistics().curveBytes > 0);
    config.loader = tests::testContext().loader();
    config.nodes = 5;
    CHECK_FALSE(Avsm::create(config).avsm);
    CHECK(tests::liveGlObjects() != before);
  }
  CHECK(tests::liveGlObjects() == before);
}
