// What the measurements say: speed at equal error, and how cost grows.
#pragma once

#include "Result.h"

#include <optional>

namespace bench {

/// A profile of ours beside the best of a group of baselines on the same setup.
struct EqualError {
  std::string setup;
  std::string profile;
  Group group = Group::Shipping;
  double milliseconds = 0;
  double rRmse = 0;
  std::string best;                ///< the family that needs the least time for that error; empty if none reaches it
  std::optional<double> bestTime;  ///< milliseconds that it needs
  std::string nearest;             ///< the family with the least error in the profile's time
  std::optional<double> bestError; ///< rRMSE that it has then; none if all are slower
  double leastError = 0;           ///< the least rRMSE that the group reaches at any time
  double leastErrorTime = 0;       ///< and what that takes
};

/// Every curve setup, every profile of ours, against the shipping and the research group.
std::vector<EqualError> equalErrors(const std::vector<Result>& results);

/// Time of a technique over what a scaling series varies: time ~ x^exponent.
struct Growth {
  std::string series;
  std::string technique;
  int points = 0;
  double exponent = 0;
  double first = 0, last = 0; ///< milliseconds at the least and the greatest x
  double range = 0;           ///< greatest x over least x
};

std::vector<Growth> growths(const std::vector<Result>& results);

/// One point of a family's curve.
struct Point {
  double milliseconds = 0;
  double rRmse = 0;
};

/// Time at which a curve reaches an error: the least over its points and, by straight lines on logarithmic axes,
/// between neighbours. None if it never does.
std::optional<double> timeForError(const std::vector<Point>& curve, double rRmse);

/// Error that a curve has after a time; none before its fastest point.
std::optional<double> errorAtTime(const std::vector<Point>& curve, double milliseconds);

} // namespace bench
