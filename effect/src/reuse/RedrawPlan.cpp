#include "reuse/RedrawPlan.h"

#include <cmath>
#include <utility>

namespace tyndall {

namespace {

const KeptSlices* lastOf(const KeptLight& light) { return light.last ? &*light.last : nullptr; }

LightRedraw planLight(const KeptEye& eye, const FrameKey& key, std::size_t i, const Frame& frame, bool sameFrame) {
  LightRedraw light;
  light.index = key.drawn[i];
  light.key = key.lights[i];
  light.maps = mapsOf(frame.lights[light.index]);
  const KeptSlices* last = light.index < eye.lights.size() ? lastOf(*eye.lights[light.index]) : nullptr;
  const bool hasMap = frame.lights[light.index].shadow.texture != 0;
  if (frame.reuse.changes == Changes::Detect) {
    light.comparesEnds = !eye.last || !isStated(depthOf(frame), eye.last->depth);
    light.comparesRows = hasMap && (!last || !isStated(light.maps, last->maps));
  } else {
    light.comparesEnds = !frame.objects.empty();
    light.comparesRows = hasMap && light.comparesEnds;
  }
  if (!sameFrame || !eye.last || !last || !same(light.key, last->key)) return light;
  light.mixesEnds = last->mixedEnds || eye.last->key.jitter != key.jitter;
  const bool changes = light.comparesEnds || light.comparesRows || frame.reuse.refreshFrames > 0;
  light.redraw = changes ? Redraw::Part : Redraw::Nothing;
  return light;
}

} // namespace

bool drawsInParts(const Frame& frame) {
  return frame.settings.technique == Technique::Epipolar && !std::isfinite(frame.settings.spreadThreshold);
}

RedrawPlan planRedraw(const KeptEye& eye, FrameKey key, const Frame& frame) {
  RedrawPlan plan;
  const bool detects = frame.reuse.changes == Changes::Detect;
  const bool inParts = drawsInParts(frame) && !key.drawn.empty();
  const bool sameDepth = detects ? eye.last && isStated(depthOf(frame), eye.last->depth) : frame.objects.empty();
  bool all = !eye.last || !sameFrame(key, eye.last->key) || (!detects && !eye.isFollowedBy(frame));
  all = all || (!sameDepth && (!inParts || !eye.last->hasDepth));
  // Every pixel, but no slice.
  const bool pixels = !all && (key.jitter != eye.last->key.jitter || !same(key.ambient, eye.last->key.ambient) ||
                               !same(key.lookup, eye.last->key.lookup));
  bool part = !sameDepth;
  for (std::size_t i = 0; i < key.drawn.size(); ++i) {
    plan.lights.push_back(planLight(eye, key, i, frame, !all));
    const Redraw redraw = plan.lights.back().redraw;
    part = part || redraw != Redraw::Nothing;
    all = all || redraw == Redraw::All || (redraw == Redraw::Part && !inParts);
  }
  plan.mayReuse = eye.last.has_value();
  const bool wholly = all || pixels || (part && frame.depth.multisampled); // pixels are compared by one depth
  plan.picture = wholly ? Redraw::All : part ? Redraw::Part : Redraw::Nothing;
  plan.key = std::move(key);
  return plan;
}

} // namespace tyndall
