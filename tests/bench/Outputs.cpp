#include "Outputs.h"

#include <array>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Places.h>
#include <scene/Tool.h>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace bench {

namespace {

using Json = nlohmann::ordered_json;

std::string processorName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string todayUtc() {
  const std::time_t now = std::time(nullptr);
  std::array<char, 32> text{};
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

std::string percent(double value) { return std::isfinite(value) ? fmt::format("{:.3g} %", 100 * value) : "-"; }

std::string visitsOf(const Result& r) {
  return r.counts && r.counts->visitsPerRay ? fmt::format("{:.1f}", *r.counts->visitsPerRay) : "-";
}

/// JSON has no infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

} // namespace

Machine thisMachine() {
  Machine machine;
  machine.processor = processorName();
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
  machine.memory =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  utsname name{};
  if (uname(&name) == 0) machine.system = fmt::format("{} {} {}", name.sysname, name.release, name.machine);
  machine.commit = host::commitOf(TYNDALL_SOURCE_DIR);
  machine.date = todayUtc();
  return machine;
}

void printTable(const std::vector<Result>& results) {
  std::string setup;
  for (const Result& r : results) {
    if (r.setup.label() != setup) {
      setup = r.setup.label();
      host::print(fmt::format("\n{}  ({})\n{:<24}{:>10}{:>10}{:>10}{:>12}{:>12}{:>12}{:>9}{:>12}\n", setup, r.driver,
                              "technique", "median ms", "min", "max", "rRMSE", "p99", "max err", "MiB", "visits/ray"));
    }
    if (!r.ok()) {
      host::print(fmt::format("{:<24}  {}\n", r.technique.name,
                              r.failed.empty() ? "skipped: " + r.skipped : "FAILED: " + r.failed));
      continue;
    }
    const reference::ErrorMetrics& error = r.errors.at("exact");
    host::print(fmt::format("{:<24}{:>10.2f}{:>10.2f}{:>10.2f}{:>12}{:>12}{:>12}{:>9.1f}{:>12}\n", r.technique.name,
                            r.median(), r.least(), r.most(), percent(error.rRmse), percent(error.p99),
                            percent(error.max), static_cast<double>(r.bytes) / 1048576, visitsOf(r)));
    for (const char* other : {"map", "scene"})
      if (const auto found = r.errors.find(other); found != r.errors.end())
        host::print(fmt::format("{:>53} {:>12}{:>12}{:>12}\n", std::string("against ") + other + "-exact",
                                percent(found->second.rRmse), percent(found->second.p99), percent(found->second.max)));
  }
}

void printFloors(const std::vector<Result>& results) {
  for (const Result& r : results) {
    if (r.floors.empty()) continue;
    host::print(fmt::format("\n{}: {} against its floors\n{:<24}{:>10}{:>10}{:>9}\n", r.setup.label(), r.technique.name,
                            "pass", "ms", "floor ms", "ratio"));
    std::vector<PassFloor> rows = r.floors;
    rows.push_back(sumOf(r.floors));
    for (const PassFloor& row : rows)
      host::print(fmt::format("{:<24}{:>10.3f}{:>10.3f}{:>8.2f}x\n", row.name, row.milliseconds, row.floor,
                              row.milliseconds / row.floor));
  }
}

void printCalls(const std::vector<Result>& results) {
  bool begun = false;
  for (const Result& r : results) {
    if (!r.calls) continue;
    if (!begun)
      host::print(fmt::format("\n{}: the processor in render(), ms\n{:<24}{:>10}{:>10}{:>10}{:>10}\n", r.setup.label(),
                              "technique", "restore", "its CPU", "leave", "its CPU"));
    begun = true;
    host::print(fmt::format("{:<24}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.3f}\n", r.technique.name, r.calls->restore.wall,
                            r.calls->restore.processor, r.calls->leave.wall, r.calls->leave.processor));
  }
}

void printEqualErrors(const std::vector<EqualError>& rows) {
  if (rows.empty()) return;
  host::print(fmt::format("\nSpeed at equal error\n{:<40}{:<20}{:<10}{:>9}{:>12}  {}\n", "setup", "profile", "against",
                          "ms", "rRMSE", "the best needs for that rRMSE; has at that time"));
  for (const EqualError& row : rows) {
    const std::string time =
        row.bestTime
            ? fmt::format("{:.1f} ms = {:.1f}x ({})", *row.bestTime, *row.bestTime / row.milliseconds, row.best)
            : fmt::format("none; least {} after {:.1f} ms", percent(row.leastError), row.leastErrorTime);
    const std::string error =
        row.bestError ? fmt::format("{} ({})", percent(*row.bestError), row.nearest) : "all are slower";
    host::print(fmt::format("{:<40}{:<20}{:<10}{:>9.1f}{:>12}  {}; {}\n", row.setup, row.profile, nameOf(row.group),
                            row.milliseconds, percent(row.rRmse), time, error));
  }
}

void printGrowths(const std::vector<Growth>& rows) {
  if (rows.empty()) return;
  host::print(fmt::format("\nScaling: time ~ x^exponent\n{:<10}{:<24}{:>8}{:>12}{:>12}{:>12}{:>10}{:>10}\n", "series",
                          "technique", "points", "range of x", "first ms", "last ms", "growth", "exponent"));
  for (const Growth& row : rows)
    host::print(fmt::format("{:<10}{:<24}{:>8}{:>11.3g}x{:>12.2f}{:>12.2f}{:>9.2f}x{:>10.2f}\n", row.series,
                            row.technique, row.points, row.range, row.first, row.last, row.last / row.first,
                            row.exponent));
}

namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text)
    result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

