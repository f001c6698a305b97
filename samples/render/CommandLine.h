// What the command lines of Tyndall's tools share: errors that name option, value and rule, and how values are read
// that CLI11 cannot. Rules for options: OptionRules.h.
#pragma once

#include <charconv>
#include <functional>
#include <gl/Context.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CLI { // NOLINT(readability-identifier-naming): the name of CLI11
class App;
}

namespace render {

/// The command line breaks a rule: one line that names option, value and rule.
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// --help or --version was asked for: the text to print.
struct Answer {
  std::string text;
};

/// Throws UsageError.
[[noreturn]] void failUsage(const std::string& option, const std::string& value, const std::string& rule);

/// The number that all of the text is; none if it is anything else.
template <typename Number>
std::optional<Number> parseWhole(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  return number;
}

/// Throws UsageError unless it is a whole number from `low` to `high`.
int parseInt(const std::string& option, const std::string& value, int low, int high);

/// WIDTHxHEIGHT, each from `least` to tyndall::kMaxImageSize. Throws UsageError.
std::pair<int, int> parseSize(const std::string& option, const std::string& value, int least);

/// One run's part of many, of what is counted from 1: every `count`-th, from the `index`-th on.
struct Share {
  int index = 1;
  int count = 1;
};

/// K/N, 1 <= K <= N <= `most`. Throws UsageError.
Share parseShare(const std::string& option, const std::string& value, int most);

/// Throws UsageError.
host::ContextKind parseContext(const std::string& option, const std::string& value);

/// The parts between separators: at least one, which may be empty.
std::vector<std::string> split(const std::string& text, char separator);

/// The parts between single commas, none of them twice. Throws UsageError.
std::vector<std::string> splitList(const std::string& option, const std::string& text);

/// main() of a tool with options: host::runTool(), and 2 with a second line, how to get help, for a UsageError. An
/// Answer is printed.
int runCommand(const char* name, const std::function<int()>& body);

/// Fills in what `app` and its subcommands describe. Throws UsageError or Answer. Stricter than CLI11: an option given
/// as "" must not pass for one left out, whole numbers are decimal (neither 0x10 nor 1'000, and 010 is ten), others are
/// finite.
void parseArguments(CLI::App& app, int argc, const char* const* argv);

} // namespace render
