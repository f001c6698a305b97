#include "gl/Pause.h"

#include <utility>

namespace host {

namespace {

thread_local Pause* innermost = nullptr;

} // namespace

Pause::Pause(std::function<void()> between) : between_(std::move(between)), outer_(std::exchange(innermost, this)) {}

Pause::~Pause() { innermost = outer_; }

bool Pause::isWanted() { return innermost != nullptr; }

void Pause::take() {
  if (innermost) innermost->between_();
}

} // namespace host
