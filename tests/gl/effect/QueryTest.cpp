// Queries of the effect's own: from a pool that no steady frame adds to, and read by nobody but statistics().
#include "FakeContext.h"
#include "ReuseRig.h"
#include "support/Catch.h"

using namespace tyndall;
using tests::address;
using tests::FakeContext;

namespace {

int made = 0, begun = 0, read = 0;
void GLAD_API_PTR genQueries(GLsizei count, GLuint* names) {
  made += count;
  host::gl().GenQueries(count, names);
}
void GLAD_API_PTR beginQuery(GLenum target, GLuint name) {
  ++begun;
  host::gl().BeginQuery(target, name);
}
void GLAD_API_PTR readQuery(GLuint name, GLenum what, GLuint64* value) {
  ++read;
  host::gl().GetQueryObjectui64v(name, what, value);
}
const std::map<std::string, void*> kCounted = {{"glGenQueries", address(genQueries)},
                                               {"glBeginQuery", address(beginQuery)},
                                               {"glGetQueryObjectui64v", address(readQuery)}};

} // namespace

TEST_CASE("queries: a steady frame makes none and reads none") {
  for (const PassTiming timing : {PassTiming::Off, PassTiming::TimerQuery})
    for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
      CAPTURE(static_cast<int>(timing), static_cast<int>(technique));
      tests::ShaftRig rig = tests::smallShaftRig(technique);
      const FakeContext fake({}, kCounted);
      const std::unique_ptr<Effect> created = tests::newEffect({fake.loader(), timing});
      made = begun = read = 0;
      for (int frame = 0; frame < 8; ++frame) {
        if (frame == 4) made = 0;
        CHECK(created->render(rig.scene.frame));
      }
      CHECK(read == 0);
      CHECK(made == 0);
      CHECK((begun > 0) == (technique == Technique::Epipolar));
    }
}

TEST_CASE("queries: statistics are the same however often they are asked for, and start anew with a frame") {
  tests::ShaftRig rig = tests::smallShaftRig(Technique::Epipolar);
  const std::unique_ptr<Effect> created = tests::newEffect({{}, PassTiming::TimerQuery});
  Effect& effect = *created;
  rig.scene.frame.settings.leastWeight = 1; // so that some pixels are marched by themselves
  std::uint64_t marched = 0, fixedUp = 0;
  for (int frame = 0; frame < 5; ++frame) { // read in some of them only
    CHECK(effect.render(rig.scene.frame));
    if (frame == 1 || frame == 2) continue;
    for (int again = 0; again < 2; ++again) {
      const Statistics statistics = effect.statistics();
      if (frame == 0 && again == 0) marched = statistics.marchedSamples, fixedUp = statistics.fixupPixels;
      CHECK(statistics.marchedSamples == marched);
      CHECK(statistics.fixupPixels == fixedUp);
      double milliseconds = 0;
      for (const PassStatistics& pass : statistics.passes)
        milliseconds += pass.milliseconds;
      CHECK(milliseconds > 0);
    }
  }
  CHECK(marched > 0);
  CHECK(fixedUp > 0);
}

TEST_CASE("queries: none is begun while one of the engine's own is under way") {
  tests::ShaftRig rig = tests::smallShaftRig(Technique::Epipolar);
  const FakeContext fake({}, kCounted);
  const std::unique_ptr<Effect> created = tests::newEffect({fake.loader()});
  for (const GLenum kind : {GL_SAMPLES_PASSED, GL_ANY_SAMPLES_PASSED}) {
    GLuint query = 0;
    host::gl().GenQueries(1, &query);
    host::gl().BeginQuery(kind, query);
    begun = 0;
    CHECK(created->render(rig.scene.frame));
    CHECK(begun == 0);
    host::gl().EndQuery(kind);
    host::gl().DeleteQueries(1, &query);
    CHECK(created->render(rig.scene.frame));
    CHECK(begun > 0);
  }
}
