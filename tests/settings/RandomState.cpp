#include "RandomState.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <settings/Tables.h>

namespace tests {

namespace {

using settings::Row;
using settings::Rule;
using settings::Value;

int below(int count, std::mt19937& random) { return std::uniform_int_distribution<int>(0, count - 1)(random); }

double randomNumber(const Row& row, std::mt19937& random) {
  const Rule& rule = row.rule;
  if (!rule.only.empty()) return rule.only[static_cast<std::size_t>(below(static_cast<int>(rule.only.size()), random))];
  const double share = std::uniform_real_distribution<double>(0, 1)(random);
  const int way = below(6, random);
  double number = rule.low / 2 * (1 - share) * 2 + rule.high * share;
  if (way == 0 && !rule.isLowOpen) number = rule.low;
  if (way == 1 && !rule.isHighOpen) number = rule.high;
  if (way > 1 && rule.high > 1e9) number = rule.low < 0 ? 100 * share - 50 : 100 * share; // as people have them
  if (row.type == settings::Type::Whole) number = std::floor(number / rule.multipleOf) * rule.multipleOf;
  return rule.low <= 0 ? number : std::max(number, rule.low);
}

template <typename Owner>
void randomise(Owner& owner, const settings::Table<Owner>& table, std::mt19937& random) {
  for (const auto& row : table.rows)
    if (below(3, random) > 0) row.set(owner, randomValue(row, random));
}

void randomiseKept(settings::State& state, std::mt19937& random) {
  if (below(2, random) == 0) {
    state.compared.emplace();
    state.compared->profile = static_cast<tyndall::Profile>(below(4, random));
    state.compared->settings = tyndall::settingsOf(state.compared->profile);
    randomise(state.compared->settings, settings::settingsTable(), random);
  }
  state.path.resize(static_cast<std::size_t>(below(4, random)));
  double seconds = 0;
  for (settings::PathPoint& point : state.path) {
    randomise(point, settings::pathTable(), random);
    point.seconds = seconds += std::uniform_real_distribution<double>(0, 1)(random);
  }
}

void randomiseScene(settings::State& state, std::mt19937& random) {
  if (below(2, random) == 0) {
    state.lookAt.emplace();
    randomise(*state.lookAt, settings::lookAtTable(), random);
  } else if (below(2, random) == 0) {
    state.camera = below(10, random);
  }
  if (below(2, random) == 0) {
    state.medium.emplace();
    randomise(*state.medium, settings::mediumTable(), random);
    state.medium->constituents.resize(static_cast<std::size_t>(below(tyndall::kMaxConstituents + 1, random)));
    for (tyndall::Constituent& constituent : state.medium->constituents)
      randomise(constituent, settings::constituentTable(), random);
    state.medium->layers.resize(static_cast<std::size_t>(below(tyndall::kMaxHeightLayers + 1, random)));
    for (tyndall::HeightLayer& layer : state.medium->layers)
      randomise(layer, settings::layerTable(), random);
    const int last = static_cast<int>(state.medium->layers.size()) - 1;
    for (tyndall::Constituent& constituent : state.medium->constituents)
      constituent.layer = std::min(constituent.layer, last);
    state.medium->absorptionLayer = std::min(state.medium->absorptionLayer, last);
  }
  if (below(2, random) == 0) {
    state.ambient.emplace();
    randomise(*state.ambient, settings::ambientTable(), random);
  }
  if (below(2, random) == 0) {
    state.fog.emplace();
    randomise(*state.fog, settings::fogTable(), random);
    state.fog->banks.resize(static_cast<std::size_t>(below(host::kMostFogBanks + 1, random)));
    for (host::FogBank& bank : state.fog->banks)
      randomise(bank, settings::fogBankTable(), random);
  }
  if (below(2, random) == 0) {
    state.lights.emplace(static_cast<std::size_t>(below(tyndall::kMaxLights + 1, random)));
    for (settings::StateLight& light : *state.lights) {
      randomise(light, settings::lightTable(), random);
      light.light.innerConeAngle = std::min(light.light.innerConeAngle, light.light.outerConeAngle);
    }
  }
}

template <typename Owner>
void compare(std::vector<std::string>& differences, const std::string& where, const settings::Table<Owner>& table,
             const Owner& a, const Owner& b) {
  for (const auto& row : table.rows)
    if (row.get(a) != row.get(b)) differences.push_back(where + "." + row.field);
}

template <typename List>
bool haveOneLength(const List& a, const List& b) {
  return a.has_value() == b.has_value() && (!a || a->size() == b->size());
}

void compareScenes(std::vector<std::string>& found, const settings::State& a, const settings::State& b) {
  if (a.scene != b.scene) found.emplace_back("scene");
  if (a.camera != b.camera || a.lookAt.has_value() != b.lookAt.has_value()) found.emplace_back("camera");
  if (a.lookAt && b.lookAt) compare(found, "camera", settings::lookAtTable(), *a.lookAt, *b.lookAt);
  if (!haveOneLength(a.lights, b.lights)) return found.emplace_back("lights"), void();
  for (std::size_t i = 0; a.lights && i < a.lights->size(); ++i)
    compare(found, fmt::format("lights[{}]", i), settings::lightTable(), (*a.lights)[i], (*b.lights)[i]);
  if (a.ambient.has_value() != b.ambient.has_value()) found.emplace_back("ambient");
  if (a.ambient && b.ambient) compare(found, "ambient", settings::ambientTable(), *a.ambient, *b.ambient);
  if (a.fog.has_value() != b.fog.has_value()) found.emplace_back("fog");
  if (a.fog && b.fog) {
    compare(found, "fog", settings::fogTable(), *a.fog, *b.fog);
    if (a.fog->banks.size() != b.fog->banks.size()) return found.emplace_back("fog.banks"), void();
    for (std::size_t i = 0; i < a.fog->banks.size(); ++i)
      compare(found, fmt::format("fog.banks[{}]", i), settings::fogBankTable(), a.fog->banks[i], b.fog->banks[i]);
  }
  if (a.medium.has_value() != b.medium.has_value()) return found.emplace_back("medium"), void();
  if (!a.medium) return;
  compare(found, "medium", settings::mediumTable(), *a.medium, *b.medium);
  if (a.medium->constituents.size() != b.medium->constituents.size())
    return found.emplace_back("medium.constituents"), void();
  for (std::size_t i = 0; i < a.medium->constituents.size(); ++i)
    compare(found, fmt::format("medium.constituents[{}]", i), settings::constituentTable(), a.medium->constituents[i],
            b.medium->constituents[i]);
  if (a.medium->layers.size() != b.medium->layers.size()) return found.emplace_back("medium.layers"), void();
  for (std::size_t i = 0; i < a.medium->layers.size(); ++i)
    compare(found, fmt::format("medium.layers[{}]", i), settings::layerTable(), a.medium->layers[i],
            b.medium->layers[i]);
}

void compareKept(std::vector<std::string>& found, const settings::State& a, const settings::State& b) {
  if (a.compared.has_value() != b.compared.has_value()) found.emplace_back("compared");
  if (a.compared && b.compared) {
    if (a.compared->profile != b.compared->profile) found.emplace_back("compared.profile");
    compare(found, "compared.settings", settings::settingsTable(), a.compared->settings, b.compared->settings);
  }
  if (a.path.size() != b.path.size()) return found.emplace_back("path"), void();
  for (std::size_t i = 0; i < a.path.size(); ++i)
    compare(found, fmt::format("path[{}]", i), settings::pathTable(), a.path[i], b.path[i]);
}

} // namespace

Value randomValue(const Row& row, std::mt19937& random) {
  if (row.rule.mayBeUnset && below(3, random) == 0) return Value::none();
  if (!row.rule.also.empty() && below(4, random) == 0) return row.rule.also.front();
  for (;;) {
    Value value;
    value.count = row.count();
    for (int i = 0; i < value.count; ++i)
      value.numbers[static_cast<std::size_t>(i)] = randomNumber(row, random);
    if (breachOf(row, value).empty()) return value;
  }
}

settings::State randomState(unsigned seed) {
  std::mt19937 random(seed);
  for (;;) {
    settings::State state;
    state.scene = "scenes/it's a nave.glb";
    state.profile = static_cast<tyndall::Profile>(below(4, random));
    state.settings = tyndall::settingsOf(state.profile);
    settings::visitTables(state, [&](const char*, auto& part, const auto& table) { randomise(part, table, random); });
    randomiseScene(state, random);
    randomiseKept(state, random);
    if (contradictionIn(state).empty()) return state;
  }
}

std::vector<std::string> differences(const settings::State& a, const settings::State& b) {
  std::vector<std::string> found;
  compareScenes(found, a, b);
  if (a.profile != b.profile) found.emplace_back("profile");
  compare(found, "picture", settings::pictureTable(), a, b);
  compare(found, "maps", settings::mapsTable(), a, b);
  compare(found, "volumes", settings::volumesTable(), a, b);
  compare(found, "settings", settings::settingsTable(), a.settings, b.settings);
  compare(found, "reuse", settings::reuseTable(), a.reuse, b.reuse);
  compare(found, "tuning", settings::tuningTable(), a.tuning, b.tuning);
  compareKept(found, a, b);
  return found;
}

} // namespace tests
