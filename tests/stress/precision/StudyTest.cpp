// What the precision study stands on, and that no row of the table of targets is without its line in the README.
#include "Study.h"
#include "RoundingContext.h"
#include "Scenes.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

using namespace precision;

namespace {

float nearest(float value, Format format, int channel = 0, const Range& range = {}) {
  return rounded(value, format, channel, Direction::Nearest, range);
}

// The cells of the committed table's lines.
std::vector<std::vector<std::string>> committedLines() {
  std::ifstream in(TYNDALL_STUDY);
  REQUIRE(in);
  std::vector<std::vector<std::string>> lines;
  bool isInside = false;
  for (std::string text; std::getline(in, text);) {
    if (text.rfind("| line |", 0) == 0) isInside = true;
    if (text.empty()) isInside = false;
    if (!isInside) continue;
    std::vector<std::string> cells;
    std::istringstream stream(text.substr(1));
    for (std::string cell; std::getline(stream, cell, '|');)
      cells.push_back(cell.size() > 2 ? cell.substr(1, cell.size() - 2) : "");
    lines.push_back(cells);
  }
  if (lines.size() > 2) lines.erase(lines.begin(), lines.begin() + 2);
  return lines;
}

// GL leaves it to drivers how halves are rounded.
Direction roundingOfHalves() {
  const host::GlTexture texture = tests::floatTexture(GL_RGBA32F, 1, 1, {1 + 0x1.8p-11F, 0, 0, 0});
  host::GlTexture half = host::makeTexture2D(GL_RGBA16F, 1, 1);
  const host::GlFramebuffer from = host::makeFramebuffer(), to = host::makeFramebuffer();
  host::gl().BindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
  host::gl().FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
  host::gl().BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.name());
  host::gl().FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, half.name(), 0);
  host::gl().BlitFramebuffer(0, 0, 1, 1, 0, 0, 1, 1, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  host::gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  return host::readColour(half.name(), 1, 1)[0] == 1 ? Direction::ToZero : Direction::Nearest;
}

const Scene& sceneNamed(const std::vector<Scene>& scenes, const std::string& name) {
  const auto found = std::find_if(scenes.begin(), scenes.end(), [&](const Scene& scene) { return scene.name == name; });
  REQUIRE(found != scenes.end());
  return *found;
}

} // namespace

TEST_CASE("numbers are rounded as texture formats round them") {
  const float infinity = std::numeric_limits<float>::infinity();
  CHECK(nearest(1 + 1.0F / 4096, Format::Half) == 1);
  CHECK(nearest(1 + 3.0F / 4096, Format::Half) == 1 + 1.0F / 1024);
  CHECK(nearest(65520, Format::Half) == infinity);
  CHECK(nearest(-65504, Format::Half) == -65504);
  CHECK(nearest(0x1.8p-24F, Format::Half) == 0x1p-23F); // to the even one
  CHECK(nearest(0x1p-26F, Format::Half) == 0);
  CHECK(nearest(1 + 0x1p-18F, Format::Float24) == 1);
  CHECK(nearest(1 + 0x1p-16F, Format::Float24) == 1 + 0x1p-16F);
  CHECK(nearest(1e30F, Format::Float24) == infinity);
  CHECK(nearest(1 + 1.0F / 64, Format::Packed11, 0) == 1 + 1.0F / 64);
  CHECK(nearest(1 + 1.0F / 64, Format::Packed11, 2) == 1);
  CHECK(nearest(-1, Format::Packed11) == 0);
  CHECK(nearest(1e9F, Format::Packed11, 0) == 65024);
  CHECK(nearest(0.4F, Format::Unorm16) == 26214.0F / 65535);
  CHECK(nearest(2, Format::Unorm16) == 1);
  CHECK(nearest(5, Format::Unorm16, 0, {3, 9}) == Approx(5).margin(6.0 / 65535));
  CHECK(std::isnan(nearest(NAN, Format::Half)));
  for (int code = 0; code <= 65535; code += 257) // nothing is rounded twice
    for (const Direction direction : {Direction::Down, Direction::Up}) {
      const float value = static_cast<float>(code) / 65535;
      CHECK(rounded(value, Format::Unorm16, 0, direction, {}) == value);
    }
  for (const Format format : {Format::Half, Format::Unorm16, Format::Float24, Format::Packed11}) {
    CHECK(rounded(0.3F, format, 0, Direction::Down, {}) < 0.3F);
    CHECK(rounded(0.3F, format, 0, Direction::Up, {}) > 0.3F);
  }
}

TEST_CASE("rounding by the loader to what the effect stores gives the effect's picture") {
  const std::vector<Scene> scenes = studyScenes();
  RoundingContext context;
  tyndall::Config config;
  config.loader = context.loader();
  const auto wide = tests::newEffect(config), plain = tests::newEffect();
  for (const char* name : {"sun", "sun, coloured", "lamp, coloured"}) {
    CAPTURE(name);
    const Scene& scene = sceneNamed(scenes, name);
    const reference::Image stored = scene.draw(*plain);
    std::map<Target, Rounding> stored16;
    for (const char* target : {"marched", "extra", "extra second", "epipolar inscatter"})
      stored16[{target, "RGBA16F"}] = {Format::Half, false, roundingOfHalves()};
    stored16[{"row depths", "RGBA16"}] = {Format::Unorm16, false, Direction::Nearest};
    for (const char* target : {"row nodes", "row tree"})
      stored16[{target, "RGBA16"}] = {Format::Unorm16, true, Direction::Nearest};
    for (const char* target : {"row node means", "row means"})
      stored16[{target, "RG16"}] = {Format::Unorm16, false, Direction::Nearest};
    context.round(stored16);
    const reference::Image rounded = scene.draw(*wide);
    context.round({});
    const reference::ErrorMetrics same = reference::compare(rounded, stored);
    const reference::ErrorMetrics different = reference::compare(scene.draw(*wide), stored);
    CAPTURE(same.text(), different.text());
    CHECK(same.max <= 1e-6);
    CHECK(different.rRmse > 5e-6);
  }
}

TEST_CASE("every target has a line of the committed precision study for each format") {
  const std::vector<std::vector<std::string>> committed = committedLines();
  CHECK(committed.size() == studyLines().size());
  for (const Line& line : studyLines()) {
    CAPTURE(line.name, line.format);
    const auto found = std::find_if(committed.begin(), committed.end(), [&](const auto& cells) {
      return cells.size() >= 9 && cells[0] == line.name && cells[1] == line.format;
    });
    REQUIRE(found != committed.end());
    CHECK(std::stoi((*found)[3]) > 0); // scenes that use it
  }
}

TEST_CASE("the precision study, into precision.md and precision.csv", "[.][study]") {
  std::ofstream csv("precision.csv"), text("precision.md");
  text << markdown(runStudy(csv));
  REQUIRE(text.flush());
  REQUIRE(csv.flush());
}
