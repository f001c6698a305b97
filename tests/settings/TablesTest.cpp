// The tables' ranges are those of the effect, and their texts can be read.
#include "CheckFrame.h"
#include "support/Catch.h"

#include <cmath>
#include <set>
#include <settings/Tables.h>

namespace {

using settings::Row;
using settings::Type;
using settings::Value;

tyndall::Frame validFrame() {
  tyndall::Frame frame;
  frame.viewport.width = frame.viewport.height = 1;
  frame.colour = frame.depth.texture = 1;
  frame.camera.clipFromView = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.002, -1, 0, 0, -0.2002, 0};
  return frame;
}

/// The ends of the range, and what is allowed besides.
std::vector<double> allowed(const Row& row) {
  std::vector<double> numbers = row.rule.also;
  if (row.type == Type::Switch || row.type == Type::Choice || !row.rule.only.empty()) return row.rule.only;
  numbers.push_back(row.rule.isLowOpen ? row.rule.low + 1e-6 : row.rule.low);
  numbers.push_back(row.rule.isHighOpen ? row.rule.high - 1e-6 : row.rule.high);
  return numbers;
}

/// Next to the ends, from outside.
std::vector<double> forbidden(const Row& row) {
  const double nothing = std::nan("");
  if (row.type == Type::Switch) return {};
  if (row.type == Type::Choice) return {-1, row.rule.only.back() + 1};
  std::vector<double> numbers = {row.type == Type::Whole ? row.rule.low : nothing};
  if (row.type == Type::Whole) numbers.clear();
  const double step = row.type == Type::Whole ? 1 : 1e-3;
  if (row.rule.low > -1e9) numbers.push_back(row.rule.isLowOpen ? row.rule.low : row.rule.low - step);
  const bool isOurs = row.rule.high >= 1e6; // the effect takes more than anyone wants
  if (!isOurs) numbers.push_back(row.rule.isHighOpen ? row.rule.high : row.rule.high + step);
  return numbers;
}

Value valueOf(const Row& row, double number) {
  return row.count() == 3 ? Value(number, number, number) : Value(number);
}

bool isAlso(const Row& row, double number) {
  for (const double other : row.rule.also)
    if (other == number) return true;
  return false;
}

/// partOf(frame) is what the table tells; the effect says no to what the rows do not allow, and only to that.
template <typename Owner, typename Part>
void checkRanges(const settings::Table<Owner>& table, const std::string& where, const tyndall::Frame& start,
                 const Part& partOf) {
  for (const settings::Setting<Owner>& row : table.rows) {
    for (const double number : allowed(row)) {
      tyndall::Frame frame = start;
      if (row.type == Type::Direction && number == 0) continue;
      row.set(partOf(frame), valueOf(row, number));
      const tyndall::Status status = checkValues(frame);
      CAPTURE(row.field, number, status.message);
      CHECK(settings::breachOf(row, valueOf(row, number)).empty());
      const bool isOfTwoFields = row.field == "debugView" || row.field == "technique" ||
                                 row.field.find("ConeAngle") != std::string::npos ||
                                 row.field.rfind("boundary", 0) == 0;
      CHECK((status || isOfTwoFields));
    }
    for (const double number : forbidden(row)) {
      if (isAlso(row, number)) continue;
      tyndall::Frame frame = start;
      row.set(partOf(frame), valueOf(row, number));
      const tyndall::Status status = checkValues(frame);
      CAPTURE(row.field, number, status.message);
      CHECK(!settings::breachOf(row, valueOf(row, number)).empty());
      CHECK(!status);
      CHECK_THAT(status.message, Catch::Contains(where + row.field));
    }
  }
}

template <typename Owner>
void checkTexts(const settings::Table<Owner>& table, std::set<std::string>& options) {
  std::set<std::string> fields;
  for (const settings::Setting<Owner>& row : table.rows) {
    CAPTURE(table.owner, row.field, row.help);
    CHECK(fields.insert(row.field).second);
    CHECK(!row.help.empty());
    CHECK(row.help.find('\n') == std::string::npos);
    CHECK(row.help.back() != '.');
    CHECK((row.option.empty() || (row.option.rfind("--", 0) == 0 && options.insert(row.option).second)));
    CHECK(settings::breachOf(row, row.get({})).empty()); // the default keeps the rule
    CHECK_FALSE(settings::ruleOf(row).empty());
  }
}

} // namespace