Json passesOf(const Result& result) {
  Json passes = Json::array();
  for (const tyndall::PassStatistics& pass : result.passes)
    if (pass.skipped.empty())
      passes.push_back({{"name", pass.name}, {"ms", pass.milliseconds}});
    else
      passes.push_back({{"name", pass.name}, {"skipped", pass.skipped}});
  return passes;
}

Json floorsOf(const Result& result) {
  const PassFloor sum = sumOf(result.floors);
  Json json = {{"ms", sum.milliseconds}, {"floor_ms", sum.floor}, {"ratio", sum.milliseconds / sum.floor}};
  for (const PassFloor& pass : result.floors)
    json["passes"].push_back({{"name", pass.name}, {"ms", pass.milliseconds}, {"floor_ms", pass.floor}});
  return json;
}

Json callOf(const CallTime& call) { return {{"ms", call.wall}, {"processor_ms", call.processor}}; }

Json resultOf(const Result& r) {
  Json json = {{"series", r.setup.series},
               {"x", r.setup.x},
               {"scene", r.setup.scene},
               {"size", {r.setup.width, r.setup.height}},
               {"shadow_size", r.setup.shadowSize},
               {"lights", r.setup.lights},
               {"density", r.setup.density},
               {"context", host::nameOf(r.setup.context)},
               {"driver", r.driver},
               {"technique", r.technique.name},
               {"family", r.technique.family},
               {"group", nameOf(r.technique.group)}};
  if (!r.skipped.empty()) json["skipped"] = r.skipped;
  if (!r.failed.empty()) json["failed"] = r.failed;
  if (!r.ok()) return json;
  json["ms"] = {{"median", r.median()}, {"min", r.least()}, {"max", r.most()}, {"runs", r.milliseconds}};
  json["gpu_ms"] = {{"median", r.gpuMedian()}, {"runs", r.gpuMilliseconds}};
  json["bytes"] = r.bytes;
  json["peak_memory"] = r.peakMemory;
  if (r.counts) json["rays"] = r.counts->rays;
  if (r.counts && r.counts->errorEstimate > 0) {
    json["slices"] = r.counts->slices;
    json["error_estimate"] = r.counts->errorEstimate;
    json["share_over_target"] = r.counts->shareOverTarget;
  }
  if (r.counts && r.counts->visitsPerRay) {
    json["visits_per_ray"] = *r.counts->visitsPerRay;
    json["visits_estimate"] = *r.counts->visitsEstimate();
  }
  for (const auto& [name, error] : r.errors)
    json["errors"][name] = {{"rrmse", number(error.rRmse)}, {"p99", number(error.p99)}, {"max", number(error.max)}};
  json["passes"] = passesOf(r);
  if (!r.floors.empty()) json["floors"] = floorsOf(r);
  if (r.calls) {
    json["calls"] = {{"restore", callOf(r.calls->restore)}, {"leave", callOf(r.calls->leave)}};
    json["calls"]["lights"] = r.lightCount;
  }
  return json;
}

} // namespace

