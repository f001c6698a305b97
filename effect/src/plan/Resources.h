// The textures that passes read and write: one row each. Those of the effect's own have a format, a size and a
// lifetime; the others are given.
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"

#include <array>
#include <string>

namespace tyndall {

enum class Resource {
  // Given: the engine's, or what a pass is told to read.
  SceneDepth,
  SceneDepthSamples,    // of all samples, in a multisampled texture,
  SceneDepthSideBySide, // or as texels side by side
  EngineDepth,          // whatever plain depth is made of
  ShadowMap,
  GlassColour,
  GlassDepth,
  Curves,
  EyeCurves,
  Occlusion, // of the surroundings
  Image,
  // The effect's own.
  Empty,
  PlainDepth,  // as SceneDepthSideBySide
  OneDepth,    // as SceneDepth
  SampleDepth, // likewise, for a while
  EdgeInscatter,
  EdgeTransmittance,
  EdgeRest,
  ShadowCopy,
  GlassColourCopy,
  GlassDepthCopy,
  Inscatter,
  Transmittance,
  ColourCopy,
  StandInColour, // for the engine's textures, in their formats (plan/StandIns.cpp)
  StandInInscatter,
  StandInTransmittance,
  SliceTable,
  CandidateTable,
  SampleEnds,
  Marks,
  RefinedMarks,
  Marched,
  SliceSums,
  MeanLight,
  SliceErrors,
  SliceSpacing,
  SliceBudget,
  SliceBlocks,
  SliceEstimate,
  EstimateCodes,
  ExtraOffsets,
  Extra,
  ExtraSecond,
  EpipolarInscatter,
  Unserved,
  UnservedTiles,
  LookupSteps,
  RowDepths,
  RowShares,
  RowNodes,
  RowNodeMeans,
  RowNodeMoments,
  RowTree,
  RowMeans,
  RowMoments,
  PairTree,
  CurveCells,
  CurveTree,
  LowRankRays,
  LowRankLights,
  TintRed,
  TintGreen,
  TintBlue,
  TintSumsRed,
  TintSumsGreen,
  TintSumsBlue,
  RowHashes,
  LastSampleEnds, // the last frame's, of named objects copies of what these can have moved
  LastRowDepths,
  LastRowHashes,
  ChangedParts,
  ChangedEnds,
  ChangedSegments,
  ChangedSlices,
  MovedSlices,
  MovedEnds,
  ChangedTiles,
  LastDepth,
  InputChecks,
  DebugView,
  DebugExact,
  DebugRowMeans,
  DebugMean,
  Count
};

struct Size {
  int width = 0, height = 0;
  int layers = 0; ///< of a GL_TEXTURE_2D_ARRAY; 0: a GL_TEXTURE_2D
};

/// What the sizes and formats of a light's or a frame's own textures follow.
struct Extent {
  int width = 0, height = 0; ///< of the image
  int slices = 0, samples = 0, tableRows = 0;
  int candidateSlices = 0;        ///< from which those are chosen
  int rowTexels = 0, rowRoom = 0; ///< texels of a row and rows that row textures have room for
  int drawnTexels = 0, rows = 0;  ///< those of this frame, and of the draw that is selected
  int treeLevels = 0;
  Size mapCopy;                      ///< of a light's maps: texels of its largest view, and a layer for each
  int curveCells = 0;                ///< texels per side of the map of Light::curves
  int terms = 0, lowRankSets = 0;    ///< Technique::LowRank
  int tintLevel = 0;                 ///< of the sums of tints: 0 is the finest
  bool sampledDepth = false;         ///< the scene depth has several samples a pixel
  int sampleShift = 0;               ///< which stand side by side in plain depth: 2^s
  bool wideColour = true;            ///< the engine's colour is one of 32-bit floats
  std::array<gl::Enum, 3> engines{}; ///< formats of the engine's colour and outputs
  bool floatTint = true;             ///< tints of the glass map have more than 8 bits
  bool coloured = true;              ///< three channels of radiance
  bool floatRows = true;             ///< depths of rows in 32 bits, not in 16
  bool glass = false;
  bool shares = false;  ///< a group of texels may be lit in part: filtered or glass
  Size lookup;          ///< texels of a layer of Frame::lookup,
  int lookupDepths = 0; ///< and its layers
  bool hashes = false;  ///< temporal reuse wants them of rows that have shares
};

struct TexelFormat {
  gl::Enum internal = 0; ///< 0: a texture that is given
  int bytes = 0;         ///< of a texel
};

/// How long what a texture holds is needed.
enum class Lifetime {
  Frame,        ///< until the light is drawn; shared by lights
  Light,        ///< temporal reuse: as long as the light is kept
  Compared,     ///< the same, this frame's beside the last one's
  LightRows,    ///< as Light, of rows that stand in one texture; others as Frame
  ComparedRows, ///< as Compared, likewise
  Eye,          ///< temporal reuse: as long as the eye is kept
};

struct ResourceRow {
  const char* name;
  TexelFormat wide;
  TexelFormat narrow;
  bool (*isWide)(const Extent&);
  bool (*exists)(const Extent&);
  Size (*size)(const Extent&);
  Size (*drawn)(const Extent&); ///< the part that a draw fills
  Lifetime lifetime;
  const char* reason;
  const char* study = ""; ///< its line in tests/stress/precision/README.md; "" for what is given or in no picture
};

const ResourceRow& rowOf(Resource resource);
TexelFormat formatOf(Resource resource, const Extent& extent);

/// Samples of a slice that are refined, and with reuse drawn anew, together.
inline constexpr int kSegmentSamples = 16;
inline constexpr int kPartTexels = 256; ///< of a row, that are compared together

/// Squares of kTile x kTile pixels of an image, whose flags stand one after the other in lines of kTilesAcross.
inline constexpr int kTile = 16, kTilesAcross = 256;
int tilesOf(const Extent& extent);

/// What shaders call it: "row node means" is rowNodeMeans.
std::string samplerOf(Resource resource);

/// Textures by what they are.
class Board {
public:
  gl::Uint& operator[](Resource resource) { return names_[static_cast<std::size_t>(resource)]; }
  gl::Uint operator[](Resource resource) const { return names_[static_cast<std::size_t>(resource)]; }

private:
  std::array<gl::Uint, static_cast<std::size_t>(Resource::Count)> names_{};
};

} // namespace tyndall
