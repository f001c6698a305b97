#include "ViewerRig.h"
#include "reference/Metrics.h"

#include <gl/ReadBack.h>
#include <random>

namespace {

reference::Image imageOf(GLuint texture, int width, int height) {
  return reference::Image(width, height, host::readColour(texture, width, height, 3));
}

} // namespace

TEST_CASE("errors that are added up are those of the reference's metrics") {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 2);
  std::vector<float> got(3000), exact(3000);
  for (std::size_t i = 0; i < got.size(); ++i) {
    exact[i] = uniform(random);
    got[i] = exact[i] + uniform(random) * uniform(random) * 0.01F;
  }
  viewer::ErrorSum sum;
  sum.add(got.data(), exact.data(), 1000);
  sum.add(got.data() + 1000, exact.data() + 1000, 2000);
  const reference::ErrorMetrics wanted = reference::compare({10, 100, got}, {10, 100, exact});
  CHECK(sum.errors().rRmse == Approx(wanted.rRmse));
  CHECK(sum.errors().p99 == Approx(wanted.p99).epsilon(0.01));
  CHECK(sum.errors().mean == Approx(wanted.mean));
}

TEST_CASE("no error, a black reference and what is not finite have their numbers") {
  const std::vector<float> ones(30, 1.0F), zeros(30, 0.0F);
  viewer::ErrorSum same, black, both;
  same.add(ones.data(), ones.data(), 30);
  CHECK(same.errors().rRmse == 0);
  CHECK(same.errors().p99 == 0);
  black.add(ones.data(), zeros.data(), 30);
  CHECK(std::isinf(black.errors().rRmse));
  both.add(zeros.data(), zeros.data(), 30);
  CHECK(both.errors().rRmse == 0);
  const float nan = std::nanf("");
  both.add(&nan, ones.data(), 1);
  CHECK(std::isinf(both.errors().p99));
}

TEST_CASE("the error at rest is that of the whole picture against exact", "[pictures]") {
  tests::ViewerRig rig;
  rig.load("projector");
  settings::State state = rig.viewer.state();
  state.settings = tyndall::settingsOf(tyndall::Profile::Performance);
  rig.viewer.edit("profile", state);
  rig.viewer.measuresErrors = true;
  rig.settle();
  REQUIRE(rig.viewer.isMeasured());
  const int width = rig.viewer.first().width(), height = rig.viewer.first().height();
  const reference::Image shown = imageOf(rig.viewer.first().inscatter(), width, height);
  const reference::Image exact = imageOf(rig.viewer.meter().exactInscatter(), width, height);
  const reference::ErrorMetrics wanted = reference::compare(shown, exact);
  const viewer::Errors errors = rig.viewer.meter().errors().front();
  CHECK(errors.rRmse == Approx(wanted.rRmse).epsilon(1e-4));
  CHECK(errors.p99 == Approx(wanted.p99).epsilon(0.01));
  CHECK(errors.rRmse > 0.001); // there is some

  // Exact at once, not in steps: rays of a cropped projection are the same but for the rounding of floats, by which a
  // few meet a texel's edge on its other side.
  state.settings.technique = tyndall::Technique::Exact;
  viewer::Way way({tests::testContext().loader()});
  tyndall::Frame frame = rig.viewer.first().frame();
  frame.reuse = {};
  frame.objects.clear();
  way.draw(rig.viewer.surfaces(), frame, state.settings);
  const reference::ErrorMetrics difference = reference::compare(exact, imageOf(way.inscatter(), width, height));
  CHECK(difference.max < 1e-3);
  CHECK(difference.rRmse < 2e-5);
}
