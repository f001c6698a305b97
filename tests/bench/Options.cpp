#include "Options.h"

#include "render/SceneAnswers.h"

#include <algorithm>
#include <iterator>
#include <render/OptionRules.h>
#include <scene/Error.h>
#include <scene/FileIo.h>

namespace bench {

namespace {

using render::failUsage;

constexpr const char* kAllFolder = "bench-report";

/// What does not go into the options as it is.
struct Given {
  Request request;
  std::vector<std::string> references, series;
  bool quick = false, all = false, scaling = false;
};

double parseDensity(const std::string& part) {
  const auto number = render::parseWhole<double>(part);
  if (!number || !(*number > 0 && *number <= 1e6))
    failUsage("--densities", part, "must be numbers above 0, at most 1e6");
  return *number;
}

Technique techniqueOf(const std::string& name) {
  try {
    return parseTechnique(name);
  } catch (const std::invalid_argument& error) {
    throw render::UsageError(std::string("--techniques ") + error.what());
  }
}

std::vector<Technique> techniquesOf(const std::vector<std::string>& names) {
  std::vector<Technique> techniques;
  for (const std::string& name : names)
    techniques.push_back(techniqueOf(name));
  return techniques;
}

/// Empty, or why nothing can be written there.
std::string reasonAgainst(const std::filesystem::path& folder) {
  try {
    host::requireWritable(folder / "bench.csv");
  } catch (const host::Error& error) {
    return std::string("must be a folder that can be written to: ") + error.what();
  }
  return {};
}

void readOutputs(const Given& given, Options& options) {
  if (given.all) {
    options.plots = true;
    if (options.out.empty()) {
      options.out = kAllFolder;
      std::error_code ignored;
      std::filesystem::create_directory(kAllFolder, ignored);
      if (const std::string reason = reasonAgainst(options.out); !reason.empty())
        failUsage("--out", kAllFolder, reason);
    }
  }
  if (options.plots && options.out.empty()) throw render::UsageError("--plots requires --out");
  if (options.cache.empty() && !options.out.empty()) options.cache = options.out / "references";
}

/// Small enough to end within a minute on one core, and a bit of everything.
void applyQuick(Request& request) {
  request.scenes = {"nave", "stage"};
  request.techniques =
      techniquesOf({"exact", "high", "performance", "fixed:16", "fixed:64", "half:16", "half:64", "froxels:64",
                    "epipolar-march:128", "tree:128", "pyramid", "volumes:128", "incremental:128"});
  request.sizes = {{160, 90}};
  request.shadowSizes = {256};
}

void applyAll(Given& given, Options& options) {
  // concert is stage, as the series of lights is
  given.request.scenes = {"nave", "nave-glass", "forest", "terrain", "cage", "stage", "projector"};
  given.request.techniques = techniquesOf(allTechniques());
  given.references = {"map", "scene"};
  given.scaling = true;
  options.floors = options.calls = true;
}

void addLists(CLI::App& app, Given& given) {
  using render::addList;
  Request& request = given.request;
  const auto intFrom = [](const char* option, int low, int high) {
    return [=](const std::string& part) { return render::parseInt(option, part, low, high); };
  };
  addList(app, "--scenes", request.scenes, render::oneOf("--scenes", tests::sampleScenes()),
          "sample scenes, or all (default nave)", tests::sampleScenes());
  addList(app, "--techniques", request.techniques, techniqueOf, "see below, or all (default)",
          techniquesOf(allTechniques()));
  addList(
      app, "--sizes", request.sizes, [](const std::string& part) { return render::parseSize("--sizes", part, 16); },
      "of the image (default 1280x720)");
  addList(app, "--shadow-sizes", request.shadowSizes, intFrom("--shadow-sizes", 16, tyndall::kMaxImageSize),
          "texels per side (default 4096)");
  addList(app, "--lights", request.lights, intFrom("--lights", 1, tyndall::kMaxLights),
          "how many of the scene's lights, 1 to 16 (default: all)");
  addList(app, "--densities", request.densities, parseDensity, "factors on the medium's density (default 1)");
  addList(
      app, "--contexts", request.contexts,
      [](const std::string& name) { return render::parseContext("--contexts", name); },
      "osmesa (default; egl where it is not installed), egl, glfw");
  addList(app, "--references", given.references, render::oneOf("--references", {"map", "scene"}),
          "judge against these as well as exact: map, scene");
}

void addOptions(CLI::App& app, Given& given, Options& options) {
  addLists(app, given);
  app.add_option("--runs", options.runs, "timed runs of each technique (default 5)")->check(CLI::Range(5, 1000));
  app.add_option("--run-seconds", options.secondsOfRuns,
                 "of a technique's timed runs together: after three and so long it has no more (default: no limit)")
      ->check(render::numberThat("must be above 0", [](double seconds) { return seconds > 0; }));
  const CLI::Validator isWritable([](const std::string& folder) { return reasonAgainst(folder); }, "");
  app.add_option("--out", options.out, "a folder for bench.csv, bench.json and plots")
      ->type_name("FOLDER")
      ->check(CLI::ExistingDirectory)
      ->check(isWritable);
  app.add_option("--cache", options.cache, "a folder for slow references (default: references/ in --out)")
      ->type_name("FOLDER")
      ->check(CLI::ExistingDirectory)
      ->check(isWritable);
  app.add_flag("--floors", options.floors, "what each pass of ours would cost if it only read and wrote its bytes");
  app.add_flag("--calls", options.calls, "what render() takes of the processor, for each state mode of ours");
  auto* scaling = app.add_flag("--scaling", given.scaling, "the scaling series, too");
  render::addList(app, "--series", given.series, render::oneOf("--series", kSeries),
                  "only these: curve, as the lists say, shadow, image, slices, lights, density", kSeries)
      ->excludes(scaling);
  app.add_flag("--plots", options.plots, "draw them (needs python3 with matplotlib)");
  auto* quick =
      app.add_flag("--quick", given.quick, "small pictures of two scenes, within a minute; overrides the lists");
  app.add_flag("--all", given.all, "the whole report: every scene but concert, reference and series, with plots")
      ->excludes(quick);
}

Options complete(Given& given, Options options) {
  if (given.quick) applyQuick(given.request);
  if (given.all) applyAll(given, options);
  const auto isWanted = [&](const std::string& series) {
    if (given.series.empty()) return series == "curve" || given.scaling;
    return std::find(given.series.begin(), given.series.end(), series) != given.series.end();
  };
  for (const auto& setups : {planCurves(given.request), planScaling(given.request.contexts.front())})
    std::copy_if(setups.begin(), setups.end(), std::back_inserter(options.setups),
                 [&](const Setup& setup) { return isWanted(setup.series); });
  for (const std::string& name : given.references)
    (name == "map" ? options.mapExact : options.sceneExact) = true;
  readOutputs(given, options);
  return options;
}

} // namespace

Options parseOptions(int argc, const char* const* argv) {
  Options options;
  Given given;
  given.request = {{"nave"}, techniquesOf(allTechniques()), {{1280, 720}}, {4096}, {0},
                   {1},      {host::defaultContextKind()}};
  CLI::App app("Measures Tyndall's run time against its error, beside what people use today.", "tyndall-bench");
  app.footer("\nTechniques\n" + techniqueHelp() +
             "\nExit status\n  0: done; 1: a case failed, or Ctrl-C ended it early; 2: wrong usage.");
  addOptions(app, given, options);
  render::parseArguments(app, argc, argv);
  return complete(given, std::move(options));
}

} // namespace bench
