// A frame's plan: which lights, which passes, with what programs, textures, framebuffers and blocks.
#pragma once

#include "plan/LightPlanner.h"
#include "reuse/RedrawPlan.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace tyndall {

/// What a plan is made from, and with.
struct PlanInputs {
  const Frame& frame;
  const FrameTextures& textures;
  const Limits& limits;
  const Tuning& tuning;
  Targets& targets;
  KeptEye* eye = nullptr;           ///< temporal reuse; null: nothing is kept
  bool counts = true;               ///< queries may be used: none of the engine's own is under way
  const BandPaces* paces = nullptr; ///< of earlier frames' draws; null: nothing is known
  std::uint64_t lookupWrite = 0;    ///< which write of Frame::lookup's textures was the last; 0: not known
  // To compile ahead of frames like this one:
  bool ahead = false;              ///< with a camera that may look elsewhere
  std::optional<bool> sumsApart{}; ///< lights may, or may not, need a texture of their own to be added up in
};

struct PlannedFrame {
  FramePlan plan;
  std::optional<KeptNext> next;
  bool fillsLookup = false; ///< Frame::lookup is drawn
  gl::Uint empty = 0;       ///< what a sampler reads that has nothing to read
  gl::Uint visits = 0;      ///< DebugView::NodeVisits: a texture that holds their mean
  gl::Uint checks = 0;      ///< Resource::InputChecks, of these lights:
  std::vector<std::size_t> checkedLights = {};
};

class FramePlanner {
public:
  FramePlanner(const PlanInputs& inputs, Allocator& allocator, PlannedFrame& out);

  /// Every step of the frame; what could not be made is the allocator's status.
  void plan();

  /// Compares scene depth and shadow maps (Config::checkInputs), into PlannedFrame::checks.
  void planCheck();

  /// The same for what may be kept of the last frame and is drawn anew: to compile ahead for it.
  void planRedrawn(bool comparesEnds, bool comparesRows);

private:
  void planInFull();
  void planWithEye();
  void planReused(const std::vector<DrawnLight>& drawn, RedrawPlan redraw);
  using Lights = std::vector<std::unique_ptr<LightPlanner>>;
  /// Of the picture: the pixels that are drawn anew, in tiles or as the stencil has them; neither: all.
  struct Mask {
    gl::Uint tiles = 0;
    bool stencil = false;
  };
  Mask planParts(const std::vector<DrawnLight>& drawn, RedrawPlan& redraw, KeptNext& next);
  Mask planMask(const Lights& lights, const RedrawPlan& redraw);
  static void use(const Mask& mask, PassPlanner& passes);
  void drawMasked(Pass pass, const Mask& mask);
  FrameKey keyOf(const std::vector<DrawnLight>& drawn) const;
  Destination chooseDestination(bool changesColour);
  Destination keptDestination() const;
  void begin(const Destination& destination);
  void planSamples();
  void planDepth();
  std::vector<DrawnLight> lightsToDraw(const Frame& frame, const Destination& destination);
  AmbientKey ambientKey() const;
  void beginLookup();
  void finishLookup();
  bool planAmbient(const PassPlanner& planner);
  void planLights(const Frame& frame, const Destination& destination, const std::vector<DrawnLight>& lights);
  void planPicture();
  void planComposite();
  void planDifference();
  void planMean(gl::Uint image);
  LightPlanner mapOf(std::size_t light);
  void planInputs();
  void showRedrawn(Redraw picture, const Mask& mask);
  void copyToOutput(gl::Uint from, gl::Uint output);
  void makeStandIns(bool drawsColour);
  void standIn(Resource resource, const std::string& title, Surface& surface);
  void copyBack();
  void copyColourLayer();
  gl::Uint framebufferOf(const Surface& engines, const std::string& field);
  std::vector<Surface> engines() const;

  const PlanInputs& in_;
  const Frame& frame_;
  Allocator& allocator_;
  PlannedFrame& out_;
  PassPlanner passes_;                         // of the whole frame
  Surface colour_, inscatter_, transmittance_; // what is drawn into: the engine's, or what stands in for it
  std::vector<Copy> copiesBack_;               // from there to the engine's
};

} // namespace tyndall
