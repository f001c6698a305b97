#include "reuse/Kept.h"

#include <algorithm>

namespace tyndall {

void KeptEye::makeRoomFor(std::size_t count) {
  while (lights.size() < count)
    lights.push_back(std::make_unique<KeptLight>(gl_, framebuffers_));
}

// Textures of a light that is not drawn any more are given up at once.
void KeptEye::take(const Frame& frame, std::optional<KeptNext> next) {
  std::vector<bool> drawn(lights.size());
  if (next)
    for (const auto& [index, slices] : next->lights) {
      lights[index]->last = slices;
      drawn[index] = true;
    }
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (drawn[i]) continue;
    if (next) lights[i] = std::make_unique<KeptLight>(gl_, framebuffers_);
    lights[i]->last.reset();
  }
  ++frames;
  fullShare = frame.reuse.fullShare;
  if (!next) return last.reset();
  targets.endFrame();
  for (const auto& light : lights)
    light->targets.endFrame();
  last = std::move(next->picture);
  counts.add(std::move(next->count));
}

void KeptEye::giveUp() {
  last.reset();
  for (const auto& light : lights)
    light->last.reset();
}

std::uint64_t KeptEye::bytes() const {
  std::uint64_t sum = targets.bytes();
  for (const auto& light : lights)
    sum += light->targets.bytes();
  return sum;
}

KeptEye& KeptEyes::of(std::uint64_t id) {
  auto found = std::find_if(eyes_.begin(), eyes_.end(), [&](const auto& eye) { return eye->id == id; });
  if (found == eyes_.end()) {
    if (eyes_.size() == kMostEyes)
      eyes_.erase(
          std::min_element(eyes_.begin(), eyes_.end(), [](const auto& a, const auto& b) { return a->age < b->age; }));
    eyes_.push_back(std::make_unique<KeptEye>(gl_, framebuffers_, id));
    found = eyes_.end() - 1;
  }
  (*found)->age = ++clock_;
  return **found;
}

KeptEye* KeptEyes::find(std::uint64_t id) {
  const auto found = std::find_if(eyes_.begin(), eyes_.end(), [&](const auto& eye) { return eye->id == id; });
  return found == eyes_.end() ? nullptr : found->get();
}

void KeptEyes::forget(std::uint64_t id) {
  eyes_.erase(std::remove_if(eyes_.begin(), eyes_.end(), [&](const auto& eye) { return eye->id == id; }), eyes_.end());
}

std::uint64_t KeptEyes::bytes() const {
  std::uint64_t sum = 0;
  for (const auto& eye : eyes_)
    sum += eye->bytes();
  return sum;
}

} // namespace tyndall
