#include "optics/Jitter.h"
#include "passes/Lookup.h"
#include "passes/Unwarp.h"
#include "plan/PlanFrame.h"
#include "reuse/Redrawing.h"

#include <algorithm>
#include <memory>
#include <utility>

// Temporal reuse (Frame::reuse; Lin et al. 2013). An eye's picture, inscatter and transmittance, and its lights'
// epipolar textures are kept from frame to frame:
//
//   for each light:   depth, maps --> [sample ends], [rows], [changed ...], of what objects can have moved in the
//   slices that they reach, or of all --> changed segments and slices
//                     --> the passes of Epipolar.cpp, up to [interpolate], over those
//   for each light:   changed segments, scene depth, last depth --> [tiles] --> changed tiles, or [changed pixels] -->
//                     stencil (Tuning::reuse)
//   for each light:   epipolar inscatter --> [unwarp], fix-up, over those --> inscatter, transmittance
//   inscatter, transmittance --> [composite] --> colour
//
// A frame in which nothing has changed has the last step only; one in which everything has is drawn in full, and after
// some of those nothing is kept for a while.
namespace tyndall {

namespace {

// What stays as it is, or has no slices: the keys are this frame's.
KeptSlices carriedOver(const KeptLight& light, const LightRedraw& redraw) {
  KeptSlices next;
  if (redraw.redraw != Redraw::All && light.last) next = *light.last;
  next.key = redraw.key;
  next.maps = redraw.maps;
  return next;
}

void holdKept(KeptEye& eye, const RedrawPlan& redraw, const Extent& image) {
  if (redraw.picture != Redraw::All) eye.targets.hold(image);
  for (const LightRedraw& light : redraw.lights) {
    KeptLight& kept = *eye.lights[light.index];
    if (light.redraw != Redraw::All) kept.targets.hold(kept.last->extent);
  }
}

bool isWhole(const RedrawPlan& redraw) {
  return std::any_of(redraw.lights.begin(), redraw.lights.end(),
                     [](const LightRedraw& light) { return light.redraw == Redraw::All; });
}

} // namespace

Destination FramePlanner::keptDestination() const {
  Destination to;
  to.colour = colour_.texture;
  to.engines = engines();
  to.composite = frame_.colour != 0;
  to.ceiling = kLargestFloat / static_cast<float>(frame_.lights.size() + 1);
  to.inscatter = to.transmittance = 1; // of our own: made once it is known what of them is kept
  return to;
}

FrameKey FramePlanner::keyOf(const std::vector<DrawnLight>& drawn) const {
  FrameKey key{out_.plan.block<blocks::FrameBlock>(passes_.frameBlock),
               {},
               ambientKey(),
               {frame_.lookup, in_.textures.lookup, in_.lookupWrite},
               frame_.eyeCurves.curves,
               optics::slicesBeyond(frame_.camera),
               frame_.settings,
               {},
               {}};
  std::swap(key.jitter, key.block.jitter);
  key.block.depthFirst = {}; // where in its texture the depth is says no more than which texture it is
  key.block.depthLayer = 0;
  key.block.lookupSize = {}; // what is looked up is a key of its own
  key.block.lookupDepths = 0;
  key.block.lookupNear = key.block.lookupGrowth = 0;
  for (const DrawnLight& light : drawn) {
    key.drawn.push_back(light.index);
    key.lights.push_back({light.block, light.settings, in_.textures.shadows[light.index], light.variant,
                          frame_.lights[light.index].curves, light.copies});
  }
  return key;
}

void FramePlanner::planReused(const std::vector<DrawnLight>& drawn, RedrawPlan redraw) {
  KeptEye& eye = *in_.eye;
  eye.makeRoomFor(frame_.lights.size());
  holdKept(eye, redraw, passes_.extent);
  Destination& to = passes_.destination;
  to.inscatter = passes_.textureOf(Resource::Inscatter);
  to.transmittance = passes_.textureOf(Resource::Transmittance);
  KeptNext next{
      {redraw.key, depthOf(frame_), frame_.reuse.frame, eye.last && eye.last->hasDepth, frame_.camera}, {}, {}};
  Redraw picture = redraw.picture;
  if (picture != Redraw::Nothing) {
    planDepth();
    beginLookup();
  }
  Mask mask;
  if (picture == Redraw::Nothing) {
    out_.plan.skip("lights", "nothing has changed: the last frame's picture is shown");
    if (in_.textures.lookup.depths > 0)
      out_.plan.skip(rowOf(Pass::LookupSums).name, "nothing has changed: the textures are left alone");
    next.count.segments = 1;
  } else if (drawsInParts(frame_) && !drawn.empty()) {
    mask = planParts(drawn, redraw, next);
    picture = redraw.picture;
  } else {
    planLights(frame_, to, drawn);
  }
  if (next.lights.empty())
    for (const LightRedraw& light : redraw.lights)
      next.lights.emplace_back(light.index, carriedOver(*eye.lights[light.index], light));
  finishLookup();
  next.count.mayReuse = redraw.mayReuse;
  out_.next = std::move(next);
  copyToOutput(to.inscatter, inscatter_.texture);
  copyToOutput(to.transmittance, transmittance_.texture);
  if (!to.composite) return;
  if (frame_.settings.debugView == DebugView::Redrawn) showRedrawn(picture, mask);
  planPicture();
}

// Of the lights' slices and of the picture what has changed, which the mask holds.
FramePlanner::Mask FramePlanner::planParts(const std::vector<DrawnLight>& drawn, RedrawPlan& redraw, KeptNext& next) {
  reuse::Redrawing redrawing{*in_.eye, in_.counts, {}};
  Lights lights;
  Frame lit = frame_;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    lit.settings = drawn[i].settings;
    passes_.firstLight = i == 0;
    lights.push_back(std::make_unique<LightPlanner>(passes_, lit, drawn[i], in_.textures, in_.limits));
    reuse::planSlices(*lights.back(), redraw.lights[i], redrawing);
    next.lights.emplace_back(drawn[i].index, reuse::keptOf(*lights.back(), redraw.lights[i]));
  }
  if (isWhole(redraw)) redraw.picture = Redraw::All; // a light may have turned out not to be kept
  const Mask mask = redraw.picture == Redraw::Part ? planMask(lights, redraw) : Mask{};
  if (redraw.picture == Redraw::All || redraw.lights.front().comparesEnds) {
    drawMasked(Pass::KeepDepth, mask);
    next.picture.hasDepth = true;
  }
  use(mask, passes_);
  const bool ambient = planAmbient(passes_);
  use({}, passes_);
  for (const auto& light : lights) {
    light->firstLight = light == lights.front() && !ambient;
    use(mask, *light);
    passes::unwarp::plan(*light);
    if (passes_.fillsLookup) passes::lookup::addLight(*light, true);
  }
  next.count = std::move(redrawing.count);
  return mask;
}

