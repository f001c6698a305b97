// Temporal reuse (Frame::reuse): what keeps a view's picture and what drops it, and input that is refused.
#include "ReuseRig.h"

#include <algorithm>
#include <functional>
#include <limits>

using namespace tyndall;
using namespace tests::reuse;

namespace {

std::vector<std::string> passesRun() {
  std::vector<std::string> names;
  for (const PassStatistics& pass : tests::testEffect().statistics().passes)
    if (pass.skipped.empty()) names.push_back(pass.name);
  return names;
}

// The frame after it moved, or not: what it must look like, and how much of it is drawn.
double shareOf(tests::ShaftRig& rig) {
  ++rig.scene.frame.reuse.frame;
  const Picture picture = reused(rig);
  checkSame(picture, full(rig));
  return picture.share;
}

} // namespace

TEST_CASE("where nothing has changed the last picture is shown, bit for bit, for as long as it lasts") {
  for (const Changes changes : {Changes::Detect, Changes::Objects}) {
    CAPTURE(static_cast<int>(changes));
    tests::ShaftRig rig = sunlit(changes);
    CHECK(shareOf(rig) == 1);
    const reference::ImageAnswer first = rig.scene.outputs();
    for (int frame = 0; frame < 100; ++frame) {
      ++rig.scene.frame.reuse.frame;
      const Picture picture = reused(rig);
      CHECK(picture.share == 0);
      CHECK(passesRun() == std::vector<std::string>{"output", "output"});
      CHECK(picture.answer.inscatter == first.inscatter);
      CHECK(picture.answer.transmittance == first.transmittance);
    }
  }
}

TEST_CASE("shadows that are switched off and on again are drawn in full, and are those that there were") {
  for (const Changes changes : {Changes::Detect, Changes::Objects}) {
    CAPTURE(static_cast<int>(changes));
    tests::ShaftRig rig = sunlit(changes);
    const ShadowMap shadow = rig.scene.frame.lights[0].shadow;
    CHECK(shareOf(rig) == 1);
    const reference::ImageAnswer shadowed = rig.scene.outputs();
    for (int times = 0; times < 2; ++times) {
      rig.scene.frame.lights[0].shadow = {};
      CHECK(shareOf(rig) == 1);
      CHECK(tests::difference(rig.scene.outputs().inscatter, shadowed.inscatter) > 0.1);
      rig.scene.frame.lights[0].shadow = shadow;
      CHECK(shareOf(rig) == 1);
      CHECK(tests::difference(rig.scene.outputs().inscatter, shadowed.inscatter) <= 1e-5);
    }
  }
}

TEST_CASE("a version that differs, also a lower one, is a change; one that is not stated is compared") {
  tests::ShaftRig rig = sunlit(Changes::Detect);
  Frame& frame = rig.scene.frame;
  shareOf(rig);
  rig.setMoving({tumbling(1)});
  frame.lights[0].shadow.version = 2;
  frame.depth.version = 1;
  const double moved = shareOf(rig);
  CHECK(moved > 0);
  CHECK(moved < 0.1);
  CHECK(shareOf(rig) == 0);
  frame.lights[0].shadow.version = 0; // compared, and found to be the same
  CHECK(shareOf(rig) == 0);
  CHECK(std::find(passesRun().begin(), passesRun().end(), "light 0 rows") != passesRun().end());
  rig.setMoving({tumbling(2)});
  frame.depth.version = 0;
  CHECK(shareOf(rig) > 0);
  frame.depth.version = 9; // stated from now on
  shareOf(rig);
  frame.lights[0].shadow.version = 9;
  shareOf(rig);
  CHECK(shareOf(rig) == 0);
}

TEST_CASE(
    "a frame that was left out, or comes again, is drawn in full; so is one after a change of what all depends on") {
  tests::ShaftRig rig = sunlit(Changes::Objects);
  Frame& frame = rig.scene.frame;
  const auto settle = [&] {
    for (int i = 0; i < 20; ++i)
      shareOf(rig);
    CHECK(shareOf(rig) == 0);
  };
  settle();
  ++frame.reuse.frame;
  rig.setMoving({tumbling(3)});
  CHECK(shareOf(rig) == 1);
  settle();
  frame.reuse.frame -= 2;
  CHECK(shareOf(rig) == 1);
  const std::vector<std::function<void()>> changes = {[&] { rig.look(tests::lookAt({0.1, 2, 0}, {0, 2, -1})); },
                                                      [&] { frame.medium.absorption = {0.01F, 0.01F, 0.01F}; },
                                                      [&] { frame.lights[0].colour = {2, 1, 1}; },
                                                      [&] { frame.lights[0].direction = {0.25, -0.602, 1}; },
                                                      [&] { frame.settings.slices = 700; },
                                                      [&] { frame.settings.shadowFilter = ShadowFilter::Bilinear; },
                                                      [&] {
                                                        frame.lights.push_back(frame.lights[0]);
                                                        frame.lights.back().colour = {0, 1, 0};
                                                      }};
  for (const auto& change : changes) {
    settle();
    change();
    CHECK(shareOf(rig) == 1);
  }
}

