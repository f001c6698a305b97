// tyndall-bench: run time against error, of the effect and of what people use today.

#include "Measure.h"
#include "Options.h"
#include "Outputs.h"
#include "Progress.h"

#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <render/CommandLine.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Places.h>
#include <scene/Tool.h>

namespace bench {

namespace {

std::atomic<bool> stopAsked{false};

void askToStop(int signal) {
  stopAsked = true;
  std::signal(signal, host::endWithoutUnfinished); // the second Ctrl-C ends at once
}

void write(const Options& options, const Machine& machine, const std::vector<Result>& results) {
  if (options.out.empty()) return;
  writeCsv(options.out / "bench.csv", results);
  writeJson(options.out / "bench.json", machine, results);
}

void drawPlots(const Options& options) {
  if (!options.plots) return;
  const std::string command =
      fmt::format("/usr/bin/python3 '{}/plot.py' '{}'", TYNDALL_BENCH_DIR, (options.out / "bench.json").string());
  if (std::system(command.c_str()) != 0) // NOLINT(cert-env33-c): our own script
    throw host::Error("the plots could not be drawn: python3 with matplotlib is needed");
}

std::vector<Result> measureAll(const Options& options, const Machine& machine) {
  int units = 0;
  for (const Setup& setup : options.setups)
    units += unitsOf(setup, options.runs);
  Progress progress(units);
  MeasureOptions measureOptions;
  measureOptions.scenesFolder = host::placeOf("scenes", TYNDALL_SCENES_DIR);
  measureOptions.runs = options.runs;
  measureOptions.secondsOfRuns = options.secondsOfRuns;
  measureOptions.stop = &stopAsked;
  const ReferenceCache cache(options.cache, [&progress](const std::string& line) {
    progress.clear();
    host::say("note: " + line);
  });
  std::vector<Result> results;
  for (const Setup& setup : options.setups) {
    if (stopAsked) break;
    // The slow references judge curves; what grows in a scaling series is time.
    measureOptions.mapExact = options.mapExact && setup.series == "curve";
    measureOptions.sceneExact = options.sceneExact && setup.series == "curve";
    measureOptions.floors = options.floors && setup.series == "curve";
    measureOptions.calls = options.calls && setup.series == "curve";
    const Report report = [&](const std::string& what, int begun) {
      progress.begin(setup.label() + ": " + what, begun);
    };
    const std::vector<Result> more = measure(setup, measureOptions, cache, report);
    progress.clear();
    printTable(more);
    printFloors(more);
    printCalls(more);
    results.insert(results.end(), more.begin(), more.end());
    write(options, machine, results);
  }
  return results;
}

int run(const Options& options) {
  std::signal(SIGINT, askToStop);
  const Machine machine = thisMachine();
  host::print(fmt::format("{}, {} cores; commit {}\n", machine.processor, machine.cores, machine.commit));
  const std::vector<Result> results = measureAll(options, machine);
  printEqualErrors(equalErrors(results));
  printGrowths(growths(results));
  drawPlots(options);
  int failed = 0;
  for (const Result& result : results)
    if (!result.failed.empty()) {
      ++failed;
      host::say(
          fmt::format("tyndall-bench: {}: {} failed: {}", result.setup.label(), result.technique.name, result.failed));
    }
  if (stopAsked) host::say(fmt::format("tyndall-bench: ended early; {} finished cases are kept", results.size()));
  return failed > 0 || stopAsked ? 1 : 0;
}

} // namespace

} // namespace bench

int main(int argc, char** argv) {
  return render::runCommand("tyndall-bench", [&] { return bench::run(bench::parseOptions(argc, argv)); });
}
