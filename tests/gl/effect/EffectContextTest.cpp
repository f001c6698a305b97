// Contexts and loaders: what create() refuses, effects side by side, the wrong context, and what a driver's failure
// does.
#include "FakeContext.h"
#include "GlState.h"
#include "SceneRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <thread>

using namespace tyndall;
using tests::address;
using tests::FakeContext;

namespace {

void GLAD_API_PTR sayVersion31(GLenum name, GLint* value) {
  host::gl().GetIntegerv(name, value);
  if (name == GL_MAJOR_VERSION) *value = 3;
  if (name == GL_MINOR_VERSION) *value = 1;
}
void GLAD_API_PTR sayVersion32(GLenum name, GLint* value) {
  if (name == GL_MAJOR_VERSION)
    *value = 3;
  else if (name == GL_MINOR_VERSION)
    *value = 2;
  else
    host::gl().GetIntegerv(name, value);
}
const GLubyte* GLAD_API_PTR sayDesktop32(GLenum) { return reinterpret_cast<const GLubyte*>("3.2 Old Driver"); }
const GLubyte* GLAD_API_PTR sayEs31(GLenum) { return reinterpret_cast<const GLubyte*>("OpenGL ES 3.1 Phone"); }

void requireStatus(const CreateResult& result, StatusCode code, const std::string& word) {
  INFO(result.status.message);
  CHECK(result.status.code == code);
  CHECK_FALSE(result.effect);
  CHECK(result.status.message.find(word) != std::string::npos);
  CHECK(result.status.message.find('\n') == std::string::npos);
}

// A context with a scene and an effect of its own.
struct World {
  std::unique_ptr<host::Context> context;
  std::unique_ptr<tests::SceneRig> scene;
  std::unique_ptr<Effect> effect;

  explicit World(host::ContextKind kind) : context(host::Context::create(kind, tests::testContextOptions())) {
    scene = std::make_unique<tests::SceneRig>(24, 16, tests::RigContext::Current);
    scene->addLight(LightKind::Directional, tests::Casters::Blocks, true);
    scene->addLight(LightKind::Point);
    scene->addLight(LightKind::Spot);
    effect = tests::newEffect({context->loader()});
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    context->makeCurrent();
    effect.reset();
    scene.reset();
    CHECK(context->takeErrors().empty());
  }
  reference::ImageAnswer render() {
    context->makeCurrent();
    return scene->render(*effect);
  }
};

host::ContextKind otherKind() {
  return tests::testContextKind() == host::ContextKind::Osmesa ? host::ContextKind::Egl : host::ContextKind::Osmesa;
}

} // namespace

TEST_CASE("a loader returns addresses or functions: those of GLFW, EGL and SDL are taken as they are") {
  static GlLoader real;
  real = tests::testContext().loader();
  CHECK(Effect::create({[](const char* name) { return real(name); }}).effect);
  CHECK(Effect::create({[](const char* name) { return reinterpret_cast<void (*)()>(real(name)); }}).effect);
  void (*(*const typed)(const char*))() = [](const char* name) { return reinterpret_cast<void (*)()>(real(name)); };
  CHECK(Effect::create({typed}).effect);
  CHECK_FALSE(GlLoader());
  CHECK_FALSE(GlLoader(nullptr));
}

TEST_CASE("create without a loader is refused") {
  requireStatus(Effect::create({}), StatusCode::InvalidConfig, "loader");
}

TEST_CASE("create with a timing that is no enumerator is refused") {
  const GlLoader loader = tests::testContext().loader();
  requireStatus(Effect::create({loader, static_cast<PassTiming>(7)}), StatusCode::InvalidConfig, "timing");
}

TEST_CASE("create with a state mode that is no enumerator is refused") {
  const GlLoader loader = tests::testContext().loader();
  requireStatus(Effect::create({loader, PassTiming::Off, {}, static_cast<StateMode>(2)}), StatusCode::InvalidConfig,
                "Config::state is 2");
}

TEST_CASE("create with a tuning that breaks a rule is refused") {
  const GlLoader loader = tests::testContext().loader();
  const Tuning tuning{Masking::Auto, static_cast<Masking>(3)};
  requireStatus(Effect::create({loader, PassTiming::Off, {}, StateMode::Restore, tuning}), StatusCode::InvalidConfig,
                "Config::tuning.fixup is 3");
}

