// What an effect holds in its context, and the steps of a frame. Effect.cpp has the frame, EffectViews.cpp the debug
// views, EffectReuse.cpp what is kept of the last frame.
#pragma once

#include "CheckFrame.h"
#include "ContextWatch.h"
#include "History.h"
#include "ObjectBoxes.h"
#include "PassRecorder.h"
#include "Targets.h"
#include "gl/Program.h"
#include "gl/StateGuard.h"
#include "passes/SliceContext.h"
#include "passes/View.h"

#include <array>

namespace tyndall {

struct Effect::State {
  explicit State(const Config& config)
      : watch(gl), programs(gl), targets(gl), recorder(gl, config.timing), histories(gl), objectBoxes(gl) {}

  gl::Functions gl;
  ContextWatch watch;
  gl::ProgramCache programs;
  Targets targets;
  PassRecorder recorder;
  Histories histories;
  ObjectBoxes objectBoxes;
  double redrawnShare = 1; // of the last frame; < 0: the view's history knows
  std::uint64_t lastView = 0;
  gl::VertexArray vertexArray;
  gl::Framebuffer framebuffer;
  gl::Framebuffer scratch; // for the targets of slices
  gl::Int id = 0;          ///< kept in our sampler, where it tells this context from another with the same names
  gl::Sampler nearestSampler;
  std::array<gl::Buffer, gl::kUniformBindings> uniformBuffers;

  // Where a frame's light goes: straight into colour, or into two textures first.
  struct Destination {
    gl::Uint inscatter = 0, transmittance = 0; // 0, 0: straight into colour
    bool composite = false;                    // blend them, or show the view, into colour afterwards
    bool copies = false;                       // copy the inscatter, a texture of our own, to the engine's
    float ceiling = 0;                         // largest radiance that a light may add there
    bool direct() const { return inscatter == 0 && transmittance == 0; }
  };

  // A light that adds something, with the settings that it was dealt.
  struct DrawnLight {
    std::size_t index = 0;
    std::string name;
    Settings settings;
    blocks::LightBlock block;
    passes::exact::Variant variant;
  };

  void createObjects();
  Status checkContext(const char* function);
  Status compileAll();
  Status render(const Frame& frame);
  Status renderChecked(const Frame& frame, const FrameTextures& textures);
  Status chooseDestination(const Frame& frame, const FrameTextures& textures, bool changesColour,
                           Destination& destination);
  Status attach(const Frame& frame, gl::Uint first, gl::Uint second, bool withStencil = false);
  Status drawLights(const Frame& frame, const FrameTextures& textures, const Destination& destination);
  Status prepareColour(const Frame& frame);
  Status drawView(const Frame& frame, const FrameTextures& textures, const Destination& destination);
  Status drawDifference(const Frame& frame, const FrameTextures& textures, passes::view::In& in);
  Status drawMean(const Frame& frame, gl::Uint image, int channels, gl::Uint& mean);
  Status readVisits(const Frame& frame, gl::Uint image);
  Status clearView(const Frame& frame, float red);
  Status showRedrawn(const Frame& frame, Redraw picture);
  std::vector<DrawnLight> lightsToDraw(const Frame& frame, const FrameTextures& textures, bool wantsInscatter,
                                       bool direct);
  passes::SliceInputs sliceInputs(const Frame& lit, const DrawnLight& light, const FrameTextures& textures,
                                  const Destination& destination, bool first);
  Status drawExact(const Frame& frame, const DrawnLight& light, const Destination& destination, bool first);
  blocks::FrameBlock beginDraws(const Frame& frame, const FrameTextures& textures, const Destination& destination);
  Status composite(const Frame& frame, const Destination& destination);

  // Temporal reuse (EffectReuse.cpp).
  Status renderReusing(const Frame& frame, const FrameTextures& textures, bool& rests);
  Status redraw(const Frame& frame, const FrameTextures& textures, const std::vector<DrawnLight>& lights,
                Redraw& picture, const Destination& destination);
  Status redrawSlices(const Frame& frame, const FrameTextures& textures, const std::vector<DrawnLight>& lights,
                      Redraw& picture, const Destination& destination);
  Status findTiles(const Frame& frame, const std::vector<DrawnLight>& lights, ViewHistory& view, gl::Uint& tiles);
  Status keepDepth(const Frame& frame, ViewHistory& view, gl::Uint tiles);
  bool drawTiles(const Frame& frame, const gl::Variant& variant, gl::Uint tiles);
  Status copyToOutput(const Frame& frame, gl::Uint from, gl::Uint output);
  // Slices take one depth per pixel: a multisampled frame is rendered by exact.
  static bool usesSlices(const Frame& frame) {
    return frame.settings.technique != Technique::Exact && !frame.depth.multisampled;
  }
  static bool hasView(const Frame& frame) { return frame.settings.view != View::Composite; }
  static bool showsSlices(const Frame& frame) {
    return frame.settings.view >= View::Slices && frame.settings.view <= View::NodeVisits;
  }
  void upload(int binding, const void* data, std::size_t size);
  passes::PassContext passContext() { return {gl, programs, nearestSampler.name()}; }
  Status shaderError() const { return {StatusCode::ShaderError, "a shader did not build: " + programs.error()}; }
};

} // namespace tyndall
