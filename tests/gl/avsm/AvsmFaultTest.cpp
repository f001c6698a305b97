// Calls of an AVSM in which one call of GL fails, or it and all after it: a status, the state as it was, and the same
// calls again make the right curves.
#include "AvsmRig.h"
#include "gl/effect/FaultSweep.h"
#include "gl/effect/GlState.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <functional>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;
using host::gl;
using tests::Fault;
using tests::FaultyContext;
using tests::Times;

namespace {

constexpr int kSize = 16, kNodes = 4, kMostCalls = 200;

using Bits = std::vector<std::uint32_t>;

// An engine with smoke and fog to capture and to stream.
struct Engine {
  FaultyContext context;
  AvsmConfig config = tests::configOf(CurveReduction::WholeCurve, kSize, kNodes, true);
  std::unique_ptr<Avsm> avsm;
  host::GlBuffer buffer = host::makeBuffer();
  AvsmParticles particles;
  Light light;
  std::vector<tests::Captured> segments;
  host::GlTexture density = host::makeTexture();
  std::vector<AvsmVolume> volumes{2};

  Engine() {
    config.loader = context.loader();
    const std::vector<float> spheres = {0, 0, 0.5F, 0.4F, 1, 0.1F, 0, -0.2F, 0.6F, 2};
    gl().BindBuffer(GL_ARRAY_BUFFER, buffer.name());
    gl().BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(spheres.size() * sizeof(float)), spheres.data(),
                    GL_STATIC_DRAW);
    gl().BindBuffer(GL_ARRAY_BUFFER, 0);
    particles.buffer = buffer.name();
    particles.count = 2;
    light.direction = {0, 0, -1};
    light.shadow.views = {{tests::toMat4(glm::scale(glm::dmat4(1), glm::dvec3(1, 1, -1))), 0}};
    gl().BindTexture(GL_TEXTURE_3D, density.name());
    const std::vector<float> values = {0, 1, 0.5F, 0, 0.25F, 1, 0, 2};
    gl().TexImage3D(GL_TEXTURE_3D, 0, GL_R32F, 2, 2, 2, 0, GL_RED, GL_FLOAT, values.data());
    gl().BindTexture(GL_TEXTURE_3D, 0);
    volumes[0].density = density.name();
    volumes[0].extinction = 1;
    volumes[1].shape = AvsmVolume::Shape::Sphere;
    volumes[1].extinction = 0.5;
    for (int i = 0; i < 40; ++i)
      segments.push_back(
          {{i % 8, i % 5, 0}, 0.01F * static_cast<float>(i), 0.02F * static_cast<float>(i) + 0.1F, 0.7F});
  }

  Status create() {
    AvsmResult made = Avsm::create(config);
    avsm = std::move(made.avsm);
    return made.status;
  }

  Bits curves() const {
    const GLuint texture = avsm ? avsm->curves().texture : 0;
    if (texture == 0) return {};
    Bits bits(4 * kSize * kSize * kNodes / 4);
    gl().BindTexture(GL_TEXTURE_2D_ARRAY, texture);
    gl().GetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits.data());
    gl().BindTexture(GL_TEXTURE_2D_ARRAY, 0);
    return bits;
  }
};

// A call, and what the engine does of its own before it.
struct Step {
  const char* name;
  std::function<void(Engine&)> before;
  std::function<Status(Engine&)> call;
  bool keepsCurves; // unless it is Ok
};

void nothing(Engine&) {}

const std::vector<Step>& capturing() {
  static const std::vector<Step> all = {
      {"create", nothing, [](Engine& e) { return e.create(); }, false},
      {"begin", nothing, [](Engine& e) { return e.avsm->begin(2); }, true},
      {"drawVolumes", [](Engine& e) { tests::captureInto(*e.avsm, e.segments); },
       [](Engine& e) { return e.avsm->drawVolumes(e.light, e.volumes); }, true},
      {"resolve", nothing, [](Engine& e) { return e.avsm->resolve(); }, false},
  };
  return all;
}