TEST_CASE("create without a current context is refused") {
  host::Context& context = tests::testContext();
  const GlLoader loader = context.loader();
  context.releaseCurrent();
  requireStatus(Effect::create({loader, PassTiming::Off}), StatusCode::NoContext, "no GL context");
  requireStatus(Effect::create({[](const char*) -> void* { return nullptr; }, PassTiming::Off}), StatusCode::NoContext,
                "no GL context");
  context.makeCurrent();
}

// Functions that OpenGL 3.3 lacks, or that no frame needs.
const std::set<std::string> kLaterFunctions = {
    "glGetFloati_v", "glViewportIndexedf", "glScissorIndexed", "glBlendFuncSeparatei", "glBlendEquationSeparatei",
    "glActiveStencilFaceEXT", "glPushDebugGroup", "glPopDebugGroup", "glObjectLabel", "glGetProgramBinary",
    "glProgramBinary", "glProgramParameteri", "glClipControl", "glGetGraphicsResetStatus",
    "glGetGraphicsResetStatusARB",
    // of an AVSM alone
    "glDispatchCompute", "glMemoryBarrier", "glBindImageTexture", "glTexStorage3D", "glClearBufferSubData",
    // that save calls
    "glGetTextureParameteriv", "glBindTextures", "glBindSamplers"};

TEST_CASE("create needs no function beyond OpenGL 3.3") {
  const FakeContext fake(kLaterFunctions);
  const CreateResult result = fake.create();
  INFO(result.status.message);
  CHECK(result.effect);
}

TEST_CASE("create names the required function that the loader does not know") {
  std::set<std::string> names;
  {
    const FakeContext fake;
    REQUIRE(fake.create().effect);
    names = fake.askedFor();
  }
  REQUIRE(names.size() > 60);
  for (const std::string& name : names) {
    // Without glGetString there is no telling whether a context is current.
    if (name == "glGetString" || kLaterFunctions.count(name) != 0) continue;
    CAPTURE(name);
    const FakeContext fake({name});
    requireStatus(fake.create(), StatusCode::ContextTooOld, "no " + name);
  }
}

TEST_CASE("create refuses a context that is too old") {
  const FakeContext fake({}, {{"glGetIntegerv", address(sayVersion32)}, {"glGetString", address(sayDesktop32)}});
  requireStatus(fake.create(), StatusCode::ContextTooOld, "3.2 Old Driver");
}

TEST_CASE("create refuses an OpenGL ES that is too old") {
  const FakeContext fake({}, {{"glGetIntegerv", address(sayVersion31)}, {"glGetString", address(sayEs31)}});
  requireStatus(fake.create(), StatusCode::ContextTooOld, "OpenGL ES 3.1 Phone");
}

TEST_CASE("calls without a current context, or in another, are refused") {
  World world(tests::testContextKind());
  const reference::ImageAnswer before = world.render();
  const auto checkRefused = [&](const std::string& word) {
    for (const Status& status : {world.effect->render(world.scene->frame), world.effect->compileAll()}) {
      INFO(status.message);
      CHECK(status.code == StatusCode::NoContext);
      CHECK(status.message.find(word) != std::string::npos);
      CHECK(status.message.find('\n') == std::string::npos);
    }
  };
  world.context->releaseCurrent();
  checkRefused("no GL context");
  {
    const std::unique_ptr<host::Context> empty =
        host::Context::create(tests::testContextKind(), tests::testContextOptions());
    checkRefused("another GL context");
    CHECK(empty->takeErrors().empty());
  }
  {
    const World other(tests::testContextKind()); // made alike, so that its objects have the same names
    checkRefused("another GL context");
  }
  CHECK(world.render().inscatter == before.inscatter);
}

TEST_CASE("two effects in one context draw the same") {
  tests::SceneRig scene;
  scene.addLight(LightKind::Spot, tests::Casters::Blocks, true);
  const reference::ImageAnswer expected = scene.render();
  std::unique_ptr<Effect> first = tests::newEffect();
  std::unique_ptr<Effect> second = tests::newEffect();
  for (int frame = 0; frame < 3; ++frame)
    for (Effect* effect : {first.get(), second.get(), &tests::testEffect()})
      CHECK(scene.render(*effect).inscatter == expected.inscatter);
  first.reset();
  CHECK(scene.render(*second).inscatter == expected.inscatter);
}

