#include "Markdown.h"
#include "Table.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace gpu {

namespace {

/// What is wanted of a GPU at 2560x1600 with a map of 4096², by Yusov's table of 2013.
struct Goal {
  const char* profile;
  double speedUp, milliseconds;
};
constexpr Goal kGoals[] = {{"high", 15, 6}, {"balanced", 28, 3.3}, {"performance", 40, 2.3}};
constexpr double kCallGoal = 0.3; // milliseconds of the processor a light

bool ran(const Json& result) { return result.contains("ms"); }

std::string setupOf(const Json& result) {
  std::string text =
      fmt::format("{} {}×{}, {}²", result.at("scene").get<std::string>(), result.at("size")[0].get<int>(),
                  result.at("size")[1].get<int>(), result.at("shadow_size").get<int>());
  if (const int lights = result.at("lights"); lights > 0)
    text += fmt::format(", {} light{}", lights, lights > 1 ? "s" : "");
  return text;
}

using Setup = std::pair<std::string, std::vector<Json>>;

/// The curves' results by setup, as they were measured.
std::vector<Setup> setupsOf(const Json& results) {
  std::vector<Setup> setups;
  for (const Json& result : results) {
    if (result.at("series") != "curve") continue;
    const std::string name = setupOf(result);
    const auto found = std::find_if(setups.begin(), setups.end(), [&](const Setup& s) { return s.first == name; });
    if (found == setups.end())
      setups.push_back({name, {result}});
    else
      found->second.push_back(result);
  }
  return setups;
}

const Json* find(const std::vector<Json>& results, const std::string& technique) {
  for (const Json& result : results)
    if (result.at("technique") == technique && ran(result)) return &result;
  return nullptr;
}

double medianOf(const Json& result) { return result.at("ms").at("median"); }

Json gpuMedianOf(const Json& result) { return result.contains("gpu_ms") ? result.at("gpu_ms").at("median") : Json(); }

Json callOf(const Json& result, const char* mode, const char* clock) {
  if (!result.contains("calls")) return {};
  const Json& calls = result.at("calls");
  return calls.at(mode).at(clock).get<double>() / std::max(calls.at("lights").get<double>(), 1.0);
}

/// The scenes of the goals, at the size at which they were measured first.
bool isKey(const Json& result) {
  const std::string scene = result.at("scene");
  return result.contains("calls") && (scene == "nave" || (scene == "stage" && result.at("lights") == 1));
}

bool isOfGoals(const Json& result) {
  return isKey(result) && result.at("size") == Json::array({2560, 1600}) && result.at("shadow_size") == 4096;
}

std::string met(double value, double limit, bool atLeast) {
  return (atLeast ? value >= limit : value <= limit) ? "yes" : "no";
}

} // namespace

std::string goalsOf(const Json& results) {
  Table table({"setup", "profile", "`exact`, ms", "ms", "ms by GL's clock", "speed-up", "wanted", "reached",
               "ms wanted", "reached", "processor in `render()`, ms a light, restore / leave", "≤ 0.3 reached"});
  for (const auto& [setup, all] : setupsOf(results)) {
    const Json* exact = find(all, "exact");
    if (!exact) continue;
    for (const Goal& goal : kGoals) {
      const Json* ours = find(all, goal.profile);
      if (!ours || !isOfGoals(*ours)) continue;
      const double speedUp = medianOf(*exact) / medianOf(*ours);
      const Json restore = callOf(*ours, "restore", "processor_ms"), leave = callOf(*ours, "leave", "processor_ms");
      table.add({setup, goal.profile, number(medianOf(*exact)), number(medianOf(*ours)), number(gpuMedianOf(*ours)),
                 number(speedUp) + "×", fmt::format("≥ {}×", goal.speedUp), met(speedUp, goal.speedUp, true),
                 fmt::format("≤ {}", goal.milliseconds), met(medianOf(*ours), goal.milliseconds, false),
                 number(restore) + " / " + number(leave),
                 restore.is_number() ? met(restore.get<double>(), kCallGoal, false) : "-"});
    }
  }
  if (table.empty()) return {};
  return "## Against Yusov's table of 2013\n\n2560×1600, one shadow map of 4096². Wall clock around glFinish, unless "
         "said.\n\n" +
         table.text();
}

