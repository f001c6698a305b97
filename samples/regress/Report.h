// The page that people look at: one file that needs no other.
#pragma once

#include "Result.h"

#include <string>
#include <vector>

namespace regress {

/// With which the page begins: a file that does is one of ours, and may be replaced by a later one.
inline constexpr const char* kReportMark = "<!DOCTYPE html><!-- tyndall-regress -->";

/// The worst first. `list`: the name of the list of cases. Throws host::Error if a picture cannot be read.
std::string reportPage(std::vector<Result> results, const Results& files, const std::string& list,
                       const std::string& timestamp);

} // namespace regress
