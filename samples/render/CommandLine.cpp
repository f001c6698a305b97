#include "OptionRules.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <scene/Tool.h>
#include <system_error>
#include <tyndall/tyndall.h>

namespace render {

namespace {

/// What was given may hold line breaks.
std::string oneLine(std::string text) {
  std::replace_if(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

/// What CLI11 would let pass.
std::string strictNumber(std::string& text, bool whole) {
  if (const auto number = parseWhole<std::int64_t>(text); whole && number) {
    text = std::to_string(*number);
    return {};
  }
  if (const auto number = parseWhole<double>(text); !whole && number && std::isfinite(*number)) return {};
  return fmt::format("{} is not a {} number", text, whole ? "whole" : "finite");
}

void makeStrict(CLI::Option& option) {
  const std::string type = option.get_type_name();
  const bool whole = type.rfind("INT", 0) == 0, number = whole || type.rfind("FLOAT", 0) == 0;
  option.transform(CLI::Validator(
      [whole, number](std::string& text) {
        if (text.empty()) return std::string("must not be empty");
        return number ? strictNumber(text, whole) : std::string();
      },
      ""));
}

} // namespace

const Names<host::ContextKind> kContextNames = {
    {"osmesa", host::ContextKind::Osmesa}, {"egl", host::ContextKind::Egl}, {"glfw", host::ContextKind::Glfw}};

CLI::Validator numberThat(const std::string& rule, const std::function<bool(double)>& holds) {
  return CLI::Validator(
      [rule, holds](std::string& text) {
        const auto number = parseWhole<double>(text);
        return number && holds(*number) ? std::string() : text + " " + rule;
      },
      "");
}

std::function<std::string(const std::string&)> oneOf(const std::string& option, const std::vector<std::string>& names) {
  return [option, names](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      failUsage(option, name, fmt::format("must be one of {}", fmt::join(names, ", ")));
    return name;
  };
}

void failUsage(const std::string& option, const std::string& value, const std::string& rule) {
  throw UsageError(oneLine(fmt::format("{} {}: {}", option, value, rule)));
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

Share parseShare(const std::string& option, const std::string& value, int most) {
  const std::vector<std::string> parts = split(value, '/');
  const auto index = parseWhole<int>(parts.front()), count = parseWhole<int>(parts.back());
  if (parts.size() != 2 || !index || !count || *index < 1 || *count < *index || *count > most)
    failUsage(option, value, fmt::format("must be K/N, 1 <= K <= N <= {}", most));
  return {*index, *count};
}

host::ContextKind parseContext(const std::string& option, const std::string& value) {
  for (const auto& [name, kind] : kContextNames)
    if (name == value) return kind;
  failUsage(option, value, "must be osmesa, egl or glfw");
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

std::vector<std::string> splitList(const std::string& option, const std::string& text) {
  std::vector<std::string> parts = split(text, ',');
  for (auto part = parts.begin(); part != parts.end(); ++part) {
    if (part->empty()) failUsage(option, "\"" + text + "\"", "must be a list separated by single commas");
    if (std::find(parts.begin(), part, *part) != part) failUsage(option, text, "names " + *part + " twice");
  }
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
  std::vector<CLI::App*> parts = app.get_subcommands({});
  parts.push_back(&app);
  for (CLI::App* part : parts)
    for (CLI::Option* option : part->get_options())
      makeStrict(*option);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    throw Answer{app.help()};
  } catch (const CLI::CallForVersion& version) {
    throw Answer{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& error) {
    throw UsageError(oneLine(error.what()));
  }
}

} // namespace render
