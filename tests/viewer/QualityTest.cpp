#include "../settings/RandomState.h"
#include "support/Catch.h"

#include <set>
#include <settings/Tables.h>
#include <viewer/core/Bands.h>
#include <viewer/core/Quality.h>

TEST_CASE("frames that are too slow lower the quality, fast ones raise it") {
  viewer::Quality quality;
  quality.setTarget(50);
  for (int i = 0; i < 20; ++i)
    quality.drew(200);
  CHECK(quality.level() == viewer::qualityLevels() - 1);
  for (int i = 0; i < 7; ++i)
    quality.drew(10);
  quality.drew(40); // neither
  CHECK(quality.level() == viewer::qualityLevels() - 1);
  for (int i = 0; i < 200; ++i)
    quality.drew(10);
  CHECK(quality.level() == 0);
}

TEST_CASE("no level is better than the state, and all of it keeps its rules") {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const settings::State state = tests::randomState(seed);
    for (int level = 0; level < viewer::qualityLevels(); ++level) {
      const settings::State fast = viewer::atLevel(state, level);
      CAPTURE(seed, level);
      CHECK(fast.width <= state.width);
      CHECK(fast.height <= state.height);
      CHECK(fast.shadowSize <= state.shadowSize);
      CHECK(fast.settings.slices <= state.settings.slices);
      CHECK(contradictionIn(fast).empty());
      settings::visitTables(fast, [](const char*, const auto& part, const auto& table) {
        for (const auto& row : table.rows)
          CHECK(breachOf(row, row.get(part)).empty());
      });
      if (level == 0) CHECK(tests::differences(fast, state) == std::vector<std::string>());
    }
  }
}

TEST_CASE("bands cover a picture once, whatever their size") {
  for (const double pixels : {0.2, 1.0, 7.0, 10.0, 25.0, 33.3, 1e12}) {
    viewer::Bands bands(10, 6);
    std::multiset<int> covered;
    while (!bands.isDone()) {
      const tyndall::Rectangle part = bands.next(pixels);
      REQUIRE(part.width > 0);
      REQUIRE(part.height > 0);
      CHECK(part.width * part.height <= std::max(pixels, 1.0));
      for (int y = part.y; y < part.y + part.height; ++y)
        for (int x = part.x; x < part.x + part.width; ++x)
          covered.insert(10 * y + x);
    }
    CAPTURE(pixels);
    CHECK(bands.share() == 1);
    CHECK(covered.size() == 60);
    CHECK(std::set<int>(covered.begin(), covered.end()).size() == 60);
  }
}

TEST_CASE("steps come to take the time that they may") {
  viewer::Pace pace;
  const double perPixel = 0.003; // milliseconds
  for (int i = 0; i < 12; ++i) {
    const double pixels = pace.pixelsFor(30);
    pace.took(pixels, pixels * perPixel);
  }
  CHECK(pace.pixelsFor(30) * perPixel == Approx(30).epsilon(0.01));
}
