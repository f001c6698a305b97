#include "plan/Passes.h"

#include <algorithm>
#include <tyndall/tyndall.h>

namespace tyndall {

namespace {

using R = Resource;
using O = const Occurrence&;

const Option kHashes{"ROW_HASHES", {kUndefined, 1}}, kTintSums{"TINT_SUMS", {kUndefined, 1}},
    kStripsOfRows{"STRIPS_OF_ROWS", {1}}, kSideBySide{"SIDE_BY_SIDE", {0, 1}}, kKeepsEnds{"KEEPS_ENDS", {0, 1}};
const Read kDepthSideBySide{R::SceneDepthSideBySide, "sceneDepth"};

bool blendsTwoSources(O o) { return o.light.dualSource; }
bool copiesColour(O o) { return !o.light.dualSource; }
bool isSampled(O o) { return o.light.cubeArrays || !o.has("SOURCE", 3); }
bool hasRows(O o) { return o.light.shadowViews > 0; }
bool hasCurves(O o) { return o.light.curves; }
bool hasPanes(O o) { return o.light.glass && !o.light.curves; }
bool hasRowDepths(O o) {
  return hasRows(o) && (!o.has("ROW_HASHES") || (o.light.hasShares() && !o.has("TINT_SUMS"))) &&
         (!o.has("TINT_SUMS") || hasPanes(o));
}
bool hasTree(O o) { return hasRows(o) && (!o.has("TINT_SUMS") || hasPanes(o)); }
bool hasLowRank(O o) { return !o.has("TINT_SUMS") || hasPanes(o); }
bool isDirectional(O o) { return o.light.lightKind == static_cast<int>(LightKind::Directional); }
bool isUnwarped(O o) { return !o.light.composite || !o.has("SPREAD"); }
bool comparesRows(O o) { return hasRows(o) && o.has("ROW_HASHES") == o.light.hasShares(); }

// A row as it is written down.
class Row {
public:
  Row(Pass pass, const char* name, const char* fragment, Shape shape = Shape::FullScreen)
      : row_{pass, name, fragment, shape} {}
  Row reads(const std::vector<Read>& what) const {
    return with([&](PassRow& r) { r.reads.insert(r.reads.end(), what.begin(), what.end()); });
  }
  Row readsIfThere(std::vector<Read> what) const {
    return with([&](PassRow& r) {
      for (Read& read : what) {
        read.mayLack = true;
        r.reads.push_back(read);
      }
    });
  }
  Row walksTexels() const;   ///< of the maps
  Row walksRows() const;     ///< and looks up in the maps
  Row walksOwnLine() const { // past what the rows' trees skip
    return walksRows().with([](PassRow& r) { r.walk = RayWalk::OwnLine; });
  }
  Row walksOpen() const {
    return with([](PassRow& r) { r.walk = RayWalk::Open; });
  }
  Row rays(int perFragment) const {
    return with([&](PassRow& r) { r.raysPerFragment = perFragment; });
  }
  Row writes(std::vector<R> what) const {
    return with([&](PassRow& r) { r.writes = what; });
  }
  Row into(Into where) const {
    return with([&](PassRow& r) { r.into = where; });
  }
  Row joins(Joining how) const {
    return with([&](PassRow& r) { r.joining = how; });
  }
  Row options(std::vector<Option> what) const {
    return with([&](PassRow& r) { r.options = what; });
  }
  Row when(bool (*occurs)(O)) const {
    return with([&](PassRow& r) { r.occurs = occurs; });
  }
  Row sameForAllLights() const {
    return with([](PassRow& r) { r.ofLights = false; });
  }
  operator PassRow() const { return row_; } // NOLINT(google-explicit-constructor): a row is written as what it is

private:
  template <typename Change>
  Row with(Change&& change) const {
    Row changed = *this;
    change(changed.row_);
    return changed;
  }
  PassRow row_;
};

Row Row::walksTexels() const {
  return reads({R::ShadowMap, R::GlassColour, R::GlassDepth, R::Curves, R::EyeCurves}).with([](PassRow& r) {
    r.walk = RayWalk::AllTexels;
  });
}

Row Row::walksRows() const {
  return with([](PassRow& r) {
    r.walk = RayWalk::Row;
    for (const R resource : {R::ShadowMap, R::GlassColour, R::GlassDepth, R::Curves, R::CurveCells, R::CurveTree,
                             R::EyeCurves, R::RowDepths, R::RowShares, R::RowTree, R::RowMeans, R::RowMoments})
      r.reads.emplace_back(resource);
  });
}

// In the order of the enumerators.
std::vector<PassRow> makeRows() {
  using S = Shape;
  constexpr Joining kSumOfLights = Joining::SumOfLights, kSumOfDraws = Joining::SumOfDraws;
  return {
      Row(Pass::PlainDepth, "plain depth", "passes/plainDepth.frag")
          .reads({R::EngineDepth})
          .writes({R::PlainDepth})
          .options({{"DEPTH_SOURCE", {0, 1, 2, 3}}})
          .sameForAllLights(),
      Row(Pass::Exact, "exact", "passes/exact.frag", S::Image)
          .readsIfThere({kDepthSideBySide, R::SceneDepthSamples}) // one of the two
          .walksTexels()
          .into(Into::Destination)
          .joins(kSumOfLights),
      Row(Pass::Transmittance, "transmittance", "passes/transmittance.frag", S::Image)
          .readsIfThere({kDepthSideBySide, R::SceneDepthSamples}) // one of the two
          .reads({R::EyeCurves})
          .into(Into::Destination)
          .joins(kSumOfLights),
      Row(Pass::Ambient, "ambient", "passes/ambient.frag", S::Image)
          .readsIfThere({kDepthSideBySide, R::SceneDepthSamples, R::Occlusion})
          .reads({R::EyeCurves})
          .walksOpen()
          .into(Into::Destination)
          .joins(kSumOfLights)
          .when(isDirectional), // its light is constant along a ray, as a sun's
      Row(Pass::Composite, "composite", "passes/composite.frag")
          .reads({R::Inscatter, R::Transmittance})
          .into(Into::Colour)
          .joins(Joining::BlendIntoColour)
          .when(blendsTwoSources)
          .sameForAllLights(),
      Row(Pass::CopyColour, "copy colour", "passes/copyTexels.frag", S::Image)
          .reads({R::Image})
          .writes({R::ColourCopy})
          .when(copiesColour)
          .sameForAllLights(),
      Row(Pass::CompositeOfCopy, "composite", "passes/composite.frag")
          .reads({R::Inscatter, R::Transmittance, R::ColourCopy})
          .into(Into::Colour)
          .joins(Joining::OverwriteRgb)
          .options({{"COPIED", {1}}})
          .when(copiesColour)
          .sameForAllLights(),
      Row(Pass::CopyToOutput, "output", "passes/copyTexels.frag", S::Image)
          .reads({R::Image})
          .into(Into::Output)
          .options({{"CAPPED", {1}}})
          .sameForAllLights(),
      Row(Pass::MapCopy, "map copy", "passes/mapCopy.frag")
          .reads({R::ShadowMap, R::GlassColour, R::GlassDepth})
          .writes({R::ShadowCopy, R::GlassColourCopy, R::GlassDepthCopy})
          .options({{"SOURCE", {0, 1, 2, 3}}, {"GLASS", {0, 1}}})
          .when(isSampled)
          .sameForAllLights(),
      Row(Pass::OneDepth, "one depth", "passes/oneDepth.frag")
          .readsIfThere({kDepthSideBySide, R::SceneDepthSamples})
          .writes({R::OneDepth})
          .options({kSideBySide})
          .sameForAllLights(),
      Row(Pass::SampleDepth, "sample depth", "passes/oneDepth.frag")
          .readsIfThere({kDepthSideBySide, R::SceneDepthSamples})
          .writes({R::SampleDepth})
          .options({kSideBySide})
          .sameForAllLights(),
      Row(Pass::Edges, "edges", "passes/edges.frag", S::Image)
          .reads({R::SceneDepth})
          .into(Into::Destination)
          .joins(kSumOfLights)
          .sameForAllLights(),
      Row(Pass::SampleEnds, "sample ends", "passes/sampleEnds.frag", S::Slices)
          .reads({R::SceneDepth, R::SliceTable})
          .readsIfThere({R::LastSampleEnds})
          .writes({R::SampleEnds})
          .options({kKeepsEnds}),
      Row(Pass::RowDepths, "rows", "passes/rowDepths.frag", S::StripsOfRows)
          .reads({R::SliceTable, R::ShadowMap, R::GlassColour, R::GlassDepth})
          .writes({R::RowDepths, R::RowShares, R::RowHashes})
          .options({kStripsOfRows, kHashes, kTintSums})
          .when(hasRowDepths),
      Row(Pass::CurveCells, "curve cells", "passes/curveCells.frag", S::Rows)
          .reads({R::SliceTable, R::Curves})
          .writes({R::CurveCells})
          .when(hasCurves),
      Row(Pass::CurveTree, "curve tree", "passes/curveTree.frag", S::Rows)
          .reads({R::CurveCells})
          .writes({R::CurveTree})
          .when(hasCurves),
      Row(Pass::RowNodes, "nodes", "passes/rowNodes.frag", S::Rows)
          .reads({R::SliceTable, R::RowDepths, R::RowShares})
          .writes({R::RowNodes, R::RowNodeMeans, R::RowNodeMoments})
          .options({kTintSums})
          .when(hasTree),
      Row(Pass::RowTree, "tree", "passes/rowTree.frag", S::Rows)
          .reads({R::SliceTable, R::RowNodes, R::RowNodeMeans, R::RowNodeMoments})
          .writes({R::RowTree, R::RowMeans, R::RowMoments})
          .options({kTintSums})
          .when(hasTree),
      Row(Pass::PairGroups, "pair groups", "passes/pairTree.frag", S::StripsOfRows)
          .reads({R::SliceTable, R::RowDepths, R::RowTree})
          .writes({R::PairTree})
          .options({kStripsOfRows})
          .when(hasRows),
      Row(Pass::PairTree, "pair tree", "passes/pairTree.frag")
          .reads({R::SliceTable, R::RowDepths, R::RowTree})
          .writes({R::PairTree})
          .when(hasRows),
      Row(Pass::TintGroups, "tint groups", "passes/tintGroups.frag")
          .reads({R::SliceTable, R::LowRankRays, R::LowRankLights, R::ShadowMap, R::GlassColour, R::GlassDepth,
                  R::RowDepths})
          .writes({R::TintRed, R::TintGreen, R::TintBlue})
          .when(hasPanes),
      Row(Pass::TintFold, "tint fold", "passes/tintSums.frag")
          .reads({R::TintRed, R::TintGreen, R::TintBlue})
          .writes({R::TintRed, R::TintGreen, R::TintBlue})
          .options({{"FOLD", {1}}})
          .sameForAllLights(),
      Row(Pass::TintSums, "tint sums", "passes/tintSums.frag")
          .reads({R::TintRed,
                  R::TintGreen,
                  R::TintBlue,
                  {R::TintSumsRed, "coarserRed"},
                  {R::TintSumsGreen, "coarserGreen"},
                  {R::TintSumsBlue, "coarserBlue"}})
          .writes({R::TintSumsRed, R::TintSumsGreen, R::TintSumsBlue})
          .options({{"COARSER", {kUndefined, 1}}})
          .sameForAllLights(),
      Row(Pass::PixelTree, "pixels", "passes/march.frag", S::ImageOfMarch)
          .reads({R::SceneDepth, R::SliceTable})
          .readsIfThere({R::SliceBlocks})
          .walksRows()
          .into(Into::Destination)
          .joins(kSumOfLights),
      Row(Pass::PixelsByLowRank, "pixels", "passes/pixelTree.frag", S::Image)
          .reads({R::SceneDepth,
                  R::SliceTable,
                  R::LowRankRays,
                  R::LowRankLights,
                  {R::TintSumsRed, "tintRed"},
                  {R::TintSumsGreen, "tintGreen"},
                  {R::TintSumsBlue, "tintBlue"}})
          .readsIfThere({R::SliceBlocks})
          .walksRows()
          .into(Into::Destination)
          .joins(kSumOfLights)
          .options({{"LOW_RANK", {1}}, kTintSums})
          .when(hasLowRank),
      Row(Pass::Marks, "marks", "passes/marks.frag", S::Slices)
          .reads({R::SliceTable, R::SampleEnds, R::EyeCurves})
          .readsIfThere({R::MeanLight})
          .writes({R::Marks}),
      Row(Pass::March, "march", "passes/march.frag", S::Segments)
          .reads({{R::SampleEnds, "sceneDepth"}, R::SliceTable}) // its program is that of pixels, too
          .readsIfThere({R::SliceBlocks})
          .walksRows()
          .writes({R::Marched})
          .joins(kSumOfDraws),
      Row(Pass::SliceSums, "slice sums", "passes/meanLight.frag")
          .reads({R::SliceTable, R::Marched})
          .writes({R::SliceSums})
          .options({{"MEAN_OF", {1}}}),
      Row(Pass::MeanLight, "mean", "passes/meanLight.frag")
          .reads({R::SliceSums})
          .writes({R::MeanLight})
          .options({{"MEAN_OF", {2}}}),
      Row(Pass::SliceErrors, "slice errors", "passes/sliceErrors.frag")
          .reads({R::SliceTable, R::SampleEnds, R::Marched, R::MeanLight})
          .writes({R::SliceErrors}),
      Row(Pass::SliceSpacing, "slice spacing", "passes/sliceSpacing.frag")
          .reads({R::SliceErrors})
          .writes({R::SliceSpacing})
          .sameForAllLights(),
      Row(Pass::SliceBudget, "slice budget", "passes/sliceBudget.frag")
          .reads({R::SliceSpacing})
          .writes({R::SliceBudget})
          .sameForAllLights(),
      Row(Pass::SliceBlocks, "slice blocks", "passes/sliceBlocks.frag")
          .reads({R::SliceSpacing, R::SliceBudget})
          .writes({R::SliceBlocks})
          .sameForAllLights(),
      Row(Pass::DrawnSlices, "drawn slices", "passes/drawnSlices.frag")
          .reads({R::CandidateTable, R::SliceBlocks})
          .writes({R::SliceTable})
          .sameForAllLights(),
      Row(Pass::DrawnColumns, "drawn slices", "passes/drawnColumns.frag")
          .reads({R::SliceBlocks})
          .writes({R::ChangedSlices})
          .sameForAllLights(),
      Row(Pass::DrawnSegments, "drawn slices", "passes/drawnSegments.frag")
          .reads({R::SliceTable, R::SliceBlocks})
          .writes({R::ChangedSegments})
          .sameForAllLights(),
      Row(Pass::SliceEstimate, "slice estimate", "passes/sliceEstimate.frag")
          .reads({R::SliceSpacing, R::SliceBlocks})
          .writes({R::SliceEstimate})
          .options({{"ESTIMATE", {1}}})
          .sameForAllLights(),
      Row(Pass::CountEstimate, "slice estimate", "passes/sliceEstimate.frag")
          .reads({R::SliceEstimate})
          .writes({R::EstimateCodes})
          .options({{"ESTIMATE", {2, 3}}})
          .sameForAllLights(),
      Row(Pass::Refine, "refine", "passes/refine.frag", S::Slices)
          .reads({R::SliceTable, R::Marks, R::Marched})
          .readsIfThere({R::MeanLight})
          .writes({R::RefinedMarks}),
      Row(Pass::Offsets, "offsets", "passes/offsets.frag", S::Columns)
          .reads({{R::RefinedMarks, "marks"}})
          .writes({R::ExtraOffsets})
          .sameForAllLights(),
      Row(Pass::MarchExtra, "march extra", "passes/marchExtra.frag", S::StripsOfSlices)
          .reads({R::SliceTable, R::SampleEnds, {R::RefinedMarks, "marks"}, R::ExtraOffsets})
          .walksRows()
          .rays(2)
          .writes({R::Extra, R::ExtraSecond})
          .joins(kSumOfDraws),
      Row(Pass::Interpolate, "interpolate", "passes/interpolate.frag", S::Slices)
          .reads({R::SliceTable,
                  R::SampleEnds,
                  {R::RefinedMarks, "marks"},
                  R::ExtraOffsets,
                  R::Marched,
                  R::Extra,
                  R::ExtraSecond})
          .writes({R::EpipolarInscatter}),
      Row(Pass::Unwarp, "unwarp", "passes/unwarp.frag", S::Image)
          .reads({R::SceneDepth, R::SliceTable, R::EpipolarInscatter, R::MeanLight})
          .readsIfThere({R::SliceBlocks})
          .into(Into::Destination)
          .joins(kSumOfLights)
          .options({{"SPREAD", {0, 1}}})
          .when(isUnwarped),
      Row(Pass::UnwarpEdges, "unwarp", "passes/unwarpEdges.frag", S::Image)
          .reads({R::SliceTable, R::EpipolarInscatter})
          .readsIfThere({R::SliceBlocks, kDepthSideBySide, R::SceneDepthSamples})
          .writes({R::EdgeInscatter, R::EdgeTransmittance, R::EdgeRest}),
      Row(Pass::ServedEdges, "edges", "passes/edges.frag", S::Image)
          .reads({{R::EdgeRest, "sceneDepth"}})
          .into(Into::Destination)
          .joins(kSumOfLights)
          .sameForAllLights(),
      Row(Pass::EdgeRay, "edge ray", "passes/edgeRay.frag", S::Image)
          .reads({R::EdgeRest})
          .readsIfThere({kDepthSideBySide, R::SceneDepthSamples})
          .writes({R::EdgeInscatter, R::SampleDepth})
          .sameForAllLights(),
      Row(Pass::EdgeLight, "edges", "passes/edgeLight.frag", S::Image)
          .reads({R::EdgeInscatter, R::EdgeTransmittance})
          .into(Into::Destination)
          .joins(kSumOfLights)
          .sameForAllLights(),
      Row(Pass::EdgeComposite, "edges", "passes/composite.frag")
          .reads({{R::EdgeInscatter, "inscatter"}, {R::EdgeTransmittance, "transmittance"}})
          .into(Into::Destination)
          .joins(kSumOfLights)
          .when(blendsTwoSources)
          .sameForAllLights(),
      Row(Pass::Unserved, "unserved", "passes/red.frag", S::Image).writes({R::Unserved}).sameForAllLights(),
      Row(Pass::UnservedTiles, "unserved tiles", "passes/unservedTiles.frag")
          .reads({R::Unserved})
          .writes({R::UnservedTiles})
          .sameForAllLights(),
      Row(Pass::FixupAlongRow, "fix-up", "passes/march.frag", S::ImageOfMarch)
          .reads({R::SceneDepth, R::SliceTable})
          .readsIfThere({R::SliceBlocks})
          .walksRows()
          .into(Into::Destination)
          .joins(kSumOfLights),
      Row(Pass::FixupByShares, "fix-up", "passes/march.frag", S::ImageOfMarch)
          .reads({R::SceneDepth, R::SliceTable, R::SliceBlocks, R::EpipolarInscatter, R::MeanLight})
          .walksRows()
          .into(Into::Destination)
          .joins(kSumOfLights)
          .options({{"SHARES", {1}}})
          .when(isDirectional),
      Row(Pass::FixupAllTexels, "fix-up", "passes/exact.frag", S::Image)
          .readsIfThere({kDepthSideBySide, R::SceneDepthSamples}) // one of the two
          .walksTexels()
          .into(Into::Destination)
          .joins(kSumOfLights),
      Row(Pass::FixupOwnLine, "fix-up", "passes/fixup.frag", S::Image)
          .reads({R::SceneDepth, R::SliceTable, {R::PairTree, "rowTree"}})
          .walksOwnLine()
          .into(Into::Destination)
          .joins(kSumOfLights),
      Row(Pass::LookupLight, "look-up", "passes/lookupLight.frag")
          .reads({R::SliceTable})
          .readsIfThere({R::SliceBlocks})
          .walksRows()
          .writes({R::LookupSteps})
          .joins(Joining::AddAll),
      Row(Pass::LookupAmbient, "look-up ambient", "passes/lookupAmbient.frag")
          .readsIfThere({R::Occlusion})
          .reads({R::EyeCurves})
          .walksOpen()
          .writes({R::LookupSteps})
          .joins(Joining::AddAll)
          .when(isDirectional),
      Row(Pass::LookupSums, "look-up sums", "passes/lookupSums.frag")
          .reads({R::LookupSteps})
          .into(Into::Lookup)
          .sameForAllLights(),
      Row(Pass::LookupTransmittance, "look-up transmittance", "passes/lookupTransmittance.frag")
          .reads({R::EyeCurves})
          .into(Into::Lookup),
      Row(Pass::KeepEnds, "keep ends", "passes/copyTexels.frag", S::Slices)
          .reads({R::Image})
          .writes({R::SampleEnds})
          .sameForAllLights(),
      Row(Pass::KeepRows, "keep rows", "passes/copyTexels.frag", S::Rows)
          .reads({R::Image})
          .writes({R::RowDepths})
          .sameForAllLights(),
      Row(Pass::KeepHashes, "keep rows", "passes/copyTexels.frag", S::Rows)
          .reads({R::Image})
          .writes({R::RowHashes})
          .sameForAllLights(),
      Row(Pass::KeepDepth, "keep depth", "passes/copyTexels.frag", S::Image)
          .reads({{R::SceneDepth, "image"}})
          .writes({R::LastDepth})
          .sameForAllLights(),
      Row(Pass::ChangedParts, "changed parts", "passes/changedParts.frag", S::Rows)
          .reads({R::SliceTable, R::RowDepths, R::LastRowDepths, R::RowHashes, R::LastRowHashes})
          .writes({R::ChangedParts})
          .options({kHashes})
          .when(comparesRows),
      Row(Pass::ChangedEnds, "changed ends", "passes/changedEnds.frag", S::Slices)
          .reads({R::SampleEnds, R::LastSampleEnds})
          .writes({R::ChangedEnds})
          .sameForAllLights(),
      Row(Pass::ChangedSegments, "changed segments", "passes/changedSegments.frag", S::Slices)
          .reads({R::SliceTable, R::SampleEnds})
          .readsIfThere({R::ChangedEnds, R::ChangedParts}) // of what is compared
          .writes({R::ChangedSegments}),
      Row(Pass::ChangedSlices, "changed slices", "passes/changedSlices.frag", S::Columns)
          .reads({R::SliceTable, R::ChangedSegments})
          .readsIfThere({R::ChangedParts})
          .writes({R::ChangedSlices}),
      Row(Pass::ChangedTiles, "tiles", "passes/changedTiles.frag")
          .reads({R::SceneDepth, R::SliceTable, R::SampleEnds, R::ChangedSegments, R::ChangedSlices})
          .readsIfThere({R::LastDepth, R::MovedSlices})
          .writes({R::ChangedTiles})
          .sameForAllLights(),
      Row(Pass::ChangedPixels, "changed pixels", "passes/changedPixels.frag")
          .reads({R::SceneDepth, R::SliceTable, R::SampleEnds, R::ChangedSegments, R::ChangedSlices})
          .readsIfThere({R::LastDepth, R::MovedSlices})
          .into(Into::Destination)
          .joins(kSumOfLights)
          .sameForAllLights(),
      Row(Pass::CheckInputs, "check", "passes/checkInputs.frag")
          .reads({R::ShadowMap})
          .readsIfThere({kDepthSideBySide, R::SceneDepthSamples})
          .writes({R::InputChecks})
          .when(hasRows),
      Row(Pass::DebugSlices, "debug view", "passes/debugSlices.frag")
          .reads({R::SliceTable})
          .readsIfThere({R::SliceBlocks})
          .into(Into::DebugView)
          .sameForAllLights(),
      Row(Pass::DebugSamples, "debug view", "passes/debugSamples.frag", S::Samples)
          .reads({R::SliceTable, R::SampleEnds, R::Marks, R::RefinedMarks})
          .readsIfThere({R::SliceBlocks})
          .into(Into::DebugView)
          .joins(Joining::AddAll)
          .sameForAllLights(),
      Row(Pass::DebugFixup, "debug view", "passes/red.frag", S::Image).into(Into::DebugView).sameForAllLights(),
      Row(Pass::DebugVisitsOfLight, "debug view", "passes/pixelTree.frag", S::Image)
          .reads({R::SceneDepth, R::SliceTable})
          .readsIfThere({R::SliceBlocks})
          .walksRows()
          .into(Into::DebugView)
          .joins(Joining::AddAll)
          .options({{"COUNT_VISITS", {1}}}),
      Row(Pass::DebugRedrawn, "debug view", "passes/red.frag", S::Image).into(Into::DebugView).sameForAllLights(),
      Row(Pass::DebugRowMeans, "debug mean", "passes/debugMean.frag")
          .reads({R::Image})
          .writes({R::DebugRowMeans})

          .sameForAllLights(),
      Row(Pass::DebugMean, "debug mean", "passes/debugMean.frag")
          .reads({{R::DebugRowMeans, "image"}})
          .writes({R::DebugMean})

          .sameForAllLights(),
      Row(Pass::DebugImage, "debug view", "passes/debugImage.frag")
          .reads({R::Image})
          .into(Into::Colour)
          .joins(Joining::OverwriteRgb)
          .sameForAllLights(),
      Row(Pass::DebugVisits, "debug view", "passes/debugVisits.frag")
          .reads({R::Image})
          .into(Into::Colour)
          .joins(Joining::OverwriteRgb)
          .sameForAllLights(),
      Row(Pass::DebugDifference, "debug view", "passes/debugDifference.frag")
          .reads({R::Inscatter, {R::DebugExact, "exactInscatter"}, {R::DebugMean, "meanInscatter"}})
          .into(Into::Colour)
          .joins(Joining::OverwriteRgb)
          .sameForAllLights(),
      Row(Pass::DebugInputs, "debug view", "passes/debugInputs.frag")
          .readsIfThere({kDepthSideBySide, R::SceneDepthSamples, R::ShadowMap})
          .into(Into::Colour)
          .joins(Joining::OverwriteRgb),
  };
}

} // namespace

bool Occurrence::has(const char* option) const {
  return std::any_of(options.begin(), options.end(), [&](const auto& o) { return o.first == option && o.second != 0; });
}

bool Occurrence::has(const char* option, int value) const {
  return std::any_of(options.begin(), options.end(),
                     [&](const auto& o) { return o.first == option && o.second == value; });
}

const PassRow& rowOf(Pass pass) {
  static const std::vector<PassRow> rows = makeRows();
  return rows.at(static_cast<std::size_t>(pass));
}

} // namespace tyndall
