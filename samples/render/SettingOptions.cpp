#include "SettingOptions.h"

#include <cmath>

namespace render {

namespace {

using settings::OptionForm;
using settings::Row;
using settings::Rule;
using settings::Setting;
using settings::Type;
using settings::Value;
using Store = std::function<void(const Value&)>;

std::vector<std::string> namesOf(const std::vector<settings::Choice>& choices) {
  std::vector<std::string> names;
  names.reserve(choices.size());
  for (const settings::Choice& choice : choices)
    names.emplace_back(choice.name);
  return names;
}

int valueOf(const std::vector<settings::Choice>& choices, const std::string& name) {
  for (const settings::Choice& choice : choices)
    if (choice.name == name) return choice.value;
  return 0; // which IsMember refuses
}

std::string helpOf(const Row& row, const std::string& remark) {
  return row.optionHelp.empty() ? row.help + remark : row.optionHelp;
}

void addNamed(CLI::App& app, const std::string& option, const std::vector<settings::Choice>& choices,
              const std::string& help, const Store& store) {
  app.add_option_function<std::string>(
         option, [&choices, store](const std::string& name) { store(static_cast<double>(valueOf(choices, name))); },
         help)
      ->check(CLI::IsMember(namesOf(choices)))
      ->type_name("NAME");
}

template <typename Number>
void addNumber(CLI::App& app, const Row& row, const std::string& help, const Store& store) {
  CLI::Option* option = app.add_option_function<Number>(
      row.option, [store](const Number& number) { store(static_cast<double>(number)); }, help);
  const Rule& rule = row.rule;
  if (!rule.only.empty()) {
    std::vector<Number> numbers;
    numbers.reserve(rule.only.size());
    for (const double number : rule.only)
      numbers.push_back(static_cast<Number>(number));
    option->check(CLI::IsMember(numbers));
  } else if (rule.isLowOpen || rule.isHighOpen) {
    Rule range = rule;
    range.also.clear();
    option->check(numberThat("must be" + settings::rangeOf(rule), [range](double x) { return range.holds(x); }));
  } else {
    option->check(CLI::Range(static_cast<Number>(rule.low), static_cast<Number>(rule.high)));
  }
  if (rule.multipleOf == 1) return;
  const int step = rule.multipleOf;
  option->check(numberThat("must be a multiple of " + std::to_string(step),
                           [step](double x) { return std::fmod(x, step) == 0; }));
}

const std::vector<settings::Choice> kSwitch = {{"on", "true", 1}, {"off", "false", 0}};

/// Whether no profile has another value.
bool isSameInAllProfiles(const Setting<tyndall::Settings>& row) {
  for (const settings::Choice& profile : settings::kProfiles)
    if (row.get(tyndall::settingsOf(static_cast<tyndall::Profile>(profile.value))) != row.get({})) return false;
  return true;
}

} // namespace

std::string defaultOf(const Row& row, const Value& start) {
  Rule range = row.rule;
  range.also.clear();
  const bool canBeGiven = start.count > 0 && (!row.rule.only.empty() || range.holds(start[0]));
  return canBeGiven ? " (default " + textOf(row, start) + ")" : "";
}

void addSetting(CLI::App& app, const Row& row, const std::string& remark, const Store& store) {
  if (row.form != OptionForm::Value) {
    const double given = row.form == OptionForm::FlagOn ? 1 : 0;
    app.add_flag_callback(
        row.option, [store, given] { store(given); }, row.optionHelp.empty() ? row.help : row.optionHelp);
    return;
  }
  const std::string help = helpOf(row, remark);
  if (row.type == Type::Switch)
    addNamed(app, row.option, kSwitch, help, store);
  else if (row.type == Type::Choice)
    addNamed(app, row.option, row.choices, help, store);
  else if (row.type == Type::Whole)
    addNumber<int>(app, row, help, store);
  else
    addNumber<double>(app, row, help, store);
}

void addEffectSettings(CLI::App& app, Overrides& profile, Overrides& overrides) {
  addNamed(app, "--profile", settings::kProfiles, "quality (default high)", [&profile](const Value& value) {
    profile.emplace_back([value](settings::State& state) {
      state.profile = static_cast<tyndall::Profile>(static_cast<int>(value[0]));
      state.settings = tyndall::settingsOf(state.profile);
    });
  });
  for (const Setting<tyndall::Settings>& row : settings::settingsTable().rows) {
    const std::string remark = isSameInAllProfiles(row) ? defaultOf(row, row.get({})) : "; by the profile if not given";
    addSetting(app, row, remark, [&overrides, &row](const Value& value) {
      overrides.emplace_back([&row, value](settings::State& state) { row.set(state.settings, value); });
    });
  }
}

} // namespace render
