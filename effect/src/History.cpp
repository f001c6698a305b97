#include "History.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

namespace tyndall {

namespace {

constexpr int kLongestRest = 16;

// A block has no padding: all of it is what shaders read.
template <typename Block>
std::array<std::uint32_t, sizeof(Block) / 4> wordsOf(const Block& block) {
  std::array<std::uint32_t, sizeof(Block) / 4> words;
  std::memcpy(words.data(), &block, sizeof block);
  return words;
}

template <typename Block>
bool same(const Block& a, const Block& b) {
  return wordsOf(a) == wordsOf(b);
}

auto fieldsOf(const Settings& s) {
  return std::tie(s.technique, s.view, s.shadowFilter, s.slices, s.samples, s.rowStep, s.minMaxTree, s.breakThreshold,
                  s.bendThreshold, s.leastWeight, s.averageThreshold, s.spreadThreshold, s.lowRankTerms,
                  s.sampleBudget);
}

auto fieldsOf(const passes::exact::Variant& v) {
  return std::tie(v.lightKind, v.shadowViews, v.shadowArray, v.bilinear, v.glass, v.monochrome, v.multisampled,
                  v.composite);
}

bool isStated(std::uint64_t version, std::uint64_t last) { return version != 0 && version == last; }

// True if the same textures are stated to hold the same.
bool isStated(const DepthContent& now, const DepthContent& last) {
  return now.texture == last.texture && isStated(now.version, last.version);
}

bool isStated(const MapContent& now, const MapContent& last) {
  return now.shadow == last.shadow && now.glassColour == last.glassColour && now.glassDepth == last.glassDepth &&
         isStated(now.version, last.version);
}

DepthContent depthOf(const Frame& frame) { return {frame.depth.texture, frame.depth.version}; }

MapContent mapsOf(const Light& light) {
  return {light.shadow.texture, light.glass.colour, light.glass.depth, light.shadow.version};
}

bool same(const AvsmCurves& a, const AvsmCurves& b) {
  return a.texture == b.texture && (a.texture == 0 || isStated(a.version, b.version));
}

bool same(const LightKey& a, const LightKey& b) {
  return same(a.curves, b.curves) && same(a.block, b.block) && fieldsOf(a.settings) == fieldsOf(b.settings) &&
         a.map.width == b.map.width && a.map.height == b.map.height && fieldsOf(a.variant) == fieldsOf(b.variant);
}

} // namespace

std::uint64_t LightHistory::bytes() const {
  return kept.bytes() + ends[0].bytes() + ends[1].bytes() + rows[0].bytes() + rows[1].bytes();
}

bool drawsInParts(const Frame& frame) {
  return frame.settings.technique == Technique::Epipolar && !frame.depth.multisampled &&
         !std::isfinite(frame.settings.spreadThreshold);
}

bool ViewHistory::rests() {
  judge();
  if (rest_ == 0) return false;
  --rest_;
  valid_ = false;
  keepsDepth = false;
  picture_ = Redraw::All;
  return true;
}

Redraw ViewHistory::plan(const FrameKey& key, const Frame& frame) {
  const bool detects = frame.reuse.changes == Changes::Detect;
  bool all = !valid_ || !same(key.block, key_.block) || fieldsOf(key.settings) != fieldsOf(key_.settings) ||
             key.drawn != key_.drawn || (!detects && !isFollowedBy(frame));
  const bool inParts = drawsInParts(frame) && !key.drawn.empty();
  const bool sameDepth = detects ? isStated(depthOf(frame), depth_) : frame.objects.empty();
  all = all || (!sameDepth && (!inParts || !keepsDepth));
  while (lights_.size() < frame.lights.size())
    lights_.push_back(std::make_unique<LightHistory>(gl_));
  bool part = !sameDepth;
  for (std::size_t i = 0; i < key.drawn.size(); ++i) {
    planLight(key, i, frame, !all);
    const Redraw redraw = light(key.drawn[i]).redraw;
    part = part || redraw != Redraw::Nothing;
    all = all || redraw == Redraw::All || (redraw == Redraw::Part && !inParts);
  }
  mayReuse_ = valid_;
  key_ = key;
  picture_ = all ? Redraw::All : part ? Redraw::Part : Redraw::Nothing;
  return picture_;
}

void ViewHistory::planLight(const FrameKey& key, std::size_t i, const Frame& frame, bool sameFrame) {
  const std::size_t index = key.drawn[i];
  LightHistory& light = *lights_[index];
  const MapContent maps = mapsOf(frame.lights[index]);
  const bool hasMap = frame.lights[index].shadow.texture != 0, detects = frame.reuse.changes == Changes::Detect;
  const bool moves = !frame.objects.empty();
  light.comparesEnds = detects ? !isStated(depthOf(frame), depth_) : moves;
  light.comparesRows = hasMap && (detects ? !isStated(maps, light.maps) : moves);
  const bool changes = light.comparesEnds || light.comparesRows;
  const bool kept = sameFrame && light.valid && same(key.lights[i], light.key);
  light.redraw = !kept ? Redraw::All : changes || frame.reuse.refreshFrames > 0 ? Redraw::Part : Redraw::Nothing;
  light.key = key.lights[i];
  light.maps = maps;
  light.segments = light.changed = 0;
}

void ViewHistory::finish(const Frame& frame, bool drawn) {
  valid_ = drawn;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const bool used = std::find(key_.drawn.begin(), key_.drawn.end(), i) != key_.drawn.end();
    if (!used && lights_[i]->valid) lights_[i] = std::make_unique<LightHistory>(gl_); // gives its textures up
    lights_[i]->valid = drawn && used;
  }
  depth_ = depthOf(frame);
  frame_ = frame.reuse.frame;
  ++frames;
  fullShare_ = frame.reuse.fullShare;
  mayReuse_ = mayReuse_ && drawn;
}