void FramePlanner::use(const Mask& mask, PassPlanner& passes) {
  passes.drawnTiles = mask.tiles;
  passes.drawsMarked = mask.stencil;
}

void FramePlanner::drawMasked(Pass pass, const Mask& mask) {
  use(mask, passes_);
  passes_.draw(pass);
  use({}, passes_);
}

FramePlanner::Mask FramePlanner::planMask(const Lights& lights, const RedrawPlan& redraw) {
  const bool comparesDepth = redraw.lights.front().comparesEnds;
  Mask mask;
  bool begins = true;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (redraw.lights[i].redraw == Redraw::Nothing) continue;
    const bool compares = comparesDepth && i == 0;
    if (compares) lights[i]->board[Resource::LastDepth] = passes_.textureOf(Resource::LastDepth);
    reuse::planMask(*lights[i], compares, begins);
    mask.stencil = in_.tuning.reuse == Masking::Stencil;
    if (!mask.stencil) mask.tiles = lights[i]->board[Resource::ChangedTiles];
    begins = false;
  }
  return mask;
}

void FramePlanner::planRedrawn(bool comparesEnds, bool comparesRows) {
  KeptEye& eye = *in_.eye;
  passes_.eyeTargets = &eye.targets;
  begin(keptDestination());
  const std::vector<DrawnLight> drawn = lightsToDraw(frame_, passes_.destination);
  eye.makeRoomFor(frame_.lights.size());
  RedrawPlan redraw;
  redraw.key = keyOf(drawn);
  redraw.picture = frame_.depth.multisampled ? Redraw::All : Redraw::Part;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Light& light = frame_.lights[drawn[i].index];
    LightRedraw part{drawn[i].index, redraw.key.lights[i], mapsOf(light),
                     Redraw::Part,   comparesEnds,         comparesRows && light.shadow.texture != 0};
    eye.lights[part.index]->last = carriedOver(*eye.lights[part.index], part);
    redraw.lights.push_back(part);
  }
  planReused(drawn, std::move(redraw));
}

} // namespace tyndall