TEST_CASE("settings may be what the effect allows, and nothing else") {
  tyndall::Frame frame = validFrame();
  checkRanges(settings::settingsTable(), "settings.", frame, [](tyndall::Frame& f) -> auto& { return f.settings; });
  checkRanges(settings::reuseTable(), "reuse.", frame, [](tyndall::Frame& f) -> auto& { return f.reuse; });
  frame.medium.layers.resize(tyndall::kMaxHeightLayers);
  checkRanges(settings::layerTable(), "medium.layers[1].", frame,
              [](tyndall::Frame& f) -> auto& { return f.medium.layers[1]; });
  checkRanges(settings::mediumTable(), "medium.", frame, [](tyndall::Frame& f) -> auto& { return f.medium; });
  checkRanges(settings::ambientTable(), "ambient.", frame, [](tyndall::Frame& f) -> auto& { return f.ambient; });
  frame.medium.constituents.resize(1);
  checkRanges(settings::constituentTable(), "medium.constituents[0].", frame,
              [](tyndall::Frame& f) -> auto& { return f.medium.constituents[0]; });
}

TEST_CASE("a light may be what the effect allows, and nothing else") {
  settings::StateLight edited;
  for (const settings::Setting<settings::StateLight>& row : settings::lightTable().rows) {
    if (row.field == "on" || row.field == "follows" || row.field.rfind("boundary", 0) == 0) continue;
    const auto status = [&](double number) {
      tyndall::Frame frame = validFrame();
      settings::StateLight light;
      light.light.kind = row.field == "direction" || row.field == "cascadeFade" ? tyndall::LightKind::Directional
                                                                                : tyndall::LightKind::Spot;
      if (row.field == "outerConeAngle") light.light.innerConeAngle = 0;
      if (row.field == "innerConeAngle") light.light.outerConeAngle = 1.5707963267948966;
      row.set(light, valueOf(row, number));
      frame.lights = {light.light};
      return checkValues(frame);
    };
    for (const double number : allowed(row)) {
      if (row.type == Type::Direction || row.type == Type::Place) continue; // their ends are those of doubles
      CAPTURE(row.field, number, status(number).message);
      CHECK(status(number));
      CHECK(settings::breachOf(row, valueOf(row, number)).empty());
    }
    for (const double number : forbidden(row)) {
      CAPTURE(row.field, number, status(number).message);
      CHECK(!status(number));
      CHECK(!settings::breachOf(row, valueOf(row, number)).empty());
    }
  }
}

TEST_CASE("every setting has a name of its own, a line of help, and a default that keeps its rule") {
  std::set<std::string> options;
  checkTexts(settings::settingsTable(), options);
  checkTexts(settings::reuseTable(), options);
  checkTexts(settings::tuningTable(), options);
  checkTexts(settings::mediumTable(), options);
  checkTexts(settings::constituentTable(), options);
  checkTexts(settings::layerTable(), options);
  checkTexts(settings::ambientTable(), options);
  checkTexts(settings::fogTable(), options);
  checkTexts(settings::fogBankTable(), options);
  checkTexts(settings::lightTable(), options);
  checkTexts(settings::lookAtTable(), options);
  checkTexts(settings::pictureTable(), options);
  checkTexts(settings::mapsTable(), options);
  checkTexts(settings::volumesTable(), options);
  checkTexts(settings::pathTable(), options);
}

TEST_CASE("every setting of effect and tuning has an option") {
  const auto check = [](const auto& table) {
    for (const auto& row : table.rows) {
      CAPTURE(row.field);
      CHECK_FALSE(row.option.empty());
    }
  };
  check(settings::settingsTable());
  check(settings::reuseTable());
  check(settings::tuningTable());
}

TEST_CASE("rules say what is allowed") {
  const auto& table = settings::settingsTable();
  CHECK(settings::ruleOf(table["slices"]) == "a whole number from 1 to 8192");
  CHECK(settings::ruleOf(table["samples"]) == "a whole number from 64 to 8192, a multiple of 64");
  CHECK(settings::ruleOf(table["breakThreshold"]) == "a number above 0, at most 1000000");
  CHECK(settings::ruleOf(table["spreadThreshold"]) == "a number above 0, at most 1000000, or infinity");
  CHECK(settings::ruleOf(table["shadowFilter"]) == "one of nearest, bilinear");
  CHECK(settings::ruleOf(table["minMaxTree"]) == "on or off");
  CHECK(settings::ruleOf(settings::constituentTable()["g"]) == "a number between -1 and 1");
  CHECK(settings::ruleOf(settings::mediumTable()["absorption"]) == "three finite numbers, none negative");
  CHECK(settings::ruleOf(settings::lightTable()["direction"]) == "three finite numbers, not all 0");
  CHECK(settings::ruleOf(settings::pictureTable()["msaa"]) == "one of 1, 2, 4, 8");
}

TEST_CASE("a float that rounds onto an end that is not allowed breaks its rule") {
  const Row& g = settings::constituentTable()["g"];
  CHECK(settings::breachOf(g, 0.9999).empty());
  CHECK_FALSE(settings::breachOf(g, 0.9999999999).empty());
  const Row& threshold = settings::settingsTable()["breakThreshold"];
  CHECK_FALSE(settings::breachOf(threshold, 1e-60).empty());
}
