// StateMode::Leave: the picture of StateMode::Restore whatever the engine leaves behind, and a state afterwards that is
// as the header says: a table here, and all else untouched.
#include "FrameCases.h"
#include "GlState.h"
#include "LegacyState.h"
#include "support/Catch.h"
#include "support/TestContext.h"

using namespace tyndall;
using tests::Stage;

namespace {

// What a row of the state is when an effect that leaves it has drawn.
struct LeftRow {
  std::string name; ///< of rows in GlState.cpp, with or without an index; how they begin if it ends in ' ' or '['
  bool anything;    ///< not said
  std::vector<double> values;
};

// Capabilities, bindings and masks as a full-screen triangle needs them; the rest of what is set is not said.
const std::vector<LeftRow>& leftRows() {
  static const std::vector<LeftRow> all = [] {
    std::vector<LeftRow> rows = {
        {"program", false, {0}},
        {"vertex array", false, {0}},
        {"draw framebuffer", false, {0}},
        {"read framebuffer", false, {0}}, // after a copy; else it is as it was
        {"renderbuffer", false, {0}},
        {"active texture", false, {GL_TEXTURE0}},
        {"uniform buffer", false, {0}},
        {"pixel unpack buffer", false, {0}},
        {"polygon mode", false, {GL_FILL}},
        {"clip origin", false, {GL_LOWER_LEFT}},
        {"clip depth mode", false, {GL_NEGATIVE_ONE_TO_ONE}},
        {"colour mask", false, {1, 1, 1, 1}},
        {"blend[", false, {0}},
        {"blend", false, {0}},
        {"unpack alignment", false, {4}},
        {"viewport", true, {}},
        {"scissor box", true, {}}, // of bands; else it is as it was
        {"blend ", true, {}},      // factors and equations
        {"stencil func", true, {}},
        {"stencil ref", true, {}},
        {"stencil value mask", true, {}},
        {"stencil write mask", true, {}},
        {"stencil fail", true, {}},
        {"stencil pass", true, {}},
        {"stencil depth fail", true, {}},
        {"stencil back ", true, {}},
        {"unit ", true, {}}, // of textures and samplers
        {"uniform binding ", true, {}},
    };
    for (const char* off :
         {"cull face",       "depth test",        "stencil test",       "scissor test",     "scissor[",
          "dither",          "logic op",          "rasterizer discard", "framebuffer sRGB", "sample mask",
          "sample coverage", "alpha to coverage", "alpha to one",       "polygon smooth",   "clip distance ",
          "unpack skip ",    "unpack swap bytes", "unpack row length",  "unpack LSB first", "unpack image height"})
      rows.push_back({off, false, {0}});
    for (const auto& [name, values] : tests::leftLegacyState())
      rows.push_back({name, false, values});
    return rows;
  }();
  return all;
}

// The row that says most of a name; null if it is to be as it was.
const LeftRow* leftRow(const std::string& name) {
  const LeftRow* best = nullptr;
  for (const LeftRow& row : leftRows()) {
    const std::string& start = row.name;
    const bool begins = start.back() == ' ' || start.back() == '[';
    const bool matches = begins ? name.rfind(start, 0) == 0 : name == start || name.rfind(start + "[", 0) == 0;
    if (matches && (!best || start.size() > best->name.size())) best = &row;
  }
  return best;
}

// Names of the rows that are not as said; empty if all are.
std::string wrongRows(const tests::GlState& before, const tests::GlState& after, bool bands, bool copies) {
  std::string names;
  for (const auto& [name, values] : after) {
    const LeftRow* row = leftRow(name);
    if (name == "scissor box" && !bands) row = nullptr;
    if (name == "read framebuffer" && !copies) row = nullptr;
    if (row && row->anything) continue;
    std::vector<double> expected = row ? row->values : before.at(name);
    if (expected.size() > values.size()) expected.resize(values.size()); // polygon mode: one of two
    if (values != expected) names += name + ", ";
  }
  return names;
}

std::unique_ptr<Effect> newEffect(StateMode state, const Tuning& tuning = {}) {
  return tests::newEffect({tests::testContext().loader(), PassTiming::Off, {}, state, tuning});
}

// A view's frames, each drawn into a poisoned state.
std::vector<tests::TargetContents> drawPoisoned(Stage& stage, StateMode mode, const Tuning& tuning) {
  const std::unique_ptr<Effect> effect = newEffect(mode, tuning);
  std::vector<tests::TargetContents> pictures;
  stage.rewind();
  for (int i = 0; i < 3; ++i) {
    stage.fill();
    Status status;
    {
      const tests::Poison poison;
      const tests::GlState before = tests::captureGlState();
      status = effect->render(stage.frame());
      const tests::GlState after = tests::captureGlState();
      tests::Poison::lift();
      if (mode == StateMode::Leave)
        CHECK(wrongRows(before, after, tuning.bandMilliseconds > 0, stage.frame().viewport.x > 0) == "");
      else
        CHECK((before == after)); // without a print of either
    }
    INFO(status.message);
    REQUIRE(status);
    pictures.push_back(stage.read());
    stage.advance();
  }
  return pictures;
}

constexpr const char* kCases[] = {"epipolar",
                                  "epipolar, two lights, all targets",
                                  "epipolar, both outputs",
                                  "epipolar, spread",
                                  "epipolar, bilinear and glass",
                                  "tree, two lights, all targets",
                                  "exact, two lights",
                                  "exact, lamp, all targets",
                                  "low rank",
                                  "view 1",
                                  "view 6",
                                  "view 9",
                                  "detect, first frame",
                                  "objects, first frame",
                                  "objects, redrawn, first frame",
                                  "detect, two lights, by the stencil, fix-up by tiles",
                                  "epipolar, spread, fix-up by tiles",
                                  "detect, colour copied",
                                  "elsewhere, all targets",
                                  "layers elsewhere, detect"};

} // namespace

