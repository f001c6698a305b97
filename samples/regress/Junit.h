// Results for build servers.
#pragma once

#include "Result.h"

#include <string>
#include <vector>

namespace regress {

/// A test suite: what differs is a failure, what could not be judged an error.
std::string junitXml(const std::vector<Result>& results, const std::string& timestamp);

} // namespace regress
