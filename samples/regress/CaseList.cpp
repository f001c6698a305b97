#include "CaseList.h"

#include "Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <render/CommandLine.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <set>

namespace regress {

namespace {

constexpr std::size_t kMaxName = 100;
/// What the tool itself gives, or what has no picture.
constexpr const char* kRefused[] = {"out", "stats", "context", "repeat", "help", "version"};

/// Values by option; true stands for a flag.
using OptionMap = std::map<std::string, Json>;

void addOption(OptionMap& options, const std::string& name, const Json& value, const std::string& where) {
  for (const char* refused : kRefused)
    if (name == refused) throw host::Error(fmt::format("{}: --{} is not an option of a case", where, name));
  if (!options.emplace(name, value).second) throw host::Error(fmt::format("{}: --{} is given twice", where, name));
}

OptionMap optionsOfWords(const Json& words, const std::string& where) {
  OptionMap options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = textOf(words[i], where);
    if (word.rfind("--", 0) != 0 || word.size() == 2)
      throw host::Error(fmt::format("{}: \"{}\": must be an option, --name", where, host::printable(word)));
    const std::size_t equals = word.find('=');
    const bool hasNext = i + 1 < words.size() && textOf(words[i + 1], where).rfind("--", 0) != 0;
    Json value = true;
    if (equals != std::string::npos)
      value = word.substr(equals + 1);
    else if (hasNext)
      value = words[++i];
    addOption(options, word.substr(2, equals == std::string::npos ? equals : equals - 2), value, where);
  }
  return options;
}

OptionMap optionsOf(const Json& json, const std::string& where) {
  if (json.is_array()) return optionsOfWords(json, where);
  if (!json.is_object()) throw host::Error(where + ": must be an object, or a list of words");
  OptionMap options;
  for (const auto& [name, value] : json.items())
    addOption(options, name, value, where);
  return options;
}

std::vector<std::string> wordsOf(const OptionMap& options, const std::string& where) {
  std::vector<std::string> words;
  for (const auto& [name, value] : options) {
    if (value.is_string())
      words.push_back(fmt::format("--{}={}", name, value.get<std::string>()));
    else if (value.is_number())
      words.push_back(fmt::format("--{}={}", name, value.dump()));
    else if (!value.is_boolean())
      throw host::Error(fmt::format("{}.{}: must be a text, a number, true or false", where, name));
    else if (value.get<bool>())
      words.push_back("--" + name);
  }
  return words;
}

double limitOf(const Json& value, const std::string& where) {
  if (!value.is_number() || value.get<double>() < 0) throw host::Error(where + ": must be a number of at least 0");
  return value.get<double>();
}

Tolerance toleranceOf(const Json& json, Tolerance tolerance, const std::string& where) {
  requireFields(json, {"rrmse", "p99", "max", "pixel", "over", "flip"}, where);
  const auto read = [&](const char* name, auto& limit) {
    if (json.contains(name)) limit = limitOf(json.at(name), where + "." + name);
  };
  read("rrmse", tolerance.rRmse);
  read("p99", tolerance.p99);
  read("max", tolerance.max);
  read("pixel", tolerance.pixel);
  read("over", tolerance.over);
  read("flip", tolerance.flip);
  return tolerance;
}

std::string nameOf(const Json& json, const std::string& where) {
  if (!json.contains("name")) throw host::Error(where + ": lacks a name");
  std::string name = textOf(json.at("name"), where + ".name");
  const auto isLetter = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.'; };
  if (name.empty() || name.size() > kMaxName || !std::all_of(name.begin(), name.end(), isLetter) || name[0] == '.' ||
      name[0] == '-')
    throw host::Error(
        fmt::format("{}.name \"{}\": must be 1 to {} letters, digits, - _ or ., and begin with none of - .", where,
                    host::printable(name), kMaxName));
  return name;
}

render::Options parsed(const std::vector<std::string>& words, const std::filesystem::path& scene) {
  const std::string sceneName = scene.string();
  std::vector<const char*> arguments = {"tyndall-render", sceneName.c_str()};
  for (const std::string& word : words)
    arguments.push_back(word.c_str());
  return render::parseOptions(static_cast<int>(arguments.size()), arguments.data());
}

struct Defaults {
  OptionMap options;
  Tolerance tolerance;
};

Case caseOf(const Json& json, const Defaults& defaults, const std::filesystem::path& list,
            const std::filesystem::path& scenes, const std::string& place) {
  requireFields(json, {"name", "scene", "options", "tolerance"}, place);
  Case result;
  result.name = nameOf(json, place);
  const std::string where = fmt::format("{}: case {}", host::printable(list.string()), result.name);
  if (!json.contains("scene")) throw host::Error(where + ": lacks a scene");
  OptionMap options;
  if (json.contains("options")) options = optionsOf(json.at("options"), where + ": options");
  options.insert(defaults.options.begin(), defaults.options.end());
  result.words = wordsOf(options, where + ": options");
  result.tolerance = defaults.tolerance;
  if (json.contains("tolerance"))
    result.tolerance = toleranceOf(json.at("tolerance"), defaults.tolerance, where + ": tolerance");
  try {
    result.options = parsed(result.words, scenes / textOf(json.at("scene"), where + ": scene"));
  } catch (const render::UsageError& error) {
    throw host::Error(where + ": " + error.what());
  }
  if (result.options.mediumFile) result.options.mediumFile = list.parent_path() / *result.options.mediumFile;
  return result;
}

/// Whether * for any letters and ? for one make the pattern the name. What a * has taken is only ever given up for the
/// next *, so that no pattern takes longer than its length times the name's.
bool fits(const std::string& name, const std::string& pattern) {
  std::size_t n = 0, p = 0, star = std::string::npos, taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != std::string::npos) {
      p = star + 1;
      n = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string::npos;
}

} // namespace

