// Config::programs: what one effect compiles the next one loads, and what a store holds can harm nothing.
#include "FaultyContext.h"
#include "FrameCases.h"
#include "support/Catch.h"

#include <algorithm>
#include <functional>

using namespace tyndall;
using tests::drawFrames;
using tests::Fault;
using tests::FaultyContext;
using tests::same;
using tests::Stage;
using tests::Times;

namespace {

constexpr int kMostCalls = 200;

std::unique_ptr<Effect> effectWith(const FaultyContext& context, const ProgramStore& programs) {
  return tests::newEffect({context.loader(), PassTiming::Off, programs});
}

// A store in memory.
struct Shelf {
  std::map<std::string, std::vector<std::uint8_t>> held;
  std::vector<std::string> asked;
  int saves = 0;

  ProgramStore store() {
    return {[this](const std::string& key) {
              asked.push_back(key);
              const auto found = held.find(key);
              return found == held.end() ? std::vector<std::uint8_t>() : found->second;
            },
            [this](const std::string& key, const std::vector<std::uint8_t>& bytes) {
              held[key] = bytes;
              ++saves;
            }};
  }
};

bool hasExtension(const std::string& wanted) {
  GLint count = 0;
  host::gl().GetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i)
    if (reinterpret_cast<const char*>(host::gl().GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))) == wanted)
      return true;
  return false;
}

bool hasBinaries() {
  if (tests::testContext().glVersion() >= 41) return true;
  WARN("skipped: the context is older than OpenGL 4.1");
  return false;
}

bool isFileName(const std::string& key) {
  return !key.empty() && key.size() <= 255 && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
  });
}

constexpr const char* kStored[] = {"epipolar, two lights, all targets",
                                   "tree",
                                   "exact, two lights",
                                   "low rank",
                                   "epipolar, spread",
                                   "view 9",
                                   "detect, first frame",
                                   "objects, first frame"};

// How the bytes of a store are spoiled.
const std::vector<std::pair<const char*, std::function<void(std::vector<std::uint8_t>&)>>>& spoilers() {
  static const std::vector<std::pair<const char*, std::function<void(std::vector<std::uint8_t>&)>>> all = {
      {"empty", [](auto& bytes) { bytes.clear(); }},
      {"one byte", [](auto& bytes) { bytes.resize(1); }},
      {"half", [](auto& bytes) { bytes.resize(bytes.size() / 2); }},
      {"one byte short", [](auto& bytes) { bytes.pop_back(); }},
      {"one byte more", [](auto& bytes) { bytes.push_back(7); }},
      {"a first byte that differs", [](auto& bytes) { bytes.front() ^= 0xFFU; }},
      {"a middle byte that differs", [](auto& bytes) { bytes[bytes.size() / 2] ^= 0xFFU; }},
      {"a last byte that differs", [](auto& bytes) { bytes.back() ^= 0xFFU; }},
      {"another text", [](auto& bytes) { bytes.assign(1000, 'x'); }},
  };
  return all;
}

} // namespace

TEST_CASE("program store: what one effect compiled the next one loads, and draws the same") {
  if (!hasBinaries()) return;
  FaultyContext context;
  for (const char* name : kStored) {
    CAPTURE(name);
    Shelf shelf;
    Stage stage(tests::frameCase(name));
    std::unique_ptr<Effect> effect = effectWith(context, shelf.store());
    context.resetCounts();
    CHECK(effect->prepare(stage.frame()).ready()); // more than the frames below need
    const std::vector<tests::TargetContents> expected = drawFrames(stage, *effect);
    CHECK(context.counts().links > 0);
    CHECK(shelf.saves == context.counts().links);
    CHECK(static_cast<int>(shelf.held.size()) == context.counts().links);
    for (const auto& entry : shelf.held) {
      CAPTURE(entry.first);
      CHECK(isFileName(entry.first));
      CHECK_FALSE(entry.second.empty());
    }
    for (const bool prepares : {true, false}) {
      effect = effectWith(context, shelf.store());
      context.resetCounts();
      shelf.saves = 0;
      if (prepares) CHECK(effect->prepare(stage.frame()).ready());
      CHECK(same(drawFrames(stage, *effect), expected));
      CHECK(context.counts().compiles + context.counts().links == 0);
      CHECK(shelf.saves == 0);
    }
  }
}

