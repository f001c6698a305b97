// What an effect holds in its context.
#pragma once

#include "BandPaces.h"
#include "CheckFrame.h"
#include "ContextWatch.h"
#include "InputChecks.h"
#include "ObjectBoxes.h"
#include "PassRecorder.h"
#include "Tuning.h"
#include "gl/ProgramCache.h"
#include "gl/StateGuard.h"
#include "plan/BlockBuffers.h"
#include "plan/DrawPlan.h"
#include "plan/PlanFrame.h"
#include "reuse/Kept.h"
#include "reuse/LookupWrites.h"

namespace tyndall {

/// Of a frame.
enum class Draws { All, CheckOnly };

struct Effect::State {
  explicit State(const Config& config)
      : stateMode(config.state), checksInputs(config.checkInputs), warningsAreErrors(config.warningsAreErrors),
        tuning(config.tuning), betweenDraws(config.betweenDraws), watch(gl), programs(gl, config.programs),
        framebuffers(gl), targets(gl, framebuffers), recorder(gl, config.timing), paces(gl), eyes(gl, framebuffers),
        objectBoxes(gl), inputChecks(gl), blocks(gl) {}

  StateMode stateMode;
  bool checksInputs, warningsAreErrors;
  Tuning tuning; ///< nothing is left to choose once the objects are made
  std::function<bool()> betweenDraws;
  gl::Functions gl;
  ContextWatch watch;
  Limits limits;
  gl::ProgramCache programs;
  Framebuffers framebuffers;
  Targets targets;
  PassRecorder recorder;
  BandPaces paces;
  KeptEyes eyes;
  ObjectBoxes objectBoxes;
  InputChecks inputChecks;
  gl::VertexArray vertexArray;
  gl::Sampler nearestSampler;
  BlockBuffers blocks;
  // Of the last frame, for statistics().
  std::optional<std::uint64_t> lastEye; ///< whose counts know it
  gl::Uint visits = 0;                  ///< the texture that holds DebugView::NodeVisits' mean
  std::vector<std::string> warnings;
  LookupWrites lookupWrites;

  void createObjects();
  Status check(const char* function);
  Status checkFields(const Frame& frame, std::vector<std::string>& suspicions) const;
  Status takeMeshes(Frame& frame);
  KeptEye* eyeOf(const Frame& frame);
  static Camera steadyCamera(const Frame& frame, const KeptEye* eye);
  void beginStatistics();
  Status planFrame(const Frame& frame, const FrameTextures& textures, KeptEye* eye, PlannedFrame& planned,
                   Draws what = Draws::All);
  Status takeChecks(const Frame& given, const Frame& frame, const FrameTextures& textures, gl::StateGuard& guard);
  bool draw(const Frame& given, const PlannedFrame& planned, gl::StateGuard& guard); ///< false: abandoned
  void keep(const Frame& frame, KeptEye* eye, PlannedFrame* planned);
  Status render(const Frame& frame);
  PrepareStatus prepare(const Frame& frame);
  std::vector<FramePlan> planAhead(const Frame& frame, const FrameTextures& textures);
  Status compileAll();
  double visitsPerRay() const;
};

} // namespace tyndall
