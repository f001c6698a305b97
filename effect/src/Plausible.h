// Rules that compare the fields of a frame with each other: matrices that each are fine and cannot belong together.
#pragma once

#include <string>
#include <tyndall/tyndall.h>
#include <utility>
#include <vector>

namespace tyndall {

/// What was found: the first that is certainly wrong, and all that is allowed but seldom meant.
struct Findings {
  std::vector<std::string>& warnings;
  Status error = {};

  void wrong(Status status) {
    if (error) error = std::move(status);
  }
};

/// In double, on the CPU; allocates nothing where nothing is found. The frame's values must have passed (checkValues).
Status checkPlausible(const Frame& frame, std::vector<std::string>& warnings);

/// The part of it that is about a light's shadow views; the light has some.
void checkViews(const Frame& frame, std::size_t light, Findings& findings);

} // namespace tyndall