TEST_CASE("a state that is left draws what one that is given back does, and is as the header says") {
  tests::testContext();
  for (const char* name : kCases) {
    CAPTURE(name);
    const tests::FrameCase& item = tests::frameCase(name);
    Stage stage(item);
    const std::vector<tests::TargetContents> expected = drawPoisoned(stage, StateMode::Restore, item.tuning);
    const std::vector<tests::TargetContents> left = drawPoisoned(stage, StateMode::Leave, item.tuning);
    for (std::size_t i = 0; i < left.size(); ++i) {
      CAPTURE(i);
      CHECK(tests::bitEqual(left[i][0], expected[i][0]));
      CHECK(tests::bitEqual(left[i][1], expected[i][1]));
      CHECK(tests::bitEqual(left[i][2], expected[i][2]));
    }
  }
}

TEST_CASE("draws in bands give back or leave the state as whole ones do, and draw the same into it") {
  tests::testContext();
  for (const char* name : {"epipolar, two lights, all targets", "exact, two lights", "objects, first frame"}) {
    CAPTURE(name);
    Stage stage(tests::frameCase(name));
    const std::vector<tests::TargetContents> expected = drawPoisoned(stage, StateMode::Restore, {});
    Tuning bands;
    bands.bandMilliseconds = 1.5e-4;
    for (const StateMode mode : {StateMode::Restore, StateMode::Leave})
      CHECK(tests::same(drawPoisoned(stage, mode, bands), expected));
  }
}

TEST_CASE("a state that is left: an engine that sets its own state between frames sees its own pictures only") {
  Stage stage(tests::frameCase("epipolar, two lights, all targets"));
  const std::unique_ptr<Effect> leaves = newEffect(StateMode::Leave), restores = newEffect(StateMode::Restore);
  const tests::TargetContents expected = stage.draw(*restores);
  for (int i = 0; i < 3; ++i)
    for (Effect* effect : {leaves.get(), restores.get()}) {
      CAPTURE(i, effect == leaves.get());
      const tests::TargetContents drawn = stage.draw(*effect); // without a clean state between
      CHECK(tests::bitEqual(drawn[0], expected[0]));
    }
  tests::Poison::lift();
}

TEST_CASE("a state that is left: a frame that is refused leaves all as it was") {
  Stage stage(tests::frameCase("epipolar"));
  const std::unique_ptr<Effect> effect = newEffect(StateMode::Leave);
  Frame broken = stage.frame();
  broken.viewport.width = 0;
  const tests::Poison poison;
  const tests::GlState before = tests::captureGlState();
  const Status status = effect->render(broken);
  const tests::GlState after = tests::captureGlState();
  tests::Poison::lift();
  CHECK(status.code == StatusCode::InvalidFrame);
  CHECK((before == after));
}
