// The table of textures: its rows by name, and the sizes that follow from a frame's (plan/Resources.h).
#include "plan/Resources.h"
#include "support/Catch.h"

#include <cctype>
#include <fstream>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using namespace tyndall;

namespace {

// From the header: the enumerators of Resource, in order.
std::vector<std::string> resourceNames() {
  std::ifstream in(TYNDALL_RESOURCES_H);
  REQUIRE(in);
  std::stringstream text;
  text << in.rdbuf();
  std::string body = text.str();
  body = body.substr(body.find("enum class Resource {") + 21);
  body = std::regex_replace(body.substr(0, body.find('}')), std::regex("//[^\n]*"), "");
  std::vector<std::string> names;
  const std::regex word("\\w+");
  for (std::sregex_iterator at(body.begin(), body.end(), word), end; at != end; ++at)
    names.push_back(at->str());
  return names;
}

// As LightPlanner makes it: row textures have room for whole nodes of the coarsest level.
Extent randomExtent(std::mt19937& random) {
  const auto within = [&random](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  Extent e;
  e.width = within(1, 3000);
  e.height = within(1, 2000);
  e.slices = within(1, 2000);
  e.candidateSlices = 8 * within(1, 500);
  e.samples = 64 * within(1, 16);
  e.tableRows = 2 + 2 * within(0, 6);
  e.treeLevels = within(2, 5);
  const int unit = 1 << (2 * e.treeLevels), units = within(1, 4);
  e.rowTexels = unit * units;
  e.drawnTexels = unit * within(1, units);
  const int views = within(1, 6);
  e.rowRoom = e.slices * views;
  e.rows = e.slices * within(1, views);
  e.curveCells = within(1, 512);
  e.mapCopy = {within(1, 4096), within(1, 4096), views};
  e.lookup = {within(1, 512), within(1, 512)};
  e.lookupDepths = within(2, 64);
  e.terms = within(1, 8);
  e.lowRankSets = within(1, 2) == 1 ? 1 : e.slices;
  e.tintLevel = within(0, 2);
  return e;
}

} // namespace

TEST_CASE("each resource's row is at its place, and shaders call it by its name") {
  const std::vector<std::string> names = resourceNames();
  REQUIRE(names.size() == static_cast<std::size_t>(Resource::Count) + 1);
  for (std::size_t i = 0; i + 1 < names.size(); ++i) {
    std::string name = names[i];
    name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    CHECK(samplerOf(static_cast<Resource>(i)) == name);
  }
}

TEST_CASE("a draw fills no more of a texture than there is, and every texture has a texel") {
  std::mt19937 random(81);
  for (int trial = 0; trial < 200; ++trial) {
    const Extent extent = randomExtent(random);
    for (int i = 0; i < static_cast<int>(Resource::Count); ++i) {
      const ResourceRow& row = rowOf(static_cast<Resource>(i));
      if (row.wide.internal == 0) continue; // given
      const Size size = row.size(extent), drawn = row.drawn(extent);
      CAPTURE(trial, row.name);
      CHECK(drawn.width <= size.width);
      CHECK(drawn.height <= size.height);
      if (row.size(extent).width != extent.rowTexels >> (2 * extent.tintLevel + 2)) CHECK(size.width >= 1);
      CHECK(size.height >= 1);
    }
  }
}

TEST_CASE("trees hold one node of each four below, down to their coarsest level") {
  std::mt19937 random(82);
  for (int trial = 0; trial < 200; ++trial) {
    const Extent extent = randomExtent(random);
    int nodes = 0; // over groups of four texels: level 1 is a texel of the rows' own
    for (int below = extent.rowTexels / 4; below >= extent.rowTexels >> (2 * extent.treeLevels); below /= 4)
      nodes += below;
    CAPTURE(extent.rowTexels, extent.treeLevels);
    CHECK(rowOf(Resource::PairTree).size(extent).width == nodes);
    CHECK(rowOf(Resource::RowTree).size(extent).width == nodes - extent.rowTexels / 4);
    int cells = 0; // rounded up, since a map may have any size
    for (int below = extent.curveCells; below > 1;) {
      below = (below + 3) / 4;
      cells += below;
    }
    CAPTURE(extent.curveCells);
    CHECK(rowOf(Resource::CurveTree).size(extent).width == std::max(cells, 1));
  }
}

TEST_CASE("tiles cover an image") {
  std::mt19937 random(83);
  for (int trial = 0; trial < 200; ++trial) {
    const Extent extent = randomExtent(random);
    int tiles = 0;
    for (int y = 0; y < extent.height; y += kTile)
      for (int x = 0; x < extent.width; x += kTile)
        ++tiles;
    CHECK(tilesOf(extent) == tiles);
    const Size size = rowOf(Resource::ChangedTiles).size(extent);
    CHECK(size.width * size.height >= tiles);
    CHECK(size.width * (size.height - 1) < tiles);
  }
}