const std::vector<Step>& streaming() {
  static const std::vector<Step> all = {
      {"create", nothing, [](Engine& e) { return e.create(); }, false},
      {"beginStreaming", nothing, [](Engine& e) { return e.avsm->beginStreaming(); }, false},
      {"drawParticles", nothing, [](Engine& e) { return e.avsm->drawParticles(e.light, e.particles); }, true},
      {"drawVolumes", nothing, [](Engine& e) { return e.avsm->drawVolumes(e.light, e.volumes); }, true},
      {"resolve", nothing, [](Engine& e) { return e.avsm->resolve(); }, true},
  };
  return all;
}

void require(const Status& status) {
  INFO(status.message);
  REQUIRE(status);
}

// All steps, or those from one on, of an AVSM that is there already.
void run(Engine& engine, const std::vector<Step>& steps, std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    steps[i].before(engine);
    require(steps[i].call(engine));
  }
}

class Sweep {
public:
  explicit Sweep(const std::vector<Step>& steps) : steps_(steps) {
    run(engine_, steps_, 0, steps_.size());
    expected_ = engine_.curves();
    run(engine_, steps_, 1, steps_.size());
    REQUIRE(engine_.curves() == expected_);
  }

  int check(std::size_t at, Fault kind, Times times, bool used) {
    tests::Findings findings;
    int call = 1;
    while (call < kMostCalls && runOnce(at, kind, times, used, call, findings))
      ++call;
    CAPTURE(steps_[at].name, nameOf(tests::SweepOptions{kind, times, used}));
    if (!findings.empty()) FAIL_CHECK(findings.text());
    return call - 1;
  }

private:
  bool runOnce(std::size_t at, Fault kind, Times times, bool used, int call, tests::Findings& findings) {
    engine_.avsm.reset();
    if (used) run(engine_, steps_, 0, steps_.size());
    run(engine_, steps_, used ? 1 : 0, at);
    const Step& step = steps_[at];
    step.before(engine_);
    const Bits curves = engine_.curves();
    const tests::GlState state = tests::captureGlState();
    engine_.context.fail(kind, call, times);
    const Status status = step.call(engine_);
    if (!engine_.context.heal()) return false;
    findings.countCall();
    const auto check = [&](bool fine, const std::string& what) {
      if (!fine) findings.add(what, call);
    };
    check(tests::takeGlError() == GL_NO_ERROR, "an error is left pending");
    check(tests::testContext().takeErrors().empty(), "GL reports errors");
    if (!status) {
      check(isStatusOf(kind, status), "says " + std::to_string(static_cast<int>(status.code)));
      check(tests::captureGlState() == state, "state");
      check(!step.keepsCurves || engine_.curves() == curves, "curves");
    } else {
      run(engine_, steps_, at + 1, steps_.size());
      check(engine_.curves() == expected_, "Ok, and not the curves");
    }
    run(engine_, steps_, engine_.avsm ? 1 : 0, steps_.size());
    check(engine_.curves() == expected_, "the next curves differ");
    return true;
  }

  const std::vector<Step>& steps_;
  Engine engine_;
  Bits expected_;
};

void checkAll(const std::vector<Step>& steps) {
  Sweep sweep(steps);
  int points = 0;
  for (const Fault kind : {Fault::Compile, Fault::Link, Fault::Texture, Fault::Buffer, Fault::Framebuffer})
    for (const Times times : {Times::From, Times::Only})
      for (std::size_t at = 0; at < steps.size(); ++at)
        for (const bool used : {false, true})
          if (at > 0 || !used) points += sweep.check(at, kind, times, used);
  CHECK(points > 10);
}

} // namespace

TEST_CASE("avsm: a call that fails while smoke is captured, whichever, is reported, and the next curves are right") {
  if (tests::hasAvsm()) checkAll(capturing());
}

TEST_CASE("avsm: a call that fails while smoke is streamed, whichever, is reported, and the next curves are right") {
  if (tests::hasAvsm()) checkAll(streaming());
}
