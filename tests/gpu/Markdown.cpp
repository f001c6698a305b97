#include "Markdown.h"

#include "Table.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace gpu {

namespace {

constexpr const char* kSoftware = "**Drawn by a software driver: no GPU. Its times say nothing of one.**\n\n";

std::string headOf(const Json& who) {
  const std::string renderer = who.at("renderer");
  std::string text = fmt::format("# Tyndall on {}\n\n", renderer);
  if (who.at("software") == true) text += kSoftware;
  Table table({"what", "value"});
  const auto add = [&](const char* what, const char* field) { table.add({what, who.at(field).get<std::string>()}); };
  add("renderer", "renderer");
  add("vendor", "vendor");
  add("OpenGL", "version");
  add("GLSL", "glsl");
  add("EGL", "display");
  std::string devices;
  for (const Json& device : who.value("devices", Json::array()))
    devices += (devices.empty() ? "" : "; ") + device.at("name").get<std::string>();
  table.add({"EGL's devices", devices.empty() ? "none are listed" : devices});
  if (who.contains("video_memory_gib")) table.add({"video memory", number(who.at("video_memory_gib")) + " GiB"});
  table.add({"processor", fmt::format("{}, {} cores, {} GiB", who.at("processor").get<std::string>(),
                                      who.at("cores").get<int>(), number(who.at("memory_gib")))});
  add("system", "system");
  add("commit", "commit");
  add("date", "date");
  for (const auto& [name, value] : who.at("limits").items())
    table.add({name, std::to_string(value.get<std::int64_t>())});
  std::string has, lacks;
  for (const auto& [name, value] : who.at("extensions").items())
    (value == true ? has : lacks) += name.substr(3) + " ";
  table.add({"has", has});
  table.add({"lacks", lacks});
  return text + table.text();
}

std::string partsOf(const Json& report) {
  Table table({"part", "what", "result", "seconds", "of at most"});
  std::string logs, unbegun;
  for (const Json& part : report.at("parts")) {
    const std::string name = part.at("name"), result = part.value("result", "?");
    if (result == "not begun") {
      unbegun += (unbegun.empty() ? "`" : "`, `") + name;
      continue;
    }
    table.add({name, part.value("title", ""), result, number(part.value("seconds", Json())),
               number(part.value("limit", Json()))});
    if (part.contains("damaged"))
      logs += fmt::format("\n`{}` left a damaged file: {}\n", name, part.at("damaged").get<std::string>());
    if (result == "done" || !part.contains("log") || part.at("log").empty()) continue;
    logs += fmt::format("\n`{}` {}; the last it said:\n\n```\n", name, result);
    for (const Json& line : part.at("log"))
      logs += line.get<std::string>() + "\n";
    logs += "```\n";
  }
  if (!unbegun.empty()) unbegun = "Not begun, since the time of their part was over: " + unbegun + "`.\n";
  return "## What ran\n\n" + table.text() + unbegun + logs + "\n";
}

std::string testsOf(const std::string& name, const Json& tests) {
  std::map<std::string, int> counts;
  std::string failures;
  for (const Json& one : tests.at("cases")) {
    const std::string result = one.at("result");
    ++counts[result];
    if (result == "passed" || result == "skipped") continue;
    failures += fmt::format("- **{}**: {}\n\n  ```\n", one.at("name").get<std::string>(), result);
    std::string message = one.value("message", "");
    for (std::size_t at = 0; at < message.size();) {
      const std::size_t end = std::min(message.find('\n', at), message.size());
      failures += "  " + message.substr(at, end - at) + "\n";
      at = end + 1;
    }
    failures += "  ```\n";
  }
  const int of = tests.at("of"), ran = static_cast<int>(tests.at("cases").size());
  std::string text = fmt::format("`{}`: of {} cases {} passed", name, of, counts["passed"]);
  for (const char* result : {"failed", "crashed", "killed", "skipped"})
    if (counts[result] > 0) text += fmt::format(", {} {}", counts[result], result);
  if (ran < of) text += fmt::format(", {} were not reached", of - ran);
  return text + ".\n\n" + (failures.empty() ? "" : failures + "\n");
}

std::string allTestsOf(const Json& report) {
  if (!report.contains("tests")) return {};
  std::string text = "## Tests on this driver\n\n";
  for (const auto& [name, tests] : report.at("tests").items())
    text += testsOf(name, tests);
  return text;
}

std::string programsOf(const Json& report) {
  if (!report.contains("programs")) return {};
  constexpr std::size_t kSlowest = 10;
  const Json& programs = report.at("programs");
  std::vector<Json> all(programs.at("programs").begin(), programs.at("programs").end());
  if (all.empty()) return {};
  std::stable_sort(all.begin(), all.end(), [](const Json& a, const Json& b) { return a.at("ms") > b.at("ms"); });
  double sum = 0;
  std::string failures;
  for (const Json& one : all) {
    sum += one.at("ms").get<double>();
    if (one.at("built") == false)
      failures += fmt::format("- `{}` does not build:\n\n```\n{}\n```\n", one.at("name").get<std::string>(),
                              one.value("log", ""));
  }
  std::string text =
      fmt::format("## Programs\n\n{} of {} programs were compiled and linked, one after the other, in {} s; "
                  "the median takes {} ms. The slowest:\n\n",
                  all.size(), programs.at("of").get<int>(), number(sum / 1000), number(all[all.size() / 2].at("ms")));
  Table table({"program", "ms"});
  for (std::size_t i = 0; i < std::min(kSlowest, all.size()); ++i)
    table.add({all[i].at("name"), number(all[i].at("ms"))});
  return text + table.text() + failures;
}

std::string picturesOf(const Json& report, bool hasSheet) {
  if (!report.contains("pictures") || report.at("pictures").empty()) return {};
  std::string recorder;
  Table table({"picture", "rRMSE", "p99", "max", "pixels beyond 2 %", "FLIP", "verdict", "on the sheet"});
  for (const Json& one : report.at("pictures")) {
    const Json difference = one.value("difference", Json::object());
    const auto figure = [&](const char* name, bool isPercent) {
      const Json value = difference.value(name, Json());
      return isPercent ? percent(value) : number(value);
    };
    std::string verdict = one.at("verdict");
    if (one.value("equal", false)) verdict = "same, to the last bit";
    if (verdict == "failed") verdict += ": " + one.value("message", "");
    const Json& place = one.at("on_sheet");
    table.add({one.at("case"), figure("rrmse", true), figure("p99", true), figure("max", true), figure("over", true),
               figure("flip", false), verdict,
               fmt::format("row {}, {}", place.at("row").get<int>(), place.at("column").get<int>())});
    if (one.contains("recorded") && recorder.empty()) recorder = one.at("recorded").value("driver", "");
  }
  std::string text =
      "## Pictures against references\n\nReferences: " + recorder +
      ". Differences are relative to the mean of the reference; verdicts by the samples' tolerances, which "
      "were measured among software drivers.\n\n";
  if (hasSheet)
    text += "![wanted, got, difference, three cases in a row](pictures.png)\n\nThree cases in a row, of each what was "
            "wanted, what this driver drew, and the difference: none where they are equal.\n\n";
  return text + table.text();
}

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

std::string sequencesOf(const Json& report) {
  if (!report.contains("sequences")) return {};
  constexpr std::size_t kWarmUp = 3; // frames that compile, and fill what is kept
  Table table({"sequence", "frames", "in full, ms", "objects named, ms", "detected, ms", "gain, named",
               "gain, detected", "share drawn", "greatest difference"});
  for (const Json& sequence : report.at("sequences")) {
    std::map<std::string, std::vector<double>> columns;
    double error = 0;
    const Json& frames = sequence.at("frames");
    for (std::size_t i = 0; i < frames.size(); ++i) {
      for (const char* name : {"objects_error", "detect_error"})
        error = std::max(error, frames[i].value(name, 0.0));
      if (i < kWarmUp) continue;
      for (const char* name : {"full_ms", "objects_ms", "detect_ms", "objects_share"})
        columns[name].push_back(frames[i].value(name, 0.0));
    }
    const double full = medianOf(columns["full_ms"]), objects = medianOf(columns["objects_ms"]),
                 detected = medianOf(columns["detect_ms"]);
    const auto gain = [&](double ms) { return ms > 0 ? number(full / ms) + "×" : "-"; };
    if (frames.size() <= kWarmUp) continue;
    table.add({sequence.at("what"), std::to_string(frames.size()), number(full), number(objects), number(detected),
               gain(objects), gain(detected), percent(medianOf(columns["objects_share"])), number(error)});
  }
  if (table.empty()) return {};
  return "## Temporal reuse\n\nMedians of frames after the third; the greatest difference from frames in full, as a "
         "part "
         "of the mean.\n\n" +
         table.text();
}

std::string avsmOf(const Json& report) {
  if (!report.contains("avsm") || report.at("avsm").empty()) return {};
  Table table({"scene", "method", "error", "KiB", "build ms", "look-up ms", "of baseline"});
  for (const Json& row : report.at("avsm"))
    table.add({row.at("scene"), row.at("method"), percent(row.at("error")),
               number(row.at("bytes").get<double>() / 1024), number(row.at("build_ms")), number(row.at("look_up_ms")),
               number(row.at("ratio"))});
  return "## Smoke and hair\n\n" + table.text();
}

} // namespace

std::string number(const Json& value) {
  if (!value.is_number()) return "-";
  const auto x = value.get<double>();
  return std::abs(x) >= 1000 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x);
}

std::string percent(const Json& value) { return value.is_number() ? number(100 * value.get<double>()) + " %" : "-"; }

std::string markdownOf(const Json& report, bool hasSheet) {
  std::string text = headOf(report.at("who"));
  const Json bench = report.value("bench", Json::object());
  const Json results = bench.value("results", Json::array());
  text += goalsOf(results) + partsOf(report) + allTestsOf(report) + programsOf(report) + picturesOf(report, hasSheet);
  text += profilesOf(results) + equalErrorOf(bench) + passesOf(results) + callsOf(results) + scalingOf(bench);
  text += sequencesOf(report) + avsmOf(report);
  text +=
      "## Plots\n\n`curves.png`, `passes.png` and `growth.png` are drawn where python3 with matplotlib is; elsewhere "
      "`sh tests/gpu.sh --plots FOLDER` draws them later, of `report.json`. What each tool wrote is in "
      "`details.tar.gz`.\n";
  return text;
}

} // namespace gpu
