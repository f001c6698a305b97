// Settings (settings/Tables.h) as options of a command line.
#pragma once

#include "OptionRules.h"

#include <settings/Tables.h>

namespace render {

/// What a command line sets of a state, to be done once the state that it begins with is known.
using Overrides = std::vector<std::function<void(settings::State&)>>;

/// " (default 4)"; empty where an option cannot give that.
std::string defaultOf(const settings::Row& row, const settings::Value& start);

/// The row's option; its help ends with the remark. `store` is given what was parsed, which keeps the rule.
void addSetting(CLI::App& app, const settings::Row& row, const std::string& remark,
                const std::function<void(const settings::Value&)>& store);

/// The options of all rows that have one. partOf(state) is what the table tells.
template <typename Owner, typename Part>
void addSettings(CLI::App& app, const settings::Table<Owner>& table, const Part& partOf, Overrides& overrides) {
  settings::State state;
  for (const settings::Setting<Owner>& row : table.rows) {
    if (row.option.empty()) continue;
    const auto store = [&overrides, &row, partOf](const settings::Value& value) {
      overrides.emplace_back([&row, partOf, value](settings::State& into) { row.set(partOf(into), value); });
    };
    addSetting(app, row, defaultOf(row, row.get(partOf(state))), store);
  }
}

/// --profile, and all rows of Settings: an option wins over the profile, wherever it stands.
void addEffectSettings(CLI::App& app, Overrides& profile, Overrides& overrides);

} // namespace render
