#include "CommandLine.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <scene/Error.h>
#include <scene/Tool.h>
#include <system_error>
#include <tyndall/tyndall.h>

namespace render {

void failUsage(const std::string& option, const std::string& value, const std::string& rule) {
  throw UsageError(fmt::format("{} {}: {}", option, value, rule));
}

int parseInt(const std::string& option, const std::string& value, int low, int high) {
  const auto number = parseWhole<int>(value);
  if (!number || *number < low || *number > high)
    failUsage(option, value, fmt::format("must be a whole number from {} to {}", low, high));
  return *number;
}

std::pair<int, int> parseSize(const std::string& option, const std::string& value, int least) {
  const std::vector<std::string> parts = split(value, 'x');
  const auto width = parseWhole<int>(parts.front()), height = parseWhole<int>(parts.back());
  if (parts.size() != 2 || !width || !height || std::min(*width, *height) < least ||
      std::max(*width, *height) > tyndall::kMaxImageSize)
    failUsage(option, value, fmt::format("must be WIDTHxHEIGHT, each from {} to {}", least, tyndall::kMaxImageSize));
  return {*width, *height};
}

host::ContextKind parseContext(const std::string& option, const std::string& value) {
  try {
    return host::parseContextKind(value);
  } catch (const host::Error&) {
    failUsage(option, value, "must be osmesa, egl or glfw");
  }
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

int runCommand(const char* name, const std::function<int()>& body) {
  constexpr int kWrongUsage = 2;
  return host::runTool(name, [&] {
    try {
      return body();
    } catch (const Answer& answer) {
      host::print(answer.text);
      return 0;
    } catch (const UsageError& error) {
      host::say(fmt::format("{}: {}", name, error.what()));
      host::say(fmt::format("usage: {0} [options]; {0} --help lists them", name));
      return kWrongUsage;
    }
  });
}

void parseArguments(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    throw Answer{app.help()};
  } catch (const CLI::CallForVersion& version) {
    throw Answer{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  for (const CLI::Option* option : app.get_options())
    for (const std::string& value : option->results())
      if (value.empty()) failUsage(option->get_name(), "\"\"", "must not be empty");
}

} // namespace render
