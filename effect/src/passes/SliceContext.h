// What the steps of the epipolar pipeline share: one light's inputs, the geometry of its slices, and how a step draws.
#pragma once

#include "CheckFrame.h"
#include "PassRecorder.h"
#include "Targets.h"
#include "passes/Exact.h"
#include "passes/Slices.h"

#include <functional>

namespace tyndall {
struct LightHistory;
}

namespace tyndall::passes {

/// The light that goes through the pipeline, and where it goes to.
struct SliceInputs {
  const Frame* frame = nullptr;
  const Light* light = nullptr;
  FrameTextures::Shadow map;
  exact::Variant variant; ///< of this light
  Blend blend = Blend::Replace;
  std::string name; ///< of the light, for the statistics
  /// Binds the framebuffer that receives the light, without its transmittance for draws that only add.
  std::function<Status(bool withStencil, bool withTransmittance)> attachDestination;
  /// Binds the framebuffer of the debug view of slices; empty unless this light is to be shown.
  std::function<Status(bool withStencil)> attachView;
  std::function<void(int binding, const void* data, std::size_t size)> upload;
  /// Temporal reuse: what is kept of the light; null: nothing is.
  LightHistory* history = nullptr;
  gl::Uint tiles = 0; ///< only those squares of pixels are to be drawn (passes/Changes.h); 0: all
};

/// What a target of slices has along y (glsl/passes/changedStrips).
enum class Along { Samples, SegmentsAndOne, Anything, Rows };

struct SliceContext {
  const PassContext& pass;
  Targets& targets;
  PassRecorder& recorder;
  const gl::Framebuffer& scratch; ///< for the effect's own targets
  const SliceInputs& inputs;
  const gl::Functions& gl = pass.gl;
  gl::Definitions definitions = exact::definitionsOf(inputs.variant);
  slices::Out slices = {};
  /// Temporal reuse: the slices and, if known, segments that are drawn (glsl/passes/changedSlices); 0: all are.
  gl::Uint changedSlices = 0, changedSegments = 0;

  /// True if the epipolar textures hold three channels.
  bool isColoured() const { return !inputs.variant.monochrome || inputs.variant.glass; }
  /// Shadow views of the light; 0 without a shadow map.
  int views() const { return inputs.variant.shadowViews == 0 ? 0 : slices.block.march.w; }
  /// Draws that march it: as few as row textures of bounded size allow, and at least one, which brings the light that
  /// is outside all views.
  int draws() const { return views() > 0 ? (views() + slices.viewsPerDraw - 1) / slices.viewsPerDraw : 1; }

  /// Uploads the block for one of the draws.
  void selectDraw(int draw);
  /// Rows that row textures have room for, and those of the selected draw.
  int rowRoom() const { return slices.count * slices.viewsPerDraw; }
  int rows() const { return slices.count * slices.block.march.y; }

  void bind(gl::Unit unit, gl::Uint texture) const { bindTexture(pass, unit, gl::TEXTURE_2D, texture); }
  void bindSlices() const { bind(gl::Unit::SliceTable, slices.table); }
  void bindSceneDepth() const { bind(gl::Unit::SceneDepth, inputs.frame->depth.texture); }
  /// The shadow map and glass map of the light, if it has them.
  void bindMaps() const;

  /// Makes one of our textures the target of the next draws; `texture` receives its name.
  Status target(Target which, int width, int height, gl::Uint& texture);
  /// One more colour target of the next draws, of the same size as the first.
  Status attachMore(gl::Enum index, Target which, int width, int height, gl::Uint& texture);

  /// Leaves only the first `kept` targets attached: other passes draw into fewer, of other sizes.
  void detachMore(gl::Enum kept) const;

  /// Draws the full-screen triangle as a pass of the light.
  Status draw(const std::string& name, const std::string& fragment, const gl::Definitions& with);
  /// The same over the image, of which temporal reuse may want parts only.
  Status drawImage(const std::string& name, const std::string& fragment, const gl::Definitions& with);
  /// Draws those that have changed, if that is known: slices along x, rows along y, or, where each has a length of its
  /// own, strips (passes/strips.vert).
  Status drawSlices(const std::string& name, const std::string& fragment, const gl::Definitions& with,
                    Along along = Along::Samples);
  Status drawRows(const std::string& name, const std::string& fragment, const gl::Definitions& with);
  Status drawStrips(const std::string& name, const std::string& fragment, const gl::Definitions& with, int lines,
                    bool counted);

  Targets& holderOf(Target which) const;
  void bindChanges() const;

  Status shaderError() const { return {StatusCode::ShaderError, "a shader did not build: " + pass.programs.error()}; }
};

/// The same program over all, and over what has changed.
std::vector<gl::Variant> inSlices(const char* fragment, const gl::Definitions& definitions,
                                  Along along = Along::Samples);
std::vector<gl::Variant> inRows(const char* fragment, const gl::Definitions& definitions);
std::vector<gl::Variant> inStrips(const char* fragment, const gl::Definitions& definitions);

} // namespace tyndall::passes
