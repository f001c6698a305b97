#include "ReuseModel.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace tyndall;

namespace stress {

namespace {

constexpr int kKeptEyes = 4;

bool isStated(const Content& now, const Content& last) {
  return now.version != 0 && now.version == last.version && now.place == last.place;
}

bool areStated(const FrameFacts& now, const FrameFacts& last) {
  return now.maps.size() == last.maps.size() && isStated(now.depth, last.depth) &&
         std::equal(now.maps.begin(), now.maps.end(), last.maps.begin(), isStated);
}

bool holdOthers(const FrameFacts& now, const FrameFacts& last) {
  const auto differ = [](const Content& a, const Content& b) { return a.holds != b.holds; };
  if (now.maps.size() != last.maps.size() || differ(now.depth, last.depth)) return true;
  return !std::equal(now.maps.begin(), now.maps.end(), last.maps.begin(),
                     [&](const Content& a, const Content& b) { return !differ(a, b); });
}

} // namespace

void Rests::judge(bool busy) {
  constexpr int kLongest = 16;
  if (busy && (busy_ || pause_ > 1)) {
    rest_ = pause_;
    pause_ = std::min(2 * pause_, kLongest);
  }
  if (!busy) pause_ = 1;
  busy_ = busy;
}

bool Rests::takeOne() { return rest_ > 0 && rest_-- > 0; }

// Of the eyes used since then some may have been given up, so that more than four were used.
bool ReuseModel::isSurelyGone(std::uint64_t id, const Eye& eye) const {
  const auto since = std::max(eye.surelyUsed, eye.possiblyUsed);
  return std::count_if(eyes_.begin(), eyes_.end(), [&](const auto& other) {
           return other.first != id && other.second.surelyUsed > since;
         }) >= kKeptEyes;
}

bool ReuseModel::isSurelyKept(std::uint64_t id, const Eye& eye) const {
  auto others = std::count_if(eyes_.begin(), eyes_.end(), [&](const auto& other) {
    return other.first != id && std::max(other.second.surelyUsed, other.second.possiblyUsed) > eye.surelyUsed;
  });
  others += std::count_if(forgotten_.begin(), forgotten_.end(), [&](const auto& other) {
    return other.second > eye.surelyUsed && eyes_.count(other.first) == 0;
  });
  return others < kKeptEyes;
}

Share ReuseModel::compare(const FrameFacts& last, const FrameFacts& frame) {
  const bool objects = frame.changes == Changes::Objects;
  if (frame.shared != last.shared || (objects && frame.frame != last.frame + 1)) return Share::All;
  const bool stated = objects ? !frame.namesObjects : areStated(frame, last);
  const bool differs = objects ? frame.namesObjects : holdOthers(frame, last);
  if (!frame.drawsInParts && differs) return Share::All;
  if (frame.everything == last.everything && stated && frame.refreshFrames == 0 && frame.jitter == last.jitter)
    return Share::Nothing;
  return Share::Any;
}

ReuseModel::Prediction ReuseModel::predict(const FrameFacts& frame) {
  if (frame.changes == Changes::Unknown) return {Share::All};
  auto found = eyes_.find(frame.eye);
  if (found != eyes_.end() && isSurelyGone(frame.eye, found->second)) {
    eyes_.erase(found);
    found = eyes_.end();
  }
  if (found == eyes_.end()) return {Share::All};
  Eye& eye = found->second;
  if (!isSurelyKept(frame.eye, eye)) eye.sure = eye.restsKnown = false;
  if (eye.counted) eye.rests.judge(*std::exchange(eye.counted, {}));
  eye.resting = eye.restsKnown && eye.rests.takeOne();
  if (eye.resting || !frame.isPicture) return {frame.isPicture || eye.resting ? Share::All : Share::Any};
  if (eye.sure && !eye.last) return {Share::All};
  eye.jittered = eye.jittered || frame.jitter != std::array<double, 2>{0, 0};
  if (!eye.last) return {Share::Any, eye.jittered};
  Share share = compare(*eye.last, frame);
  if (!eye.sure || (share == Share::Nothing && !eye.restsKnown))
    share = share == Share::All && eye.sure ? share : Share::Any;
  const bool moves = frame.jitter != eye.last->jitter;
  const bool mixes = eye.jittered && share != Share::All && (eye.mixed || moves || !eye.sure);
  return {share, mixes, share == Share::Nothing};
}

void ReuseModel::drawn(const FrameFacts& frame, double share) {
  ++clock_;
  if (frame.changes == Changes::Unknown) {
    eyes_.erase(frame.eye);
    forgotten_[frame.eye] = clock_;
    return;
  }
  Eye& eye = eyes_[frame.eye];
  eye.surelyUsed = clock_;
  eye.jittered = eye.jittered || frame.jitter != std::array<double, 2>{0, 0};
  if (eye.resting) {
    eye.last.reset();
    eye.sure = true;
    return;
  }
  if (!frame.isPicture) {
    eye.sure = false;
    return;
  }
  if (eye.last && eye.sure)
    eye.counted = share > static_cast<double>(frame.fullShare);
  else if (!eye.sure)
    eye.restsKnown = false;
  const bool full = !eye.last || compare(*eye.last, frame) == Share::All;
  const bool moves = eye.last && frame.jitter != eye.last->jitter;
  eye.mixed = eye.sure ? !full && (eye.mixed || moves) : true;
  eye.sure = true;
  eye.last = frame;
  if (!frame.namesMeshes) return;
  eye.last->depth.version = 0;
  for (Content& map : eye.last->maps)
    map.version = 0;
}

void ReuseModel::failed(const FrameFacts& frame, StatusCode code) {
  ++clock_;
  if (frame.changes == Changes::Unknown) {
    if (code == StatusCode::InvalidFrame) return;
    forgotten_[frame.eye] = clock_;
  }
  if (frame.changes == Changes::Unknown && eyes_.count(frame.eye) == 0) return;
  Eye& eye = eyes_[frame.eye];
  eye.possiblyUsed = clock_;
  eye.sure = eye.restsKnown = false;
}

} // namespace stress
