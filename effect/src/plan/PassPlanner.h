// Adds draws to a plan, as the rows of passes and resources have them: which program, what it reads, where it writes
// to, how large. Textures and framebuffers are made on the way; the first that cannot be is the plan's end.
#pragma once

#include "BandPaces.h"
#include "plan/Bands.h"
#include "plan/FramePlan.h"
#include "plan/Passes.h"
#include "plan/Targets.h"

#include <optional>
#include <tyndall/tyndall.h>

namespace tyndall {

/// Makes what a plan needs; or, while programs are compiled ahead, only says that it did.
class Allocator {
public:
  Allocator(Framebuffers& framebuffers, bool makes) : framebuffers_(framebuffers), makes_(makes) {}

  gl::Uint texture(Targets& targets, Resource resource, const Extent& extent, int side = 0);
  gl::Uint stencil(Targets& targets, const Extent& extent);
  gl::Uint framebuffer(const Attachments& attachments, const std::string& field);
  void fail(Status status);
  bool makes() const { return makes_; }
  const Status& status() const { return status_; }

private:
  Framebuffers& framebuffers_;
  bool makes_;
  Status status_;
};

/// Where the light of a frame goes to: straight into its colour, or into two textures first.
struct Destination {
  gl::Uint inscatter = 0, transmittance = 0; ///< 0, 0: straight into colour
  gl::Uint colour = 0;
  std::vector<Surface> engines; ///< those of the textures that are not ours, each another
  bool composite = false;       ///< blend them, or show the debug view, into colour afterwards
  bool copies = false;          ///< copy the inscatter, a texture of our own, to the engine's
  float ceiling = 0;            ///< largest radiance that a light may add there
  bool direct() const { return inscatter == 0 && transmittance == 0; }
};

struct DrawOptions {
  gl::Definitions options = {}; ///< beside those of the light
  Stencil stencil = {};
  Counting counting = {};
  std::optional<Viewport> viewport = {}; ///< in place of what the resource's row says
  std::optional<float> clearTo = {};     ///< clears the target first
  gl::Uint output = 0;                   ///< Into::Output, Lookup: which texture
  int layer = -1;                        ///< of the resource's textures, if they are arrays; Into::Lookup: the first
  std::optional<Blend> blend = {};       ///< in place of the row's joining
};

class PassPlanner {
public:
  PassPlanner(Allocator& made, FramePlan& steps, Targets& targets, const Tuning& choices)
      : allocator(made), plan(steps), frameTargets(targets), tuning(choices) {}
  PassPlanner(const PassPlanner&) = default;
  PassPlanner& operator=(const PassPlanner&) = delete;
  virtual ~PassPlanner() = default;

  void draw(Pass pass, const DrawOptions& options = {});
  void draw(Pass pass, const std::string& title, const DrawOptions& options);
  /// A light of its own, into one target: where the destination's transmittance has another, that comes before.
  void drawLight(Pass pass, const std::string& title, DrawOptions options);
  void drawLight(Pass pass, const DrawOptions& options = {}) { drawLight(pass, titleOf(rowOf(pass).name), options); }
  void clear(Resource resource, float red); ///< of the whole image
  void clearStencil();                      ///< of what unwarp marks
  void clearStencil(gl::Uint bits);
  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(extent.width) * static_cast<std::uint64_t>(extent.height);
  }
  /// How depthSamples.glsl finds samples.
  gl::Definitions samplesOfDepth() const { return {{"SIDE_BY_SIDE", extent.sampleShift > 0 ? 1 : 0}}; }
  void skip(const std::string& pass, const std::string& why) { plan.skip(titleOf(pass), why); }

  Allocator& allocator;
  FramePlan& plan;
  Targets& frameTargets;
  const Tuning& tuning;
  Targets* eyeTargets = nullptr; ///< temporal reuse: of the frame's eye
  Board board;                   ///< what passes find, and what they leave
  Extent extent;
  LightVariant variant;
  RayPaths paths;
  const BandPaces* paces = nullptr; ///< what is known of earlier frames' draws
  Destination destination;
  std::string name;         ///< of the light, for statistics; else empty
  bool firstLight = true;   ///< of the frame: the one that brings the transmittance
  bool fillsLookup = false; ///< Frame::lookup: what is drawn is added to it, too
  int drawIndex = 0;        ///< of the light's draws, which add up
  int frameBlock = 0, lightBlock = 0, epipolarBlock = 0;
  /// Temporal reuse: only these slices, segments and tiles are drawn; 0: all are.
  gl::Uint drawnSlices = 0, drawnSegments = 0, drawnTiles = 0;
  bool drawsMarked = false; ///< the same: only pixels that the stencil has as changed

  /// A framebuffer of these textures, of which some may be the engine's.
  gl::Uint imageTarget(std::array<gl::Uint, 3> colours, bool withStencil);

  /// The texture of one of our resources, made if need be.
  gl::Uint textureOf(Resource resource);

protected:
  virtual Targets& holderOf(Lifetime lifetime) {
    return lifetime == Lifetime::Eye && eyeTargets ? *eyeTargets : frameTargets;
  }
  virtual int sideOf(Lifetime lifetime) const { return static_cast<void>(lifetime), 0; }

private:
  std::string titleOf(const std::string& pass) const { return name.empty() ? pass : name + " " + pass; }
  bool isOverChanges(Shape shape) const;
  Stencil stencilFor(Shape shape, Stencil stencil) const;
  void addReads(const PassRow& row, Draw& draw) const;
  void addTarget(const PassRow& row, const DrawOptions& options, Draw& draw);
  void addOwnTarget(const PassRow& row, int layer, bool withStencil, Draw& draw);
  void addVertices(Shape shape, bool changes, Draw& draw) const;
  void addBands(const PassRow& row, Draw& draw) const;
  void addLookupTarget(const DrawOptions& options, Draw& draw);
  Blend blendOf(Joining joining) const;
  gl::Uint destinationTarget(Blend blend, bool withStencil);
};

} // namespace tyndall
