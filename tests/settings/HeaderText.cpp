#include "HeaderText.h"

#include <algorithm>
#include <regex>
#include <set>
#include <settings/Tables.h>

namespace tests {

namespace {

std::string withoutComments(const std::string& text) { return std::regex_replace(text, std::regex("//[^\n]*"), ""); }

/// What stands between the braces behind `start`.
std::string bodyOf(const std::string& header, const std::string& start) {
  const std::string text = withoutComments(header);
  std::size_t at = text.find(start);
  if (at == std::string::npos) return {};
  at += start.size();
  std::size_t end = at;
  for (int depth = 1; end < text.size(); ++end) {
    depth += text[end] == '{' ? 1 : text[end] == '}' ? -1 : 0;
    if (depth == 0) break;
  }
  return text.substr(at, end - at);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0; // of braces and of templates' arguments
  for (const char c : text) {
    depth += c == '{' || c == '<' ? 1 : c == '}' || c == '>' ? -1 : 0;
    if (c == separator && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// The last word before an initialiser.
std::string nameIn(const std::string& declaration) {
  const std::string declared = declaration.substr(0, declaration.find_first_of("={"));
  std::smatch match;
  std::regex_search(declared, match, std::regex("(\\w+)\\s*$"));
  return match.empty() ? std::string() : match[1].str();
}

std::vector<std::string> namesIn(const std::string& body, char separator) {
  std::vector<std::string> names;
  for (const std::string& declaration : split(body, separator))
    for (const std::string& one : split(declaration, ','))
      if (const std::string name = nameIn(one); !name.empty()) names.push_back(name);
  return names;
}

template <typename Owner>
void addRows(std::set<std::string>& known, const std::string& name, const settings::Table<Owner>& table,
             const std::string& prefix = {}) {
  for (const auto& row : table.rows)
    if (row.field.rfind(prefix, 0) == 0 && (!prefix.empty() || row.field.find('.') == std::string::npos))
      known.insert(name + "." + row.field.substr(prefix.size()));
}

std::set<std::string> knownFields() {
  std::set<std::string> known;
  addRows(known, "Settings", settings::settingsTable());
  addRows(known, "Reuse", settings::reuseTable());
  addRows(known, "Tuning", settings::tuningTable());
  addRows(known, "Medium", settings::mediumTable());
  addRows(known, "Constituent", settings::constituentTable());
  addRows(known, "HeightLayer", settings::layerTable());
  addRows(known, "Ambient", settings::ambientTable());
  for (int i = 0; i < 9; ++i)
    known.erase("Ambient.harmonics[" + std::to_string(i) + "]"); // parts of one field
  addRows(known, "Light", settings::lightTable());
  addRows(known, "MediumBoundary", settings::lightTable(), "boundary.");
  known.erase("Light.on"); // which StateLight adds
  known.erase("Light.follows");
  for (const settings::Left& left : settings::leftToEngines())
    known.insert(left.field);
  return known;
}

} // namespace

std::vector<std::string> fieldsOf(const std::string& header, const std::string& name) {
  return namesIn(bodyOf(header, "struct " + name + " {"), ';');
}

std::vector<std::string> enumeratorsOf(const std::string& header, const std::string& name) {
  return namesIn(bodyOf(header, "enum class " + name + " {"), ';');
}

std::vector<std::string> unknownFields(const std::string& header) {
  const std::set<std::string> known = knownFields();
  std::set<std::string> declared;
  for (const char* name : {"Frame", "Config", "Settings", "Reuse", "Tuning", "Medium", "Constituent", "HeightLayer",
                           "Ambient", "Light", "MediumBoundary"})
    for (const std::string& field : fieldsOf(header, name))
      declared.insert(std::string(name) + "." + field);
  std::vector<std::string> unknown;
  std::set_symmetric_difference(known.begin(), known.end(), declared.begin(), declared.end(),
                                std::back_inserter(unknown));
  return unknown;
}

} // namespace tests