TEST_CASE("views that take turns keep a picture each, and the fifth makes the first forget") {
  tests::ShaftRig rig = sunlit(Changes::Objects);
  Frame& frame = rig.scene.frame;
  const std::uint64_t first = frame.reuse.eye;
  for (int round = 0; round < 3; ++round)
    for (std::uint64_t view = 0; view < 4; ++view) {
      frame.reuse.eye = first + view;
      frame.reuse.frame = static_cast<std::uint64_t>(round);
      rig.look(tests::lookAt({0, 2, 0.2 * static_cast<double>(view)}, {0, 2, -1}));
      const Picture picture = reused(rig);
      checkSame(picture, full(rig));
      CHECK(picture.share == (round == 0 ? 1 : 0));
    }
  for (int i = 0; i < 4; ++i)
    newView(); // those that were used
  frame.reuse.eye = newView();
  reused(rig);
  frame.reuse.eye = first;
  frame.reuse.frame = 3;
  rig.look(tests::lookAt({0, 2, 0}, {0, 2, -1}));
  CHECK(reused(rig).share == 1);
}

TEST_CASE("where everything moves frames are drawn as if nothing was kept, most of the time, and reuse comes back") {
  tests::ShaftRig rig = sunlit(Changes::Detect);
  Frame& frame = rig.scene.frame;
  int kept = 0;
  for (int i = 0; i < 80; ++i) {
    rig.look(tests::lookAt({0.01 * i, 2, 0}, {0, 2, -1}));
    ++frame.depth.version;
    const Picture picture = reused(rig);
    CHECK(picture.share == 1);
    const std::vector<PassStatistics> passes = tests::testEffect().statistics().passes;
    if (passes.empty() || passes[0].name != "reuse") ++kept;
    if (i % 8 == 0) checkSame(picture, full(rig));
  }
  CHECK(kept <= 3 + 2 * 7); // three before the first rest, two before each of 2, 4, 8, 16, 16, 16 frames and at last
  for (int i = 0; i < 20; ++i)
    reused(rig);
  CHECK(reused(rig).share == 0);
}

TEST_CASE("refreshing draws every slice once in its period, a part a frame, and changes nothing") {
  tests::ShaftRig rig = sunlit(Changes::Objects);
  rig.scene.frame.reuse.refreshFrames = 5;
  shareOf(rig);
  const reference::ImageAnswer first = rig.scene.outputs();
  double sum = 0;
  for (int i = 0; i < 5; ++i) {
    const double share = shareOf(rig);
    CHECK(share <= 0.25);
    sum += share;
    CHECK(rig.scene.outputs().inscatter == first.inscatter);
  }
  CHECK(sum >= 0.99);
}

TEST_CASE(
    "two lights and objects: of one that nothing reaches no slice is marched, and of a light that moves all are") {
  tests::ShaftRig rig(96, 64);
  rig.addLight(sun(), 128);
  Light lamp = spot();
  lamp.shadow.views = tests::shadowViews(lamp);
  rig.addLight(lamp, 128);
  begin(rig, Changes::Objects);
  for (int frame = 0; frame < 6; ++frame) {
    CAPTURE(frame);
    moveTo(rig, frame);
    if (frame == 4) rig.scene.frame.lights[1].colour = {3, 2, 1};
    const Picture picture = reused(rig);
    checkSame(picture, full(rig));
    if (frame > 0) CHECK(picture.share < 1);
  }
}

TEST_CASE("other techniques, and no light at all, show the last picture or draw all of it") {
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::LowRank}) {
    tests::ShaftRig rig = sunlit(Changes::Objects);
    rig.scene.frame.settings.technique = technique;
    shareOf(rig);
    CHECK(shareOf(rig) == 0);
    rig.setMoving({tumbling(0)});
    rig.scene.frame.objects = {between(tumbling(0), tumbling(0))};
    CHECK(shareOf(rig) == 1);
  }
  tests::ShaftRig dark(64, 48);
  begin(dark, Changes::Objects);
  shareOf(dark);
  CHECK(shareOf(dark) == 0);
}

TEST_CASE("thousands of objects, and one around the eye, are reached by all slices and no less") {
  tests::ShaftRig rig = sunlit(Changes::Objects);
  shareOf(rig);
  for (int i = 0; i < 3000; ++i)
    rig.scene.frame.objects.push_back(between(tumbling(i), tumbling(i + 1)));
  rig.setMoving({tumbling(5), tumbling(100), tumbling(2000)});
  shareOf(rig);
  const glm::dmat4 around = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 2, 0)), glm::dvec3(60));
  rig.scene.frame.objects = {between(around, around)};
  rig.setMoving({tumbling(6)});
  shareOf(rig);
}