void ViewHistory::judge() {
  if (!mayReuse_) return;
  mayReuse_ = false;
  const bool busy = redrawnShare() > fullShare_;
  if (busy && (busy_ || pause_ > 1)) {
    rest_ = pause_;
    pause_ = std::min(2 * pause_, kLongestRest);
  }
  if (!busy) pause_ = 1;
  busy_ = busy;
}

double ViewHistory::redrawnShare() {
  if (picture_ == Redraw::Nothing) return 0;
  std::uint64_t segments = 0, changed = 0;
  for (const std::size_t index : key_.drawn) {
    LightHistory& light = *lights_[index];
    if (light.changed < 0) {
      gl::Uint64 count = 0;
      gl_.GetQueryObjectui64v(light.count.name(), gl::QUERY_RESULT, &count);
      light.changed = static_cast<int>(count);
    }
    segments += static_cast<std::uint64_t>(light.segments);
    changed += static_cast<std::uint64_t>(light.changed);
  }
  return segments > 0 ? static_cast<double>(changed) / static_cast<double>(segments) : 1;
}

std::uint64_t ViewHistory::bytes() const {
  std::uint64_t sum = targets.bytes();
  for (const auto& light : lights_)
    sum += light->bytes();
  return sum;
}

ViewHistory& Histories::of(std::uint64_t view) {
  auto found = std::find_if(views_.begin(), views_.end(), [&](const auto& v) { return v->view() == view; });
  if (found == views_.end()) {
    if (views_.size() == kMostViews)
      views_.erase(
          std::min_element(views_.begin(), views_.end(), [](const auto& a, const auto& b) { return a->age < b->age; }));
    views_.push_back(std::make_unique<ViewHistory>(gl_, view));
    found = views_.end() - 1;
  }
  (*found)->age = ++clock_;
  return **found;
}

void Histories::forget(std::uint64_t view) {
  views_.erase(std::remove_if(views_.begin(), views_.end(), [&](const auto& v) { return v->view() == view; }),
               views_.end());
}

std::uint64_t Histories::bytes() const {
  std::uint64_t sum = 0;
  for (const auto& view : views_)
    sum += view->bytes();
  return sum;
}

} // namespace tyndall
