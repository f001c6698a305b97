// Work in processes of its own: what crashes or hangs takes nothing else with it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace regress {

struct Ending {
  int exitCode = 0;
  int signal = 0; ///< that ended it; 0: none
};

/// "ended by signal 11 (Segmentation fault)" and the like.
std::string describe(const Ending& ending, unsigned timeoutSeconds);

/// Runs each task in a child process, `jobs` at a time; a child ends after the timeout. `onEnd` hears of each in the
/// order of their ends; if it returns false no more are begun. Returns the signal that interrupted it, by which all
/// children ended too, or 0.
int runAll(const std::vector<std::function<int()>>& tasks, int jobs, unsigned timeoutSeconds,
           const std::function<bool(std::size_t task, const Ending& ending)>& onEnd);

/// What a child process writes to its standard output, which it also has as a file descriptor: a function that may load
/// what the parent must not. Empty if it fails.
std::string outputOf(const std::function<void(int descriptor)>& body);

/// The output of a program found on the PATH, without its standard error; empty if it fails.
std::string outputOf(const std::vector<std::string>& command);

} // namespace regress
