// Whole numbers rounded up.
#pragma once

namespace tyndall {

/// How many units hold `count`.
constexpr int unitsFor(int count, int unit) { return (count + unit - 1) / unit; }

/// The multiple of `unit` that is not below `count`.
constexpr int roundedUp(int count, int unit) { return unitsFor(count, unit) * unit; }

} // namespace tyndall
