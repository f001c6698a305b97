// A linked program: a vertex shader (full-screen unless named) with one fragment shader of glsl/passes, or a compute
// shader, and a set of definitions.
#pragma once

#include "gl/Functions.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tyndall::gl {

using Definitions = std::vector<std::pair<std::string, int>>; ///< name and value of each #define

/// Texture unit of each sampler that a shader of ours may declare.
enum class Unit : Uint {
  SceneDepth,
  ShadowMap,
  GlassColour,
  GlassDepth,
  Inscatter,
  Transmittance,
  SliceTable,
  SampleEnds,
  Marks,
  Marched,
  Extra,
  EpipolarInscatter,
  RowDepths,
  RowNodes,
  RowTree,
  RowShares,
  RowMeans,
  RowMoments,
  ChangedSegments,
  Curves,
  CurveCells,
  CurveTree,
  ExtraGreen = Inscatter, ///< no pass reads both
  ExtraBlue = Transmittance,
  ExtraOffsets = RowNodes,
  SliceSums = RowNodes,
  RowNodeMeans = RowMeans,
  RowNodeMoments = RowMoments,
  MeanLight = Marched,
  LowRankRays = Marks, ///< of the pixel tree, which reads no samples
  LowRankLights = Extra,
  TintRed = EpipolarInscatter, ///< of the pixel tree as well, whose walk then needs no averages
  TintGreen = Inscatter,
  TintBlue = Transmittance,
  CoarserRed = RowShares,
  CoarserGreen = RowMeans,
  CoarserBlue = RowMoments,
  ChangedSlices = EpipolarInscatter, ///< of temporal reuse: none of what reads them reads those
  LastSampleEnds = Marks,
  LastRowDepths = RowNodes,
  RowHashes = RowTree,
  LastRowHashes = RowShares,
  ChangedParts = Marched,
  LastDepth = Marched,
  ChangedTiles = Marks,
  ChangedEnds = Extra,
  MovedSlices = Extra,
  ViewImage = Marched, ///< debug views run after the passes that read these, or read neither
  ViewExact = Extra,
  ViewMean = EpipolarInscatter,
  Upload = CurveTree + 1, ///< where textures are made and filled, so that no other unit's texture is disturbed
};

inline constexpr const char* kFullScreen = "passes/fullscreen.vert";

/// What selects a program.
struct Variant {
  std::string fragment; ///< or compute shader
  Definitions definitions;
  std::string vertex = kFullScreen; ///< empty for a compute shader
};

/// Those definitions that a shader's text mentions, as whole words.
Definitions mentionedBy(const std::string& text, const Definitions& definitions);

/// Those that a variant's shaders mention: variants that differ in no other are one program.
Definitions mentioned(const Variant& variant);

/// The complete text of a shader as GL is given it, with those of the definitions that it mentions.
std::string completeSource(const std::string& file, const Definitions& definitions);

class Program {
public:
  Program(const Functions& gl, Uint name) : gl_(&gl), name_(name) {}
  Program(Program&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  Program& operator=(Program&&) = delete;
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (name_ != 0) gl_->DeleteProgram(name_);
  }
  Uint name() const { return name_; }

private:
  const Functions* gl_;
  Uint name_;
};

/// Compiles variants when they are first asked for and keeps them.
class ProgramCache {
public:
  explicit ProgramCache(const Functions& gl) : gl_(gl) {}

  /// The program of a fragment shader ("passes/exact.frag"); 0 if it does not build, then error() has the log. Leaves
  /// the program in use.
  Uint use(const std::string& fragment, const Definitions& definitions, const std::string& vertex = kFullScreen);
  /// The same of a compute shader ("passes/avsmSort.comp"), which needs OpenGL 4.3.
  Uint useCompute(const std::string& file, const Definitions& definitions) { return use(file, definitions, {}); }

  const std::string& error() const { return error_; }
  int size() const { return static_cast<int>(programs_.size()); }

private:
  Uint compile(Enum kind, const std::string& file, const Definitions& definitions);
  Uint link(const std::string& file, const Definitions& definitions, const std::string& vertex);
  Uint linkShaders(const std::vector<Uint>& shaders);

  const Functions& gl_;
  std::map<std::string, Program> programs_; ///< by what their shaders mention
  std::map<std::string, Uint> names_;       ///< by what was asked for
  std::string error_;
};

} // namespace tyndall::gl
