// Hostile engines: whatever state they leave behind (HostileRows.cpp), in every technique, way to reuse and debug view
// the picture is that of a clean state to the last bit, or the frame is refused in words; and the state is given back.
#include "GlState.h"
#include "HostileRows.h"
#include "ReuseRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <algorithm>
#include <map>

using namespace tyndall;

namespace {

constexpr int kWidth = 64, kHeight = 48;
constexpr float kBefore = 0.25F; // in all channels of all targets

struct Mode {
  std::string name;
  Technique technique = Technique::Epipolar;
  Changes changes = Changes::Unknown;
  DebugView view = DebugView::Composite;
  bool outputs = false; // of the engine's own, besides its colour
};

const std::vector<Mode>& modes() {
  static const std::vector<Mode> all = [] {
    std::vector<Mode> list = {{"epipolar", Technique::Epipolar},
                              {"tree", Technique::Tree},
                              {"exact", Technique::Exact},
                              {"low rank", Technique::LowRank},
                              {"epipolar, outputs", Technique::Epipolar, Changes::Unknown, DebugView::Composite, true},
                              {"exact, outputs", Technique::Exact, Changes::Unknown, DebugView::Composite, true},
                              {"detect", Technique::Epipolar, Changes::Detect},
                              {"objects", Technique::Epipolar, Changes::Objects},
                              {"tree, detect", Technique::Tree, Changes::Detect},
                              {"objects, redrawn", Technique::Epipolar, Changes::Objects, DebugView::Redrawn}};
    for (int view = 1; view < static_cast<int>(DebugView::Redrawn); ++view)
      list.push_back(
          {"view " + std::to_string(view), Technique::Epipolar, Changes::Unknown, static_cast<DebugView>(view)});
    return list;
  }();
  return all;
}

// What a mode's frames, one or two, draw: colour, outputs, and last the visits that DebugView::NodeVisits counts.
using Picture = std::vector<std::vector<float>>;

class Engine {
public:
  explicit Engine(const Mode& mode) : mode_(mode) {
    tests::reuse::begin(rig_, mode.changes);
    rig_.scene.frame.settings.technique = mode.technique;
    rig_.scene.frame.settings.debugView = mode.view;
    rig_.addLight(tests::reuse::sun(), 64, true);
    if (!mode.outputs) rig_.scene.frame.output = {};
    const std::vector<float> values(4 * kWidth * kHeight, kBefore);
    colour_ = rig_.scene.makeColour(GL_RGBA16F, values);
    for (const GLuint texture : {rig_.scene.frame.output.inscatter, rig_.scene.frame.output.transmittance}) {
      if (texture == 0) continue;
      host::gl().BindTexture(GL_TEXTURE_2D, texture);
      host::gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kWidth, kHeight, GL_RGBA, GL_FLOAT, values.data());
    }
  }

  // Each picture has an effect of its own, which sees the hostile state from the first.
  Picture draw(const tests::HostileRow& row) {
    Picture picture;
    CreateResult created;
    const int frames = mode_.changes == Changes::Unknown ? 1 : 2;
    for (int number = 0; number < frames; ++number) {
      if (frames > 1) tests::reuse::moveTo(rig_, number);
      tests::HostileEngine engine{rig_.scene.frame};
      row.leave(engine);
      const tests::GlState before = tests::captureGlState();
      if (!created.effect) created = Effect::create({tests::testContext().loader(), PassTiming::Off});
      REQUIRE(created.effect);
      const Status status = created.effect->render(rig_.scene.frame);
      const tests::GlState after = tests::captureGlState();
      if (row.after) row.after();
      tests::leaveCleanState();
      checkStatus(row, status);
      for (const auto& [name, values] : before) {
        CAPTURE(name);
        if (values != after.at(name)) FAIL_CHECK("is not given back");
      }
      picture.push_back(read());
      picture.back().push_back(static_cast<float>(created.effect->statistics().visitsPerRay));
    }
    checkErrors(row);
    return picture;
  }

private:
  static void checkStatus(const tests::HostileRow& row, const Status& status) {
    INFO(status.message);
    CHECK(static_cast<bool>(status) == row.refusal.empty());
    CHECK(status.message.find(row.refusal) != std::string::npos);
  }

  // Of the engine's own making only.
  static void checkErrors(const tests::HostileRow& row) {
    for (const std::string& error : tests::testContext().takeErrors()) {
      CAPTURE(error);
      if (row.error.empty() || error.find(row.error) == std::string::npos) FAIL_CHECK("a GL error");
    }
  }

  std::vector<float> read() const {
    const Frame& frame = rig_.scene.frame;
    std::vector<float> all;
    for (const GLuint texture : {frame.colour, frame.output.inscatter, frame.output.transmittance}) {
      if (texture == 0) continue;
      const std::vector<float> values = host::readColour(texture, kWidth, kHeight);
      all.insert(all.end(), values.begin(), values.end());
    }
    return all;
  }

  Mode mode_;
  tests::ShaftRig rig_{kWidth, kHeight};
  host::GlTexture colour_;
};

const Picture& cleanPicture(const Mode& mode) {
  static std::map<std::string, Picture> known;
  Picture& picture = known[mode.name];
  if (picture.empty()) picture = Engine(mode).draw({"a clean state", [](tests::HostileEngine&) {}});
  return picture;
}

bool isUntouched(const std::vector<float>& picture) {
  return std::all_of(picture.begin(), picture.end() - 1, [](float value) { return value == kBefore; });
}

void check(const tests::HostileRow& row, const Mode& mode) {
  CAPTURE(row.name, mode.name);
  const Picture& clean = cleanPicture(mode);
  const Picture picture = Engine(mode).draw(row);
  REQUIRE(picture.size() == clean.size());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    CAPTURE(i);
    if (!row.refusal.empty())
      CHECK(isUntouched(picture[i]));
    else if (!tests::bitEqual(picture[i], clean[i]))
      FAIL_CHECK("not the picture of a clean state");
  }
}

} // namespace

TEST_CASE("hostile engines: the picture of a clean state, or a refusal in words, and the state given back",
          "[compatibility]") {
  tests::testContext();
  tests::leaveCleanState();
  std::size_t turn = 0;
  for (const tests::HostileRow& row : tests::hostileRows()) {
    if (tests::testContext().glVersion() < row.version) continue;
    if (row.where == tests::Where::Everywhere)
      for (const Mode& mode : modes())
        check(row, mode);
    else
      check(row, modes()[turn++ % modes().size()]);
  }
}

TEST_CASE("hostile engines: modes draw pictures that differ, and second frames too") {
  for (const Mode& mode : modes()) {
    CAPTURE(mode.name);
    for (const std::vector<float>& picture : cleanPicture(mode))
      CHECK_FALSE(isUntouched(picture));
    if (cleanPicture(mode).size() > 1) CHECK(cleanPicture(mode)[0] != cleanPicture(mode)[1]);
  }
}
