// What the driver's compiler says of every program that the effect and the AVSM may ask for.
#pragma once

#include "Who.h"

#include <atomic>
#include <functional>

namespace gpu {

/// Builds them one after the other, those that march first, and times each: texts to a program that is linked. `keep`
/// gets what is known from time to time and at the end, also if `stop` was set.
void buildPrograms(const std::function<void(const Json&)>& keep, const std::atomic<bool>& stop);

} // namespace gpu
