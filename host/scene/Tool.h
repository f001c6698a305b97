// What the main() of each command-line tool does: standard streams that may be closed, full or read by nobody, signals,
// and errors of one line.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace host {

/// Runs a tool and returns its exit status: the body's, or 1 with a line on standard error for what it throws or if
/// standard output did not take all that was written to it.
///
/// Before it runs, what is closed of standard input, output and error is held open by /dev/null, so that no file
/// opened later gets its number and a note within; pipes without a reader and files beyond the size limit become errors
/// of the writes, which are reported; and signals that end the process remove unfinished files first.
int runTool(const char* name, const std::function<int()>& body);

/// A line on standard error for whoever looks on. Lost where it cannot be written: that is no reason to stop.
void say(std::string_view line);

/// The same as it is: neither printable() nor with a line's end.
void sayRaw(std::string_view text);

/// Adds to the result on standard output. Throws Error if it cannot be written.
void print(std::string_view text);

} // namespace host
