// The passes: one row each. What a row says is all that the plan, the list of all programs and the tests know of a
// pass.
#pragma once

#include "gl/Variant.h"
#include "plan/LightVariant.h"
#include "plan/Resources.h"

#include <vector>

namespace tyndall {

enum class Pass {
  // Of the whole frame.
  PlainDepth,
  Exact,
  Transmittance,
  Ambient,
  Composite,
  CopyColour,
  CompositeOfCopy,
  CopyToOutput,
  MapCopy, // of a light, where passes do not read its maps as they are
  OneDepth,
  SampleDepth,
  Edges,
  // A light's rows and slices (passes/Epipolar.cpp has the picture).
  SampleEnds,
  RowDepths,
  CurveCells,
  CurveTree,
  RowNodes,
  RowTree,
  PairGroups,
  PairTree,
  TintGroups,
  TintFold,
  TintSums,
  PixelTree,
  PixelsByLowRank,
  Marks,
  March,
  SliceSums,
  MeanLight,
  SliceErrors,
  SliceSpacing,
  SliceBudget,
  SliceBlocks,
  DrawnSlices,
  DrawnColumns,
  DrawnSegments,
  SliceEstimate,
  CountEstimate,
  Refine,
  Offsets,
  MarchExtra,
  Interpolate,
  Unwarp,
  UnwarpEdges,
  ServedEdges,
  EdgeRay,
  EdgeLight,
  EdgeComposite,
  Unserved,
  UnservedTiles,
  FixupAlongRow,
  FixupByShares,
  FixupAllTexels,
  FixupOwnLine,
  // Frame::lookup (passes/Lookup.cpp).
  LookupLight,
  LookupAmbient,
  LookupSums,
  LookupTransmittance,
  // Temporal reuse (reuse/).
  KeepEnds,
  KeepRows,
  KeepHashes,
  KeepDepth,
  ChangedParts,
  ChangedEnds,
  ChangedSegments,
  ChangedSlices,
  ChangedTiles,
  ChangedPixels,
  CheckInputs,
  // Debug views.
  DebugSlices,
  DebugSamples,
  DebugFixup,
  DebugVisitsOfLight,
  DebugRedrawn,
  DebugRowMeans,
  DebugMean,
  DebugImage,
  DebugVisits,
  DebugDifference,
  DebugInputs,
  Count
};

/// What a pass draws over.
enum class Shape {
  FullScreen,
  ImageOfMarch,   ///< as Image, by the vertex shader of the march
  Image,          ///< all pixels, or the tiles that have changed
  Slices,         ///< slices x samples or a part of them; or the segments that have changed
  Segments,       ///< slices x (segments + 1), likewise
  Columns,        ///< slices x anything; or the slices that have changed
  Rows,           ///< anything x rows, likewise
  StripsOfSlices, ///< as much of each slice as it fills (passes/strips.vert), or of those that have changed
  StripsOfRows,   ///< the same of each row
  Samples,        ///< a triangle for each sample
};

/// Where a pass writes to.
enum class Into {
  Own,         ///< the row's own resources
  Destination, ///< the frame's inscatter and transmittance, or its colour
  DebugView,   ///< the debug view's texture, beside the destination's stencil
  Colour,      ///< the frame's colour
  Output,      ///< a texture of the engine's that the plan names
  Lookup,      ///< layers of one, likewise
};

/// How a pass's outputs join what is there.
enum class Joining {
  Replace,
  SumOfDraws,  ///< the first of a light's draws replaces, the others add
  SumOfLights, ///< the frame's first draw replaces, or blends into colour, the others add
  AddAll,
  BlendIntoColour, ///< colour * transmittance + inscatter
  OverwriteRgb,    ///< alpha stays
};

/// What each of a fragment's rays looks at.
enum class RayWalk {
  None,
  AllTexels, ///< along it, in every shadow view of the light
  Row,       ///< of its slice, by its tree, in the shadow views of the draw
  OwnLine,   ///< texels along it, but for those that a row's tree skips
  Open,      ///< all of it at once: light is integrated as if no map blocked it
};

struct Read {
  Read(Resource what, const char* sampler = nullptr)
      : resource(what), as(sampler) {} // NOLINT: a list of resources is one of these
  Resource resource;
  const char* as;       ///< the sampler's name, if it is not the resource's
  bool mayLack = false; ///< a draw may have none, and its program does not look then
};

/// A definition beside those of the light, and the values that it may take. kUndefined: it is not defined. One value:
/// it is the same in all draws.
struct Option {
  const char* name;
  std::vector<int> values;
};
inline constexpr int kUndefined = -1;

/// How a program of a pass comes to be: for the list of all.
struct Occurrence {
  LightVariant light;
  gl::Definitions options;
  bool has(const char* option) const; ///< and it is not 0
  bool has(const char* option, int value) const;
};

struct PassRow {
  Pass pass;
  const char* name;     ///< in statistics, after the light's
  const char* fragment; ///< of glsl/passes
  Shape shape = Shape::FullScreen;
  std::vector<Read> reads = {};
  std::vector<Resource> writes = {}; ///< of Into::Own; the first decides what is drawn over
  Into into = Into::Own;
  Joining joining = Joining::Replace;
  std::vector<Option> options = {};
  RayWalk walk = RayWalk::None;
  int raysPerFragment = 1;
  bool ofLights = true;                        ///< its programs differ by the light's variant
  bool (*occurs)(const Occurrence&) = nullptr; ///< null: always
};

const PassRow& rowOf(Pass pass);

/// The program that draws a pass over its shape, and over what has changed of it.
gl::Variant variantOf(Pass pass, const LightVariant& light, const gl::Definitions& options);

/// Vertices of its vertex shader from which on it draws a pass whole, or what has changed of it.
int firstVertexOf(Pass pass, bool changes);

/// Every program that a plan may ask for in a context with dual-source blending and arrays of cube maps, or without,
/// and some that are the same (gl::mentioned).
std::vector<gl::Variant> allVariants(bool dualSource = true, bool cubeArrays = true);

} // namespace tyndall
