// States with undo and redo.
#pragma once

#include <settings/State.h>
#include <string>
#include <vector>

namespace viewer {

class History {
public:
  /// Begins anew.
  void reset(const settings::State& state);

  const settings::State& state() const { return state_; }

  /// Another state from now on. Edits of one thing after another, a slider that is dragged, are undone together, until
  /// endEdit().
  void edit(const std::string& what, const settings::State& state);
  void endEdit() { last_.clear(); }

  /// The same without a step to undo: the camera, the animation's time.
  void move(const settings::State& state) { state_ = state; }

  bool canUndo() const { return !undone_.empty(); }
  bool canRedo() const { return !redone_.empty(); }
  /// What undo() would take back; empty if nothing.
  std::string nameOfUndo() const { return canUndo() ? undone_.back().what : std::string(); }
  std::string nameOfRedo() const { return canRedo() ? redone_.back().what : std::string(); }
  /// Camera, time, scene and size stay as they are.
  void undo();
  void redo();

private:
  struct Step {
    std::string what;
    settings::State state;
  };
  void swap(std::vector<Step>& from, std::vector<Step>& to);

  settings::State state_;
  std::vector<Step> undone_, redone_;
  std::string last_; ///< what the newest step edited, while more may join it
};

} // namespace viewer
