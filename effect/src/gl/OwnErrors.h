// Tells errors of ours from those that the engine has made and not asked for.
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"

#include <vector>

namespace tyndall::gl {

/// Asks GL for errors, which stalls threaded drivers: only around what may fail, an allocation or a binding to a target
/// that may be another. Construction takes the engine's pending errors, destruction makes GL raise them again, without
/// a message to its debug callback. Those of ours that were not taken are dropped.
class OwnErrors {
public:
  explicit OwnErrors(const Functions& gl);
  ~OwnErrors();
  OwnErrors(const OwnErrors&) = delete;
  OwnErrors& operator=(const OwnErrors&) = delete;

  /// The first error since construction or the last take(); NO_ERROR if there was none.
  Enum take();

  /// The context was lost before, or is: then each question is answered with an error.
  bool contextLost() const { return lost_; }

private:
  std::vector<Enum> askAll();

  const Functions& gl_;
  bool lost_ = false;
  std::vector<Enum> engines_;
};

} // namespace tyndall::gl
