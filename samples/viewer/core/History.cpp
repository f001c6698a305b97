#include "History.h"

#include <utility>

namespace viewer {

namespace {

constexpr std::size_t kMostSteps = 500;

/// What undo leaves alone is taken from `now`.
settings::State keeping(settings::State state, const settings::State& now) {
  state.scene = now.scene;
  state.camera = now.camera;
  state.lookAt = now.lookAt;
  state.seconds = now.seconds;
  state.width = now.width;
  state.height = now.height;
  return state;
}

} // namespace

void History::reset(const settings::State& state) {
  *this = {};
  state_ = state;
}

void History::edit(const std::string& what, const settings::State& state) {
  if (what != last_) undone_.push_back({what, state_});
  if (undone_.size() > kMostSteps) undone_.erase(undone_.begin());
  last_ = what;
  redone_.clear();
  state_ = state;
}

void History::swap(std::vector<Step>& from, std::vector<Step>& to) {
  if (from.empty()) return;
  Step step = std::move(from.back());
  from.pop_back();
  to.push_back({step.what, state_});
  state_ = keeping(std::move(step.state), state_);
  last_.clear();
}

void History::undo() { swap(undone_, redone_); }

void History::redo() { swap(redone_, undone_); }

} // namespace viewer
