// Random frames, each drawn by every technique and profile: tyndall-stress --count 5000
#include "Workers.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <render/CommandLine.h>
#include <scene/FileIo.h>
#include <scene/Tool.h>

namespace {

int runTool(int argc, const char* const* argv) {
  CLI::App app(
      "Draws random frames by every technique and profile, and tells of each that breaks a rule: finite, never "
      "negative,\n"
      "never more light than without shadows, as near to the references as rounding and half a pixel allow, the same\n"
      "picture in another unit, place, order or convention. Exit code 1 if one does.",
      "tyndall-stress");
  stress::Plan plan;
  std::string simple, runs, out;
  bool describes = false;
  app.add_option("--first", plan.first, "Seed of the first frame")->default_str("1");
  app.add_option("--count", plan.count, "Frames")->default_str("1000");
  app.add_option("--seconds", plan.seconds, "Begin no frame after so many")->check(CLI::NonNegativeNumber);
  app.add_option("--jobs", plan.jobs, "Processes")->check(CLI::Range(1, 64))->default_str("1");
  app.add_option("--simple", simple,
                 "Axes that stay at their simplest, between commas, or all: what a finding was shrunk to");
  app.add_option("--runs", runs,
                 "Only these, between commas: exact, tree, epipolar, lowrank, performance, balanced, high, any "
                 "settings, relation");
  app.add_option("--pictures", plan.pictures, "Folder for all pictures, SEED-RUN.f32, for compare.py");
  app.add_flag("--describe", describes, "Print what the frames are made of");
  app.add_flag("!--no-shrink", plan.shrink, "Leave findings as they are");
  app.add_flag("--loops", plan.loops, "Count the turns of the shaders' loops; needs OpenGL 4.3");
  app.add_option("--report", out, "File for the counts, JSON; what is in it already is added to");
  render::parseArguments(app, argc, argv);
  try {
    plan.simple = stress::AxisSet::parse(simple);
  } catch (const std::invalid_argument& error) {
    render::failUsage("--simple", error.what(), "must be axes between commas: see tests/stress/frames/Axes.h");
  }
  if (!runs.empty())
    for (const std::string& name : render::splitList("--runs", runs)) {
      const std::vector<std::string>& known = stress::runNames();
      if (std::find(known.begin(), known.end(), name) == known.end())
        render::failUsage("--runs", name, "must be runs between commas: see --help");
      plan.runs.insert(name);
    }
  for (std::uint64_t i = 0; describes && i < plan.count; ++i)
    host::print(stress::describe(stress::makeCase(plan.first + i, plan.simple)));
  if (!plan.pictures.empty()) std::filesystem::create_directories(plan.pictures);
  stress::Report report = stress::run(plan, [](const std::string& line) { host::print(line + "\n"); });
  const std::size_t found = report.findings();
  host::print(report.text());
  if (!out.empty()) {
    if (std::ifstream old(out); old) report.merge(nlohmann::json::parse(old));
    host::writeText(out, report.json().dump(1) + "\n");
  }
  return found == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
  return render::runCommand("tyndall-stress", [&] { return runTool(argc, argv); });
}