TEST_CASE("fields of reuse that break their rule are refused, field and rule named") {
  tests::ShaftRig rig = sunlit(Changes::Objects);
  const auto checkRefused = [&](const std::string& part, const std::function<void(Frame&)>& spoil) {
    Frame frame = rig.scene.frame;
    spoil(frame);
    const Status status = tests::testEffect().render(frame);
    CAPTURE(status.message, part);
    CHECK(status.code == StatusCode::InvalidFrame);
    CHECK(status.message.find(part) != std::string::npos);
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  checkRefused("reuse.changes is 7", [](Frame& f) { f.reuse.changes = static_cast<Changes>(7); });
  checkRefused("reuse.fullShare is -1", [](Frame& f) { f.reuse.fullShare = -1; });
  checkRefused("reuse.fullShare is nan", [](Frame& f) { f.reuse.fullShare = static_cast<float>(kNan); });
  checkRefused("reuse.refreshFrames is -3", [](Frame& f) { f.reuse.refreshFrames = -3; });
  checkRefused("objects[1].worldFromObject is not finite", [](Frame& f) {
    f.objects.resize(2);
    f.objects[1].worldFromObject[4] = kNan;
  });
  checkRefused("objects[0].lastWorldFromObject is singular", [](Frame& f) {
    f.objects.resize(1);
    f.objects[0].lastWorldFromObject[0] = 0; // no extent
  });
  checkRefused("objects[0].worldFromObject is not affine", [](Frame& f) {
    f.objects.resize(1);
    f.objects[0].worldFromObject[3] = 0.5;
  });
  checkRefused("objects is 1 long", [](Frame& f) {
    f.objects.resize(1);
    f.reuse.changes = Changes::Detect;
  });
}

TEST_CASE("what is kept is given up with Changes::Unknown, and what a new size replaces in time") {
  const std::unique_ptr<Effect> own = tests::newEffect();
  tests::ShaftRig rig = sunlit(Changes::Detect);
  Frame& frame = rig.scene.frame;
  const int slices = frame.settings.slices;
  const auto bytesOf = [&](Changes changes) {
    frame.reuse.changes = changes;
    for (int i = 0; i < 10; ++i) // two, and eight after which what they do not need is given up
      rig.scene.render(*own);
    return own->statistics().bytes;
  };
  const std::uint64_t without = bytesOf(Changes::Unknown), with = bytesOf(Changes::Detect);
  CHECK(with > without);
  for (const int fewer : {30, 100, 30, 100}) { // the textures of one at a time
    frame.settings.slices = fewer;
    CHECK(bytesOf(Changes::Detect) <= with);
  }
  frame.settings.slices = slices;
  CHECK(bytesOf(Changes::Unknown) == without);
}

TEST_CASE(
    "with a spread threshold, which needs the picture's mean, any change draws all of the picture as it would be") {
  tests::ShaftRig rig = sunlit(Changes::Detect);
  Frame& frame = rig.scene.frame;
  frame.settings.spreadThreshold = 0.01F;
  for (int i = 0; i < 3; ++i) {
    rig.setMoving({tumbling(i)});
    frame.depth.version = frame.lights[0].shadow.version = static_cast<std::uint64_t>(20 + i);
    CHECK(shareOf(rig) == 1);
    CHECK(shareOf(rig) == 0);
  }
}

TEST_CASE("a light of several draws keeps its slices while another one's change", "[sweep]") {
  tests::ShaftRig rig(8192, 1); // so many slices that four views do not fit
  Light cascaded = sun();
  cascaded.shadow.views = tests::shadowViews(cascaded, 4);
  rig.addLight(cascaded, 64);
  rig.addLight(sun(), 64);
  Frame& frame = rig.scene.frame;
  frame.settings.slices = 8192;
  begin(rig, Changes::Detect);
  frame.depth.version = frame.lights[0].shadow.version = frame.lights[1].shadow.version = 1;
  CHECK(shareOf(rig) == 1);
  for (std::uint64_t version = 2; version < 4; ++version) { // said to have changed
    frame.lights[1].shadow.version = version;
    const Picture picture = reused(rig);
    const std::vector<std::string> names = passesRun();
    CHECK(picture.share == 0);
    CHECK(std::find(names.begin(), names.end(), "light 0 rows") == names.end());
    checkSame(picture, full(rig));
  }
  frame.lights[1].colour = {2, 1, 1};
  CHECK(shareOf(rig) < 1);
}

TEST_CASE("a light that is gone leaves nothing behind") {
  const std::unique_ptr<Effect> own = tests::newEffect();
  tests::ShaftRig rig = sunlit(Changes::Detect);
  const auto bytes = [&] {
    for (int i = 0; i < 10; ++i) // two, and eight after which what they do not need is given up
      rig.scene.render(*own);
    return own->statistics().bytes;
  };
  const std::uint64_t one = bytes();
  rig.addLight(spot(), 64);
  CHECK(bytes() > one);
  rig.scene.frame.lights.pop_back();
  CHECK(bytes() <= one);
}