std::string profilesOf(const Json& results) {
  Table table({"setup", "profile", "`exact`, ms", "ms", "least", "most", "ms by GL's clock", "runs", "speed-up",
               "rRMSE", "p99", "MiB"});
  std::string failures;
  for (const auto& [setup, all] : setupsOf(results)) {
    const Json* exact = find(all, "exact");
    for (const char* name : {"high", "balanced", "performance"}) {
      const Json* ours = find(all, name);
      if (!ours) continue;
      const Json& ms = ours->at("ms");
      const Json& error = ours->at("errors").at("exact");
      table.add({setup, name, exact ? number(medianOf(*exact)) : "-", number(ms.at("median")), number(ms.at("min")),
                 number(ms.at("max")), number(gpuMedianOf(*ours)), std::to_string(ms.at("runs").size()),
                 exact ? number(medianOf(*exact) / medianOf(*ours)) + "×" : "-", percent(error.at("rrmse")),
                 percent(error.at("p99")), number(ours->at("bytes").get<double>() / 1048576)});
    }
    for (const Json& result : all)
      if (result.contains("failed"))
        failures += fmt::format("- {}, {}: {}\n", setup, result.at("technique").get<std::string>(),
                                result.at("failed").get<std::string>());
  }
  if (table.empty() && failures.empty()) return {};
  return "## Profiles\n\n" + (table.empty() ? "" : table.text()) +
         (failures.empty() ? "" : "Failed:\n\n" + failures + "\n");
}

std::string equalErrorOf(const Json& bench) {
  Table table(
      {"setup", "profile", "ms", "rRMSE", "against", "fastest with that error", "time", "least error in that time"});
  for (const Json& row : bench.value("equal_error", Json::array())) {
    const bool hasBest = row.at("best_ms").is_number(), hasNearest = row.at("nearest_rrmse").is_number();
    const double ms = row.at("ms");
    table.add({row.at("setup"), row.at("profile"), number(ms), percent(row.at("rrmse")), row.at("against"),
               hasBest ? row.at("best").get<std::string>() + ", " + number(row.at("best_ms")) + " ms"
                       : "none; the least is " + percent(row.at("least_rrmse")),
               hasBest ? number(row.at("best_ms").get<double>() / ms) + "×" : "-",
               hasNearest ? row.at("nearest").get<std::string>() + ", " + percent(row.at("nearest_rrmse"))
                          : "all are slower"});
  }
  return table.empty() ? "" : "## Speed at equal error\n\n" + table.text();
}

namespace {

/// Of one result; floors only where there are some.
std::string passTable(const Json& result) {
  const Json floorsOfAll = result.value("floors", Json());
  const bool hasFloors = floorsOfAll.is_object();
  std::map<std::string, Json> floors;
  if (hasFloors)
    for (const Json& pass : floorsOfAll.at("passes"))
      floors["light 0 " + pass.at("name").get<std::string>()] = pass.at("floor_ms");
  std::vector<std::string> columns = {"pass", "ms"};
  if (hasFloors) columns.emplace_back("ms if it only read and wrote its bytes");
  Table table(columns);
  const auto add = [&](const std::string& name, double ms, const Json& floor) {
    std::vector<std::string> row = {name, number(ms)};
    if (hasFloors) row.push_back(number(floor));
    table.add(row);
  };
  double sum = 0;
  for (const Json& pass : result.at("passes")) {
    if (!pass.contains("ms")) continue;
    const std::string name = pass.at("name");
    sum += pass.at("ms").get<double>();
    add(name, pass.at("ms"), floors.count(name) == 1 ? floors.at(name) : Json());
  }
  add("sum", sum, hasFloors ? floorsOfAll.at("floor_ms") : Json());
  return table.text();
}

} // namespace

std::string passesOf(const Json& results) {
  std::string text;
  for (const auto& [setup, all] : setupsOf(results))
    for (const char* name : {"high", "balanced", "performance"}) {
      const Json* ours = find(all, name);
      if (!ours || !isKey(*ours) || ours->value("passes", Json::array()).empty()) continue;
      text += fmt::format("### {}, {}\n\n", setup, name) + passTable(*ours);
    }
  if (text.empty()) return {};
  return "## Passes\n\nMedians; of a GPU by timer queries, of a software driver by glFinish.\n\n" + text;
}

std::string callsOf(const Json& results) {
  Table table({"setup", "profile", "lights", "restore: until it returns", "its processor", "leave: until it returns",
               "its processor"});
  for (const auto& [setup, all] : setupsOf(results))
    for (const Json& result : all)
      if (ran(result) && result.contains("calls"))
        table.add({setup, result.at("technique"), std::to_string(result.at("calls").at("lights").get<int>()),
                   number(callOf(result, "restore", "ms")), number(callOf(result, "restore", "processor_ms")),
                   number(callOf(result, "leave", "ms")), number(callOf(result, "leave", "processor_ms"))});
  if (table.empty()) return {};
  return "## Processor\n\nWhat `render()` takes without a wait, milliseconds a light, by state mode.\n\n" +
         table.text();
}

std::string scalingOf(const Json& bench) {
  Table table({"series", "technique", "range", "first ms", "last ms", "growth", "exponent"});
  for (const Json& row : bench.value("scaling", Json::array()))
    table.add({row.at("series"), row.at("technique"), number(row.at("range")) + "×", number(row.at("first_ms")),
               number(row.at("last_ms")),
               number(row.at("last_ms").get<double>() / row.at("first_ms").get<double>()) + "×",
               fmt::format("{:.2f}", row.at("exponent").get<double>())});
  return table.empty() ? "" : "## Scaling\n\n" + table.text();
}

} // namespace gpu
