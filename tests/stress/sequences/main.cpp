// tyndall-stress-sequences: random frames through one effect, each beside the frame of an effect that keeps nothing.
#include "Batches.h"

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <render/CommandLine.h>
#include <render/OptionRules.h>
#include <scene/Error.h>

namespace {

using stress::Outcome;
using stress::Plan;
using stress::Tally;

struct Options {
  Plan plan;
  std::uint64_t seed = 0; ///< one alone
  std::string without, skip;
  std::filesystem::path report;
  bool keeps = false;
};

Plan planOf(const Options& options) {
  Plan plan = options.plan;
  plan.shrinks = !options.keeps;
  if (options.seed != 0) {
    plan.first = options.seed;
    plan.count = 1;
    plan.shrinks = false;
  }
  if (!options.without.empty())
    for (const std::string& name : render::splitList("--without", options.without)) {
      try {
        plan.recipe.without.insert(stress::ingredientNamed(name));
      } catch (const std::invalid_argument& error) {
        throw render::UsageError("--without: " + std::string(error.what()));
      }
    }
  if (!options.skip.empty())
    for (const std::string& frame : render::splitList("--skip", options.skip))
      plan.recipe.skipped.insert(render::parseInt("--skip", frame, 0, 100000));
  return plan;
}

nlohmann::json jsonOf(const Plan& plan, const Outcome& outcome) {
  const Tally& t = outcome.tally;
  return {{"first", plan.first},
          {"sequences", t.sequences},
          {"frames", t.frames},
          {"seconds", outcome.seconds},
          {"failed", outcome.failed},
          {"failures", outcome.failures},
          {"redrawn", {{"nothing", t.shares[0]}, {"a part", t.shares[1]}, {"all", t.shares[2]}}},
          {"predicted", {{"nothing", t.predicted[0]}, {"all", t.predicted[1]}, {"anything", t.predicted[2]}}},
          {"last picture bit for bit", t.last},
          {"failing frames",
           {{"invalid", t.failures[1]},
            {"no memory", t.failures[2]},
            {"framebuffer", t.failures[3]},
            {"shader", t.failures[4]},
            {"abandoned", t.failures[5]}}},
          {"largest difference", t.most},
          {"other jitters", {{"frames", t.mixed}, {"largest rms", t.mixedRms}}}};
}

void print(const Outcome& outcome) {
  const Tally& t = outcome.tally;
  std::printf("%ld sequences, %ld frames, %.0f s, %.0f frames/s: %ld failed\n", t.sequences, t.frames, outcome.seconds,
              static_cast<double>(t.frames) / outcome.seconds, outcome.failed);
  std::printf("redrew nothing, a part, all: %ld, %ld, %ld; had to be nothing, all, anything: %ld, %ld, %ld\n",
              t.shares[0], t.shares[1], t.shares[2], t.predicted[0], t.predicted[1], t.predicted[2]);
  std::printf("the last picture bit for bit: %ld; largest difference %.2g; with other jitters %ld, rms %.2g\n", t.last,
              t.most, t.mixed, t.mixedRms);
}

int run(const Options& options) {
  const Plan plan = planOf(options);
  const Outcome outcome = stress::runBatches(plan);
  print(outcome);
  if (!options.report.empty()) {
    std::ofstream file(options.report);
    file << jsonOf(plan, outcome).dump(2) << "\n";
    if (!file.flush()) throw host::Error("cannot write " + options.report.string());
  }
  return outcome.failed == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
  return render::runCommand("tyndall-stress-sequences", [&] {
    Options options;
    CLI::App app("Draws random sequences of frames, and compares each with the frame of an effect that keeps nothing.",
                 "tyndall-stress-sequences");
    app.add_option("--seed", options.seed, "one sequence, by its seed");
    app.add_option("--first", options.plan.first, "seed of the first of many")->capture_default_str();
    app.add_option("--count", options.plan.count, "sequences")->capture_default_str();
    app.add_option("--seconds", options.plan.seconds, "after which none begins; 0: no limit")->capture_default_str();
    app.add_option("--batch", options.plan.batch, "sequences in a process")->capture_default_str();
    app.add_option("--patience", options.plan.patience, "seconds that one may take")->capture_default_str();
    app.add_option("--frames", options.plan.recipe.frames, "of each")->capture_default_str();
    app.add_option("--skip", options.skip, "frames that are not drawn, by commas");
    app.add_option("--without", options.without, "what has its simplest value, by commas");
    app.add_flag("--keep", options.keeps, "do not look for a smaller case of what fails");
    app.add_flag("--describe", options.plan.describes, "print each frame");
    app.add_option("--report", options.report, "a JSON file of what was seen");
    render::parseArguments(app, argc, argv);
    return run(options);
  });
}
