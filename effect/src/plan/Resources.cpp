#include "plan/Resources.h"

#include "Rounding.h"
#include "SharedBlocks.h"

#include <tyndall/tyndall.h>

#include <algorithm>
#include <cctype>

namespace tyndall {

namespace {

using E = const Extent&;
using Format = TexelFormat;

constexpr Format kGiven{}, kR8{gl::R8, 1}, kR32{gl::R32F, 4}, kRg32{gl::RG32F, 8}, kRgba32{gl::RGBA32F, 16},
    kRgba16{gl::RGBA16F, 8}, kUnorm2{gl::RG16, 4}, kUnorm4{gl::RGBA16, 8}, kRgba8{gl::RGBA8, 4};

constexpr int kChunk = 64;

bool always(E) { return true; }
bool wideColour(E e) { return e.wideColour; }
bool floatTint(E e) { return e.floatTint; }
bool coloured(E e) { return e.coloured; }
bool floatRows(E e) { return e.floatRows; }
bool glass(E e) { return e.glass; }
bool shares(E e) { return e.shares; }
bool hashes(E e) { return e.hashes; }

int treeNodes(int texels, int finest, int levels) {
  int nodes = 0;
  for (int level = finest; level <= levels; ++level)
    nodes += texels >> (2 * level);
  return nodes;
}

// Nodes of all levels, down to one node over all cells; at least one, so that there is a texture.
int curveNodes(int cells) {
  int nodes = 0;
  for (int level = 1, count = cells; count > 1; ++level) {
    count = (cells + (1 << (2 * level)) - 1) >> (2 * level);
    nodes += count;
  }
  return std::max(nodes, 1);
}

Size none(E) { return {}; }
Size image(E e) { return {e.width, e.height}; }
Size sideBySide(E e) { return {e.width << ((e.sampleShift + 1) / 2), e.height << (e.sampleShift / 2)}; }
Size table(E e) { return {e.slices, e.tableRows}; }
Size samples(E e) { return {e.slices, e.samples}; }
Size chunks(E e) { return {e.slices, e.samples / kChunk}; }
Size chunksAndSum(E e) { return {e.slices, e.samples / kChunk + 1}; }
Size segments(E e) { return {e.slices, e.samples / kSegmentSamples}; }
Size segmentEnds(E e) { return {e.slices, e.samples / kSegmentSamples + 1}; }
Size twos(E e) { return {e.slices, e.samples / 2}; }
Size slices(E e) { return {e.slices, 1}; }
Size slicesAndRows(E e) { return {e.slices, e.tableRows / 2}; }
Size one(E) { return {1, 1}; }
Size candidateSlices(E e) { return {e.candidateSlices, e.tableRows}; }
Size blocks(E e) { return {e.candidateSlices / SLICE_BLOCK, 1}; }
Size blocksAndSum(E e) { return {e.candidateSlices / SLICE_BLOCK + 1, 1}; }
Size budgets(E) { return {SLICE_BUDGETS, 1}; }
Size codes(E) { return {ESTIMATE_CODES, 1}; }
Size imageRows(E e) { return {e.height, 1}; }

Size lookup(E e) {
  return {LOOKUP_COLUMNS * e.lookup.width, e.lookup.height * unitsFor(e.lookupDepths, LOOKUP_COLUMNS)};
}
Size mapCopy(E e) { return e.mapCopy; }

Size groups(E e) { return {e.rowTexels / 4, e.rowRoom}; }
Size drawnGroups(E e) { return {e.drawnTexels / 4, e.rows}; }
Size nodes(E e) { return {e.rowTexels / 16, e.rowRoom}; }
Size drawnNodes(E e) { return {e.drawnTexels / 16, e.rows}; }
Size tree(E e) { return {treeNodes(e.rowTexels, 2, e.treeLevels), e.rowRoom}; }
Size drawnTree(E e) { return {treeNodes(e.drawnTexels, 2, e.treeLevels), e.rows}; }
Size pairs(E e) { return {treeNodes(e.rowTexels, 1, e.treeLevels), e.rowRoom}; }
Size cells(E e) { return {e.curveCells, e.rowRoom}; }
Size drawnCells(E e) { return {e.curveCells, e.rows}; }
Size cellTree(E e) { return {curveNodes(e.curveCells), e.rowRoom}; }
Size drawnCellTree(E e) { return {curveNodes(e.curveCells), e.rows}; }
Size parts(E e) { return {unitsFor(e.rowTexels, kPartTexels), e.rowRoom}; }
Size drawnParts(E e) { return {unitsFor(e.drawnTexels, kPartTexels), e.rows}; }

Size lowRankRays(E e) { return {64, e.terms}; }
Size lowRankLights(E e) { return {e.lowRankSets, 2 * e.terms * 64}; }
Size tints(E e) { return {e.rowTexels >> (2 * e.tintLevel + 2), unitsFor(e.terms, 4) * e.rowRoom}; }
Size drawnTints(E e) { return {e.drawnTexels >> (2 * e.tintLevel + 2), unitsFor(e.terms, 4) * e.rowRoom}; }

Size checks(E) { return {CHECK_WIDTH, 2 * CHECK_HEIGHT * kMaxLights}; }
Size tiles(E e) { return {kTilesAcross, unitsFor(tilesOf(e), kTilesAcross)}; }

// In the order of the enumerators. What each format costs the picture, and what others would: the line that the row
// names last, in tests/stress/precision/README.md.
constexpr ResourceRow kRows[] = {
    {"scene depth", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "the engine's"},
    {"scene depth samples", kGiven, kGiven, always, always, none, none, Lifetime::Frame,
     "the engine's, if multisampled"},
    {"scene depth side by side", kGiven, kGiven, always, always, none, none, Lifetime::Frame,
     "the engine's, if it is not, or plain depth"},
    {"engine depth", kGiven, kGiven, always, always, none, none, Lifetime::Frame,
     "the engine's, where it is not what passes read"},
    {"shadow map", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "the engine's"},
    {"glass colour", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "the engine's"},
    {"glass depth", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "the engine's"},
    {"curves", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "smoke and hair: Light::curves"},
    {"eye curves", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "the same before the eye"},
    {"occlusion", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "Ambient::occlusion"},
    {"image", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "what a pass copies or shows"},
    {"empty", kR32, kR32, always, always, one, one, Lifetime::Frame, "what a sampler reads that has nothing to read"},
    {"plain depth", kR32, kR32, always, always, sideBySide, sideBySide, Lifetime::Frame,
     "the scene depth out of a larger, smaller, layered or encoded one; of several samples side by side",
     "scene depth"},
    {"one depth", kRg32, kRg32, always, always, image, image, Lifetime::Frame,
     "multisampled depth: one of a pixel's samples, and whether they differ", "scene depth"},
    {"sample depth", kR32, kR32, always, always, image, image, Lifetime::Frame,
     "the same: of one sample, where a pixel's differ", "scene depth"},
    {"edge inscatter", kRgba32, kRgba32, always, always, image, image, Lifetime::Frame,
     "the same: what unwarp makes of those", "inscatter"},
    {"edge transmittance", kRgba32, kRgba32, always, always, image, image, Lifetime::Frame, "the same",
     "transmittance"},
    {"edge rest", kRg32, kRg32, always, always, image, image, Lifetime::Frame, "the same: samples that no slice serves",
     "edge rest"},
    {"shadow copy", kR32, kR32, always, always, mapCopy, mapCopy, Lifetime::Light,
     "shadow maps that are cubes, hold other than window depth, or are seldom so: a layer for each view", "map depth"},
    {"glass colour copy", kRgba32, kRgba8, floatTint, glass, mapCopy, mapCopy, Lifetime::Light, "the same of glass",
     "glass colour"},
    {"glass depth copy", kR32, kR32, always, glass, mapCopy, mapCopy, Lifetime::Light, "the same of glass",
     "map depth"},
    {"inscatter", kRgba32, kRgba32, always, always, image, image, Lifetime::Eye,
     "where the engine wants its own transmittance and a composite", "inscatter"},
    {"transmittance", kRgba32, kRgba32, always, always, image, image, Lifetime::Eye,
     "where the engine wants its own inscatter and a composite", "transmittance"},
    {"colour copy", kRgba32, kRgba16, wideColour, always, image, image, Lifetime::Frame,
     "what the composite blends with, where not by dual-source blending", "colour"},
    {"stand in colour", kGiven, kGiven, always, always, image, image, Lifetime::Frame,
     "what stands in for the engine's, whose format it has"},
    {"stand in inscatter", kGiven, kGiven, always, always, image, image, Lifetime::Frame, "the same"},
    {"stand in transmittance", kGiven, kGiven, always, always, image, image, Lifetime::Frame, "the same"},
    {"slice table", kRgba32, kRgba32, always, always, table, table, Lifetime::Light,
     "the slices' geometry, computed in double", "slice table"},
    {"candidate table", kRgba32, kRgba32, always, always, candidateSlices, candidateSlices, Lifetime::Frame,
     "the same where not all are drawn (Settings::errorTarget)", "slice table"},
    {"sample ends", kR32, kR32, always, always, samples, samples, Lifetime::Compared,
     "distance along the camera ray; float, for breaks and the march", "sample ends"},
    {"marks", kUnorm4, kUnorm4, always, always, chunks, chunks, Lifetime::Frame, "four masks of 16 samples", "marks"},
    {"refined marks", kUnorm4, kUnorm4, always, always, chunks, chunks, Lifetime::Frame,
     "the marks with the refinement's", "marks"},
    {"marched", kRgba16, kR32, coloured, always, segmentEnds, segmentEnds, Lifetime::Light,
     "light of the regular march samples, in no unit (lib/stored.glsl)", "marched"},
    {"slice sums", kRg32, kRg32, always, always, slices, slices, Lifetime::Frame, "inscatter over each slice", "sums"},
    {"mean light", kR32, kR32, always, always, one, one, Lifetime::Frame, "the picture's mean inscatter", "sums"},
    {"slice errors", kRgba32, kRgba32, always, always, slices, slices, Lifetime::Frame,
     "Settings::errorTarget: what slices differ by from what others lead to expect", "slice choice"},
    {"slice spacing", kRgba32, kRgba32, always, always, blocks, blocks, Lifetime::Frame,
     "the same: the error expected of eight with one, and how fast it falls", "slice choice"},
    {"slice budget", kRgba32, kRgba32, always, always, budgets, budgets, Lifetime::Frame,
     "the same: what prices of slices take, and the error that they leave", "slice choice"},
    {"slice blocks", kRgba32, kRgba32, always, always, blocksAndSum, blocksAndSum, Lifetime::Frame,
     "the same: the columns of eight slices", "slice choice"},
    {"slice estimate", kRg32, kRg32, always, always, one, one, Lifetime::Frame,
     "the same: what the picture is off by for want of slices", "slice choice"},
    {"estimate codes", kR8, kR8, always, always, codes, codes, Lifetime::Frame, "the same, as fragments to be counted",
     "slice choice"},
    {"extra offsets", kR32, kR32, always, always, chunksAndSum, chunksAndSum, Lifetime::Frame,
     "where a chunk's extra samples are packed", "extra offsets"},
    {"extra", kRgba16, kRg32, coloured, always, twos, twos, Lifetime::Frame,
     "as marched, of the march samples between, packed: the first of two, or both if they are grey", "extra"},
    {"extra second", kRgba16, kRgba16, always, coloured, twos, twos, Lifetime::Frame, "the second of two", "extra"},
    {"epipolar inscatter", kRgba16, kRg32, coloured, always, samples, samples, Lifetime::Light,
     "the same of all samples, with their distance", "epipolar inscatter"},
    {"unserved", kR8, kR8, always, always, image, image, Lifetime::Frame, "fix-up by tiles: pixels that unwarp left",
     "flags"},
    {"unserved tiles", kR32, kR32, always, always, tiles, tiles, Lifetime::Frame, "the same: tiles that hold one",
     "flags"},
    {"lookup steps", kRgba32, kRgba32, always, always, lookup, lookup, Lifetime::Frame,
     "light between layers of Frame::lookup, which are then sums"},
    {"row depths", kRgba32, kUnorm4, floatRows, always, groups, drawnGroups, Lifetime::ComparedRows,
     "the shadow map along each slice", "row depths"},
    {"row shares", kUnorm4, kUnorm2, glass, shares, groups, drawnGroups, Lifetime::ComparedRows,
     "how much is lit behind a group's split; filtered or glass", "row shares"},
    {"row nodes", kRgba32, kUnorm4, floatRows, always, nodes, drawnNodes, Lifetime::Frame,
     "the tree's finest level, to gather the others from", "row bounds"},
    {"row node means", kUnorm4, kUnorm2, glass, always, nodes, drawnNodes, Lifetime::Frame,
     "the same: averages; with glass, means", "row means"},
    {"row node moments", kUnorm4, kUnorm4, always, glass, nodes, drawnNodes, Lifetime::Frame,
     "the same with glass: first moments", "row moments"},
    {"row tree", kRgba32, kUnorm4, floatRows, always, tree, drawnTree, Lifetime::LightRows,
     "all levels of the tree: where depths split", "row bounds"},
    {"row means", kUnorm4, kUnorm2, glass, always, tree, drawnTree, Lifetime::LightRows,
     "the same: averages; with glass, means", "row means"},
    {"row moments", kUnorm4, kUnorm4, always, glass, tree, drawnTree, Lifetime::LightRows,
     "the same with glass: first moments", "row moments"},
    {"pair tree", kRg32, kUnorm2, floatRows, always, pairs, pairs, Lifetime::Frame,
     "the same over two neighbouring rows, for rays between them", "pair bounds"},
    {"curve cells", kRgba32, kRgba32, always, always, cells, drawnCells, Lifetime::LightRows,
     "smoke and hair along each slice", "curves"},
    {"curve tree", kRgba32, kRgba32, always, always, cellTree, drawnCellTree, Lifetime::LightRows, "a tree over them",
     "curves"},
    {"low rank rays", kRgba32, kRgba32, always, always, lowRankRays, lowRankRays, Lifetime::Frame,
     "factors of camera rays", "low rank rays"},
    {"low rank lights", kRgba32, kRgba32, always, always, lowRankLights, lowRankLights, Lifetime::Frame,
     "the same of light rays, and their prefix sums", "low rank lights"},
    {"tint red", kRgba32, kRgba32, always, always, tints, drawnTints, Lifetime::Frame,
     "low rank with glass: terms times tints, of groups of 4, 16, ... texels", "tints"},
    {"tint green", kRgba32, kRgba32, always, always, tints, drawnTints, Lifetime::Frame, "the same in green", "tints"},
    {"tint blue", kRgba32, kRgba32, always, always, tints, drawnTints, Lifetime::Frame, "the same in blue", "tints"},
    {"tint sums red", kRgba32, kRgba32, always, always, tints, drawnTints, Lifetime::Frame,
     "their prefix sums along each row", "tint sums"},
    {"tint sums green", kRgba32, kRgba32, always, always, tints, drawnTints, Lifetime::Frame, "the same in green",
     "tint sums"},
    {"tint sums blue", kRgba32, kRgba32, always, always, tints, drawnTints, Lifetime::Frame, "the same in blue",
     "tint sums"},
    {"row hashes", kRg32, kRg32, always, hashes, groups, drawnGroups, Lifetime::ComparedRows,
     "temporal reuse: all that decides along a row; filtered or glass", "row hashes"},
    {"last sample ends", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "the same: the last frame's"},
    {"last row depths", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "the same: the last frame's"},
    {"last row hashes", kGiven, kGiven, always, always, none, none, Lifetime::Frame, "the same: the last frame's"},
    {"changed parts", kRg32, kRg32, always, always, parts, drawnParts, Lifetime::Frame,
     "the same: depths between which 256 texels of a row differ from the last frame's", "changed parts"},
    {"changed ends", kR32, kR32, always, always, segments, segments, Lifetime::Frame,
     "the same: segments with other ends than in the last frame", "changed segments"},
    {"changed segments", kR32, kR32, always, always, segments, segments, Lifetime::Light,
     "the same: those to be drawn anew", "changed segments"},
    {"changed slices", kRgba32, kRgba32, always, always, slices, slices, Lifetime::Light,
     "the same: from which segment to which, of eight slices", "changed slices"},
    {"moved slices", kRgba32, kRgba32, always, always, slicesAndRows, slicesAndRows, Lifetime::Light,
     "the same: those to be compared, and of the rows in each shadow view which texels", "changed slices"},
    {"moved ends", kRgba32, kRgba32, always, always, slices, slices, Lifetime::Frame,
     "the same: of which segments the ends", "changed slices"},
    {"changed tiles", kR32, kR32, always, always, tiles, tiles, Lifetime::Frame, "the same: squares of 16 x 16 pixels",
     "flags"},
    {"last depth", kR32, kR32, always, always, image, image, Lifetime::Eye,
     "the same: the last frame's scene depth, where it is compared", "scene depth"},
    {"input checks", kRgba8, kRgba8, always, always, checks, checks, Lifetime::Frame,
     "Config::checkInputs: what scene depth and each light's shadow map say of each other"},
    {"debug view", kRgba32, kRgba32, always, always, image, image, Lifetime::Frame,
     "debug views of slices: what is counted or shown, until all lights are done", "debug"},
    {"debug exact", kRgba32, kRgba32, always, always, image, image, Lifetime::Frame,
     "debug view of the difference: exact's inscatter", "debug"},
    {"debug row means", kRgba32, kRgba32, always, always, imageRows, imageRows, Lifetime::Frame,
     "the same, or visits: mean over each row of pixels", "debug"},
    {"debug mean", kR32, kR32, always, always, one, one, Lifetime::Frame, "the same: their mean", "debug"},
};
static_assert(sizeof kRows / sizeof *kRows == static_cast<std::size_t>(Resource::Count), "a row for each resource");

} // namespace

int tilesOf(const Extent& e) { return unitsFor(e.width, kTile) * unitsFor(e.height, kTile); }

const ResourceRow& rowOf(Resource resource) { return kRows[static_cast<std::size_t>(resource)]; }

namespace {

TexelFormat ofEngines(gl::Enum internal) {
  switch (internal) {
  case gl::RGBA32F:
    return kRgba32;
  case gl::RGB32F:
    return {internal, 12};
  case gl::RGB16F:
    return {internal, 6};
  case gl::R11F_G11F_B10F:
    return {internal, 4};
  default:
    return kRgba16;
  }
}

} // namespace

TexelFormat formatOf(Resource resource, E e) {
  const ResourceRow& row = rowOf(resource);
  switch (resource) {
  case Resource::StandInColour:
    return ofEngines(e.engines[0]);
  case Resource::StandInInscatter:
    return ofEngines(e.engines[1]);
  case Resource::StandInTransmittance:
    return ofEngines(e.engines[2]);
  default:
    return row.isWide(e) ? row.wide : row.narrow;
  }
}

std::string samplerOf(Resource resource) {
  std::string name;
  bool capital = false;
  for (const char* c = rowOf(resource).name; *c; ++c) {
    if (*c != ' ') name += capital ? static_cast<char>(std::toupper(static_cast<unsigned char>(*c))) : *c;
    capital = *c == ' ';
  }
  return name;
}

} // namespace tyndall