TEST_CASE("effects in two contexts draw the same, frame by frame in turn") {
  World first(tests::testContextKind());
  World second(tests::testContextKind());
  const reference::ImageAnswer expected = first.render();
  CHECK(expected.inscatter.rgb != std::vector<double>(expected.inscatter.rgb.size(), 0));
  for (int frame = 0; frame < 3; ++frame)
    for (World* world : {&second, &first}) {
      const reference::ImageAnswer answer = world->render();
      CHECK(answer.inscatter == expected.inscatter);
      CHECK(answer.transmittance == expected.transmittance);
    }
}

TEST_CASE("effects in two threads, each with a context of its own, draw at once what one draws alone") {
  World first(tests::testContextKind());
  const reference::ImageAnswer expected = first.render();
  first.context->releaseCurrent();
  World second(tests::testContextKind());
  second.context->releaseCurrent();
  struct Outcome {
    bool ok = true, same = true;
  };
  std::array<Outcome, 2> outcomes;
  const auto run = [&](World& world, Outcome& outcome) { // assertions are the main thread's
    world.context->makeCurrent();
    for (int frame = 0; frame < 8; ++frame) {
      outcome.ok = static_cast<bool>(world.effect->render(world.scene->frame)) && outcome.ok;
      outcome.same = world.scene->outputs().inscatter == expected.inscatter && outcome.same;
    }
    world.context->releaseCurrent();
  };
  std::thread other([&] { run(second, outcomes[1]); });
  run(first, outcomes[0]);
  other.join();
  for (const Outcome& outcome : outcomes) {
    CHECK(outcome.ok);
    CHECK(outcome.same);
  }
}

TEST_CASE("OSMesa and EGL draw the same picture") {
  if (!host::isOsmesaInstalled()) {
    WARN("skipped: libOSMesa is not installed");
    return;
  }
  World here(tests::testContextKind());
  World other(otherKind());
  for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
    here.scene->frame.settings.shadowFilter = other.scene->frame.settings.shadowFilter = filter;
    const reference::ImageAnswer a = here.render(), b = other.render();
    CHECK(tests::difference(a.inscatter, b.inscatter) <= 1e-5);
    CHECK(tests::difference(a.transmittance, b.transmittance) <= 1e-5);
  }
}

TEST_CASE("an effect leaves no GL object behind") {
  tests::SceneRig scene;
  scene.addLight(LightKind::Directional);
  const host::GlTexture colour = scene.makeColour(GL_RGBA16F, std::vector<float>(4 * 24 * 16, 1.0F));
  const std::vector<int> before = tests::liveGlObjects();
  for (int i = 0; i < 3; ++i) {
    const std::unique_ptr<Effect> effect = tests::newEffect({tests::testContext().loader(), PassTiming::TimerQuery});
    Frame frame = scene.frame;
    frame.output.transmittance = 0; // so that a target of the effect's own is needed
    CHECK(effect->render(frame));
    CHECK(effect->statistics().bytes >= 16 * 24 * 16);
    frame.viewport.width = 0;
    CHECK_FALSE(effect->render(frame));
  }
  {
    const FakeContext fake({"glQueryCounter"});
    CHECK_FALSE(fake.create().effect);
  }
  CHECK(tests::liveGlObjects() == before);
}

namespace {

void GLAD_API_PTR drawNothing(GLenum, GLint, GLsizei) {}

// Calls `render` with a frame for every combination that selects a shader.
void forEveryVariant(tests::SceneRig& scene, const std::function<void(const Frame&)>& render) {
  const GLuint depth = scene.frame.depth.texture;
  const host::GlTexture samples = host::makeTexture2DMultisample(GL_DEPTH_COMPONENT24, 2, 2, 4);
  const Output outputs = scene.frame.output;
  const std::size_t lights = scene.frame.lights.size();
  for (int bits = 0; bits < 16; ++bits) {
    Frame frame = scene.frame;
    frame.depth = (bits & 1) != 0 ? SceneDepth{samples.name(), true, 0} : SceneDepth{depth, false, 0};
    frame.output = (bits & 2) != 0 ? outputs : Output{};
    frame.medium.absorption[2] = (bits & 4) != 0 ? 0.25F : 0.5F;
    frame.settings.shadowFilter = (bits & 8) != 0 ? ShadowFilter::Bilinear : ShadowFilter::Nearest;
    for (std::size_t i = 0; i <= lights; ++i) {
      frame.lights.clear();
      if (i < lights) frame.lights = {scene.frame.lights[i]};
      render(frame);
    }
  }
}

} // namespace