TEST_CASE("program store: bytes that are spoiled are compiled anew, and replaced") {
  if (!hasBinaries()) return;
  FaultyContext context;
  Stage stage(tests::frameCase("epipolar, two lights, all targets"));
  Shelf good;
  const std::vector<tests::TargetContents> expected = drawFrames(stage, *effectWith(context, good.store()));
  REQUIRE_FALSE(good.held.empty());
  for (const auto& [name, spoil] : spoilers()) {
    CAPTURE(name);
    Shelf shelf = good;
    shelf.saves = 0;
    for (auto& entry : shelf.held)
      spoil(entry.second);
    context.resetCounts();
    CHECK(same(drawFrames(stage, *effectWith(context, shelf.store())), expected));
    CHECK(context.counts().links == static_cast<int>(good.held.size()));
    CHECK(same(shelf.held, good.held));
    CHECK(tests::takeGlError() == GL_NO_ERROR);
  }
  Shelf swapped = good; // each program under the key of another
  std::vector<std::uint8_t> last = swapped.held.rbegin()->second;
  for (auto& entry : swapped.held)
    std::swap(entry.second, last);
  CHECK(same(drawFrames(stage, *effectWith(context, swapped.store())), expected));
  CHECK(same(swapped.held, good.held));
}

TEST_CASE("program store: binaries that the driver refuses are compiled anew") {
  if (!hasBinaries()) return;
  FaultyContext context;
  Stage stage(tests::frameCase("epipolar, two lights, all targets"));
  Shelf shelf;
  const std::vector<tests::TargetContents> expected = drawFrames(stage, *effectWith(context, shelf.store()));
  REQUIRE_FALSE(shelf.held.empty());
  for (const Times times : {Times::From, Times::Only})
    for (int call = 1; call < kMostCalls; ++call) {
      CAPTURE(call);
      const std::unique_ptr<Effect> effect = effectWith(context, shelf.store());
      context.fail(Fault::Binary, call, times);
      const std::vector<tests::TargetContents> drawn = drawFrames(stage, *effect);
      if (!context.heal()) break;
      CHECK(same(drawn, expected));
      CHECK(tests::takeGlError() == GL_NO_ERROR);
    }
  context.forgetBinaries(); // a new driver that gives the same version
  CHECK(same(drawFrames(stage, *effectWith(context, shelf.store())), expected));
}

TEST_CASE("program store: neither asked nor filled where the driver has no binaries, or half of it is missing") {
  if (!hasBinaries()) return;
  FaultyContext context;
  Stage stage(tests::frameCase("epipolar"));
  const std::vector<tests::TargetContents> expected = drawFrames(stage, *tests::newEffect({context.loader()}));
  Shelf shelf;
  context.setBinaryFormats(0);
  CHECK(same(drawFrames(stage, *effectWith(context, shelf.store())), expected));
  CHECK(shelf.saves == 0);
  context.setBinaryFormats(1);
  for (const bool loads : {true, false}) {
    ProgramStore half = shelf.store();
    if (loads)
      half.save = nullptr;
    else
      half.load = nullptr;
    CHECK(same(drawFrames(stage, *effectWith(context, half)), expected));
  }
  CHECK(shelf.saves == 0);
  CHECK(shelf.asked.empty());
}

TEST_CASE("program store: of the context's own binaries") {
  Shelf shelf;
  Config config;
  config.loader = tests::testContext().loader();
  config.programs = shelf.store();
  Stage stage(tests::frameCase("epipolar, two lights"));
  const CreateResult first = Effect::create(config), second = Effect::create(config);
  REQUIRE(first.effect);
  REQUIRE(second.effect);
  const std::vector<tests::TargetContents> expected = drawFrames(stage, *first.effect);
  const int saves = shelf.saves;
  GLint formats = 0;
  if (tests::testContext().glVersion() >= 41 || hasExtension("GL_ARB_get_program_binary"))
    host::gl().GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
  CHECK((saves > 0) == (formats > 0));
  CHECK(same(drawFrames(stage, *second.effect), expected));
  CHECK(shelf.saves == saves);
}