void writeCsv(const std::filesystem::path& file, const std::vector<Result>& results) {
  std::string text = "series,x,scene,width,height,shadow_size,lights,density,context,technique,family,group,"
                     "median_ms,min_ms,max_ms,runs,bytes,peak_memory,rays,visits_per_ray,visits_estimate";
  for (const char* reference : {"exact", "map", "scene"})
    for (const char* metric : {"rrmse", "p99", "max"})
      text += fmt::format(",{}_{}", metric, reference);
  text += ",skipped,failed\n";
  for (const Result& r : results) {
    const Setup& s = r.setup;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}", s.series, s.x, s.scene, s.width, s.height, s.shadowSize,
                        s.lights, s.density, host::nameOf(s.context), r.technique.name, r.technique.family,
                        nameOf(r.technique.group));
    text += r.ok() ? fmt::format(",{},{},{},{},{},{}", r.median(), r.least(), r.most(), r.milliseconds.size(), r.bytes,
                                 r.peakMemory)
                   : ",,,,,,";
    text += r.counts ? fmt::format(",{}", r.counts->rays) : ",";
    text += r.counts && r.counts->visitsPerRay
                ? fmt::format(",{},{}", *r.counts->visitsPerRay, *r.counts->visitsEstimate())
                : ",,";
    for (const char* reference : {"exact", "map", "scene"}) {
      const auto found = r.errors.find(reference);
      text += found == r.errors.end()
                  ? std::string(",,,")
                  : fmt::format(",{},{},{}", found->second.rRmse, found->second.p99, found->second.max);
    }
    text += "," + quoted(r.skipped) + "," + quoted(r.failed) + "\n";
  }
  host::writeText(file, text);
}

void writeJson(const std::filesystem::path& file, const Machine& machine, const std::vector<Result>& results) {
  Json json = {{"machine",
                {{"processor", machine.processor},
                 {"cores", machine.cores},
                 {"memory", machine.memory},
                 {"system", machine.system}}},
               {"commit", machine.commit},
               {"date", machine.date},
               {"results", Json::array()}};
  for (const Result& result : results)
    json["results"].push_back(resultOf(result));
  for (const EqualError& row : equalErrors(results))
    json["equal_error"].push_back({{"setup", row.setup},
                                   {"profile", row.profile},
                                   {"against", nameOf(row.group)},
                                   {"ms", row.milliseconds},
                                   {"rrmse", number(row.rRmse)},
                                   {"best", row.best},
                                   {"best_ms", row.bestTime ? Json(*row.bestTime) : Json(nullptr)},
                                   {"nearest", row.nearest},
                                   {"nearest_rrmse", row.bestError ? Json(*row.bestError) : Json(nullptr)},
                                   {"least_rrmse", number(row.leastError)},
                                   {"least_rrmse_ms", row.leastErrorTime}});
  for (const Growth& row : growths(results))
    json["scaling"].push_back({{"series", row.series},
                               {"technique", row.technique},
                               {"points", row.points},
                               {"range", row.range},
                               {"first_ms", row.first},
                               {"last_ms", row.last},
                               {"exponent", row.exponent}});
  // A driver's name may hold any bytes: those that are not UTF-8 are replaced instead of thrown over.
  host::writeText(file, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

} // namespace bench