TEST_CASE("every shader variant compiles, and no frame needs another", "[once][slow]") {
  const FakeContext fake({}, {{"glDrawArrays", address(drawNothing)}}); // a draw makes some drivers compile once more
  const CreateResult result = fake.create();
  REQUIRE(result.effect);
  Effect& effect = *result.effect;
  CHECK(effect.statistics().compiledPrograms == 0);
  const Status status = effect.compileAll();
  INFO(status.message);
  REQUIRE(status);
  const int count = effect.statistics().compiledPrograms;
  CAPTURE(count);

  tests::SceneRig scene(2, 2);
  const host::GlTexture colour = scene.makeColour(GL_RGBA16F, std::vector<float>(16, 1.0F));
  scene.frame.medium.constituents = {{{0.5F, 0.5F, 0.5F}, Phase::Isotropic, 0}};
  scene.frame.medium.absorption = {0.5F, 0.5F, 0.5F};
  const reference::ShadowImage plain{2, 2, 1, std::vector<float>(4, 0.5F), {}, {}};
  const reference::ShadowImage glazed{2, 2, 1, plain.depth, std::vector<float>(12, 0.5F), plain.depth};
  std::vector<tests::ShadowRig> maps(24);
  std::size_t used = 0;
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot}) {
    scene.addLight(kind, tests::Casters::None);
    for (int bits = 0; bits < 8; ++bits) {
      const int views = (bits & 1) != 0 ? 2 : 1;
      if (views > 1 && (kind == LightKind::Spot || (bits & 4) == 0)) continue; // several views need an array
      Light light = scene.addLight(kind, tests::Casters::None);
      light.shadow.views.assign(static_cast<std::size_t>(views), tests::shadowViewsOf(light)[0]);
      maps[used].image = (bits & 2) != 0 ? glazed : plain;
      maps[used++].upload(light, (bits & 4) != 0);
      scene.frame.lights.back() = light;
    }
  }
  forEveryVariant(scene, [&](const Frame& frame) {
    const Status drawn = effect.render(frame);
    INFO(drawn.message);
    if (drawn.code != StatusCode::InvalidFrame) CHECK(drawn);
  });
  CHECK(effect.statistics().compiledPrograms == count);

  for (const Changes changes : {Changes::Detect, Changes::Objects})
    for (const DebugView view : {DebugView::Composite, DebugView::Redrawn}) {
      std::uint64_t number = 0;
      forEveryVariant(scene, [&](Frame frame) {
        frame.settings.technique = Technique::Epipolar;
        frame.settings.debugView = view;
        frame.reuse.changes = changes;
        frame.reuse.fullShare = 1;
        for (int i = 0; i < 3; ++i) { // all, and then parts
          frame.reuse.frame = ++number;
          if (changes == Changes::Objects) frame.objects.assign(1, {});
          if (changes == Changes::Detect) frame.depth.version = i == 2 ? 5 : 0;
          const Status drawn = effect.render(frame);
          INFO(drawn.message);
          if (drawn.code != StatusCode::InvalidFrame) CHECK(drawn);
        }
      });
      CHECK(effect.statistics().compiledPrograms == count);
    }
  for (const Technique technique : {Technique::Tree, Technique::Epipolar})
    for (const DebugView view :
         {DebugView::Composite, DebugView::Slices, DebugView::Samples, DebugView::Breaks, DebugView::MarchSamples,
          DebugView::FixupPixels, DebugView::NodeVisits, DebugView::Difference}) {
      forEveryVariant(scene, [&](Frame frame) {
        if (frame.output.inscatter == 0) return;
        frame.settings.technique = technique;
        frame.settings.debugView = view;
        const Status drawn = effect.render(frame);
        INFO(drawn.message);
        if (drawn.code != StatusCode::InvalidFrame) CHECK(drawn);
      });
      CHECK(effect.statistics().compiledPrograms == count);
    }
}
