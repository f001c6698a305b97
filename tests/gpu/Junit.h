// JUnit XML as Catch2 writes it.
#pragma once

#include <string>
#include <vector>

namespace gpu {

/// What a file of one case says of it: the texts of its failures, one after the other.
std::string failuresIn(const std::string& xml);

/// One document of several, each the whole text of a file: their test suites.
std::string joinedJunit(const std::vector<std::string>& documents);

/// A suite of one case that left no file: skipped, or ended by a signal.
std::string suiteOf(const std::string& name, const std::string& result, const std::string& message);

} // namespace gpu
