// What is learned of how long bands take (BandPaces.h), from a clock of the test's own.
#include "BandPaces.h"
#include "support/Catch.h"

#include <algorithm>
#include <map>
#include <vector>

using namespace tyndall;

namespace {

// A GPU: time passes when the test says so, and queries are known from `known` on.
struct Gpu {
  double milliseconds = 1;
  bool stands = false; // its clock
  bool known = true;
  int made = 0, early = 0; // queries, and results that were asked for before they were known
  std::map<gl::Uint, double> stamps;
};
Gpu gpu;

gl::Functions functions() {
  gpu = {};
  gl::Functions gl;
  gl.GenQueries = [](gl::Sizei, gl::Uint* name) { *name = static_cast<gl::Uint>(++gpu.made); };
  gl.DeleteQueries = [](gl::Sizei, const gl::Uint*) {};
  gl.QueryCounter = [](gl::Uint name, gl::Enum) { gpu.stamps[name] = gpu.stands ? 0 : gpu.milliseconds; };
  gl.GetQueryObjectui64v = [](gl::Uint name, gl::Enum what, gl::Uint64* value) {
    if (what == gl::QUERY_RESULT && !gpu.known) ++gpu.early;
    *value =
        what == gl::QUERY_RESULT_AVAILABLE ? (gpu.known ? 1 : 0) : static_cast<gl::Uint64>(1e6 * gpu.stamps.at(name));
  };
  return gl;
}

// A frame with one draw, whose bands are estimated to take a millisecond each.
void draw(BandPaces& paces, const std::vector<double>& bands, const char* title = "exact") {
  paces.beginFrame();
  paces.begin(title, 1, static_cast<int>(bands.size()));
  for (const double milliseconds : bands) {
    gpu.milliseconds += milliseconds;
    paces.endBand();
  }
}

void drawFrames(BandPaces& paces, const std::vector<double>& bands, int count) {
  for (int i = 0; i < count; ++i)
    draw(paces, bands);
}

constexpr int kLate = 1; // frames until a result is looked at, if it is known

} // namespace

TEST_CASE("a pace is that of the slowest band, and of that draw only") {
  const gl::Functions gl = functions();
  BandPaces paces(gl);
  CHECK(paces.of("exact") == 1);
  draw(paces, {1, 3, 2});
  CHECK(paces.of("exact") == 1);
  drawFrames(paces, {1}, kLate);
  CHECK(paces.of("exact") == Approx(3));
  CHECK(paces.of("light 0 fix-up") == 1);
}

TEST_CASE("a pace grows at once, falls bit by bit, and stays within its bounds") {
  const gl::Functions gl = functions();
  BandPaces paces(gl);
  drawFrames(paces, {0.001}, kLate + 1);
  CHECK(paces.of("exact") == Approx(0.8));
  drawFrames(paces, {0.001}, 1);
  CHECK(paces.of("exact") == Approx(0.64));
  drawFrames(paces, {0.001}, 20);
  CHECK(paces.of("exact") == BandPaces::kLeast);
  drawFrames(paces, {5}, 1);
  drawFrames(paces, {0.5}, kLate);
  CHECK(paces.of("exact") == Approx(5));
  drawFrames(paces, {1e6}, kLate + 1);
  CHECK(paces.of("exact") == BandPaces::kMost);
}

TEST_CASE("many bands are timed by eights of a draw, its slowest counts") {
  const gl::Functions gl = functions();
  for (const int count : {8, 9, 17, 64, 1000}) {
    BandPaces paces(gl);
    const int before = gpu.made;
    std::vector<double> bands(static_cast<std::size_t>(count), 1);
    std::fill(bands.begin() + count / 2, bands.end(), 2);
    drawFrames(paces, bands, 5);
    CAPTURE(count);
    CHECK(paces.of("exact") >= 1.5);
    CHECK(paces.of("exact") <= 2.0001);
    CHECK(gpu.made - before == 9 * 4);
  }
}

TEST_CASE("nothing is learned from a clock that stands, nor from what is not known yet, which nothing asks for") {
  const gl::Functions gl = functions();
  BandPaces paces(gl);
  gpu.stands = true;
  drawFrames(paces, {4}, 8);
  CHECK(paces.of("exact") == 1);
  gpu.stands = false;
  gpu.known = false;
  drawFrames(paces, {4}, 8);
  CHECK(paces.of("exact") == 1);
  CHECK(gpu.early == 0);
  gpu.known = true;
  drawFrames(paces, {4}, kLate + 1);
  CHECK(paces.of("exact") == Approx(4));
}

TEST_CASE("several draws of one title count as their slowest, once a frame") {
  const gl::Functions gl = functions();
  BandPaces paces(gl);
  for (int i = 0; i < kLate + 1; ++i) {
    paces.beginFrame();
    for (const double milliseconds : {0.01, 0.01, 0.01}) {
      paces.begin("light 0 march", 1, 1);
      gpu.milliseconds += milliseconds;
      paces.endBand();
    }
  }
  CHECK(paces.of("light 0 march") == Approx(0.8));
}

TEST_CASE("frames like those before make no query") {
  const gl::Functions gl = functions();
  BandPaces paces(gl);
  drawFrames(paces, {1, 1}, 8);
  const int made = gpu.made;
  drawFrames(paces, std::vector<double>(300, 1), 8); // in more bands, too
  CHECK(gpu.made == made);
}
