// The table of passes beside their shaders. That a row names all that its programs sample is checked whenever a frame
// is planned.
#include "gl/ShaderSources.h"
#include "plan/Passes.h"
#include "support/Catch.h"

#include <regex>
#include <set>
#include <string>

using namespace tyndall;

namespace {

std::set<std::string> samplersOf(const std::string& file) {
  static const std::regex kSampler("uniform\\s+[iu]?sampler\\w+\\s+(\\w+)\\s*;");
  const std::string text = shaderSource(file);
  std::set<std::string> names;
  for (std::sregex_iterator at(text.begin(), text.end(), kSampler), end; at != end; ++at)
    names.insert((*at)[1]);
  return names;
}

std::string nameOf(const Read& read) { return read.as ? read.as : samplerOf(read.resource); }

} // namespace

TEST_CASE("a pass can read all that its row says") {
  for (int i = 0; i < static_cast<int>(Pass::Count); ++i) {
    const auto pass = static_cast<Pass>(i);
    const PassRow& row = rowOf(pass);
    CAPTURE(i, row.name, row.fragment);
    CHECK(row.pass == pass);
    std::set<std::string> sampled = samplersOf(row.fragment);
    const std::set<std::string> ofVertex = samplersOf(variantOf(pass, {}, {}).vertex);
    sampled.insert(ofVertex.begin(), ofVertex.end());
    for (const Read& read : row.reads) {
      CAPTURE(nameOf(read));
      CHECK(sampled.count(nameOf(read)) == 1);
    }
  }
}

TEST_CASE("what a pass writes is a resource of the effect's own, and of one size") {
  Extent extent;
  extent.width = 640;
  extent.height = 360;
  extent.slices = 100;
  extent.samples = 128;
  extent.tableRows = 14;
  extent.rowTexels = extent.drawnTexels = 1024;
  extent.rowRoom = extent.rows = 100;
  extent.treeLevels = 4;
  extent.curveCells = 64;
  extent.terms = 4;
  extent.lowRankSets = 1;
  for (int i = 0; i < static_cast<int>(Pass::Count); ++i) {
    const PassRow& row = rowOf(static_cast<Pass>(i));
    CAPTURE(i, row.name);
    CHECK((row.into == Into::Own) == !row.writes.empty());
    for (const Resource resource : row.writes) {
      CAPTURE(rowOf(resource).name);
      CHECK(rowOf(resource).wide.internal != 0);
      const Size size = rowOf(resource).size(extent), first = rowOf(row.writes.front()).size(extent);
      CHECK(size.width == first.width);
      CHECK(size.height == first.height);
    }
  }
}
