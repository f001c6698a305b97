// All methods by name.
#pragma once

#include "Method.h"

#include <functional>
#include <memory>

namespace avsmbench {

using MethodPointer = std::unique_ptr<Method>;

struct MethodEntry {
  std::string name;
  /// lists: of a map of this size, for methods without an Avsm of their own.
  std::function<MethodPointer(tyndall::Avsm& lists, const tyndall::AvsmConfig& config)> make;
};

const std::vector<MethodEntry>& allMethods();
const MethodEntry& methodNamed(const std::string& name); ///< throws host::Error

/// What the others' times are set against.
inline constexpr const char* kBaseline = "fourier 16";

/// Adaptive volumetric shadow maps, resolved by the effect.
MethodPointer makeAvsm(const tyndall::AvsmConfig& config);
/// The lists themselves.
MethodPointer makeLists(tyndall::Avsm& lists, int size);
/// Deep shadow map, off by at most a threshold.
MethodPointer makeDeep(tyndall::Avsm& lists, int size, float threshold);
/// Opacity shadow map, Fourier opacity map, and moments of absorbance.
MethodPointer makeOpacity(tyndall::Avsm& lists, int size, int slices);
MethodPointer makeFourier(tyndall::Avsm& lists, int size, int terms);
MethodPointer makeMoments(tyndall::Avsm& lists, int size, int moments);

} // namespace avsmbench
