// States of which every setting may be anywhere in its range.
#pragma once

#include <random>
#include <settings/State.h>
#include <settings/Value.h>
#include <string>
#include <vector>

namespace settings {
struct Row;
}

namespace tests {

/// A value that keeps the row's rule: an end of its range, something between, or what is allowed besides.
settings::Value randomValue(const settings::Row& row, std::mt19937& random);

/// Keeps all rules.
settings::State randomState(unsigned seed);

/// The fields in which they differ, as "settings.slices".
std::vector<std::string> differences(const settings::State& a, const settings::State& b);

} // namespace tests
