// No field of the public header is forgotten.
#include "HeaderText.h"
#include "support/Catch.h"

#include <fstream>
#include <settings/Tables.h>
#include <sstream>

namespace {

std::string header() {
  std::ifstream file(TYNDALL_HEADER);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string with(std::string text, const std::string& what, const std::string& instead) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), instead);
}

template <typename Owner>
void checkEnumerators(const settings::Table<Owner>& table, const std::string& text) {
  for (const auto& row : table.rows) {
    if (row.type != settings::Type::Choice) continue;
    std::vector<std::string> known;
    for (const settings::Choice& choice : row.choices)
      known.emplace_back(choice.enumerator);
    CAPTURE(row.field);
    CHECK(tests::enumeratorsOf(text, row.enumeration) == known);
  }
}

} // namespace

TEST_CASE("every field of tyndall.h is a setting, or said to be the engine's") {
  CHECK(tests::unknownFields(header()) == std::vector<std::string>());
}

TEST_CASE("a new field, or one of another name, is found not to be a setting") {
  const std::string text = header();
  using Names = std::vector<std::string>;
  CHECK(tests::unknownFields(with(text, "  int slices = 1152;", "  int slices = 1152, slabs = 3;")) ==
        Names{"Settings.slabs"});
  CHECK(tests::unknownFields(with(text, "  Rgb absorption = {0, 0, 0};", "  Rgb loss = {0, 0, 0};")) ==
        Names{"Medium.absorption", "Medium.loss"});
  CHECK(tests::unknownFields(with(text, "  MediumBoundary boundary;",
                                  "  MediumBoundary boundary;\n  std::array<int, 2> size{};")) == Names{"Light.size"});
}

TEST_CASE("every enumerator of tyndall.h may be chosen") {
  const std::string text = header();
  checkEnumerators(settings::settingsTable(), text);
  checkEnumerators(settings::tuningTable(), text);
  checkEnumerators(settings::constituentTable(), text);
  checkEnumerators(settings::lightTable(), text);
  std::vector<std::string> profiles;
  for (const settings::Choice& profile : settings::kProfiles)
    profiles.emplace_back(profile.enumerator);
  CHECK(tests::enumeratorsOf(text, "Profile") == profiles);
}