std::vector<Case> readCases(const std::filesystem::path& list, const std::filesystem::path& scenes) {
  const std::string name = host::printable(list.string());
  const Json json = readJson(list);
  requireFields(json, {"format", "defaults", "cases"}, name);
  requireFormat(json, name);
  Defaults defaults;
  if (json.contains("defaults")) {
    const std::string where = name + ": defaults";
    requireFields(json.at("defaults"), {"options", "tolerance"}, where);
    if (json["defaults"].contains("options"))
      defaults.options = optionsOf(json["defaults"]["options"], where + ".options");
    if (json["defaults"].contains("tolerance"))
      defaults.tolerance = toleranceOf(json["defaults"]["tolerance"], {}, where + ".tolerance");
  }
  if (!json.contains("cases") || !json.at("cases").is_array() || json.at("cases").empty())
    throw host::Error(name + ": cases: must be a list that is not empty");
  std::vector<Case> cases;
  std::set<std::string> names;
  for (const Json& one : json.at("cases")) {
    cases.push_back(caseOf(one, defaults, list, scenes, fmt::format("{}: cases[{}]", name, cases.size())));
    if (!names.insert(cases.back().name).second)
      throw host::Error(fmt::format("{}: case {}: its name is taken by one before it", name, cases.back().name));
  }
  return cases;
}

std::vector<Case> only(const std::vector<Case>& cases, const std::string& pattern) {
  std::vector<Case> chosen;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(chosen),
               [&](const Case& one) { return fits(one.name, pattern); });
  if (!chosen.empty()) return chosen;
  std::string names;
  for (const Case& one : cases)
    names += (names.empty() ? "" : ", ") + one.name;
  render::failUsage("--only", pattern, "no case of the list has this name; there are " + names);
}

std::vector<Case> shareOf(const std::vector<Case>& cases, const render::Share& share) {
  std::vector<Case> chosen;
  for (std::size_t i = share.index - 1; i < cases.size(); i += share.count)
    chosen.push_back(cases[i]);
  return chosen;
}

} // namespace regress
