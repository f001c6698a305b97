#include "Options.h"

#include "render/SceneAnswers.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <render/CommandLine.h>
#include <scene/Error.h>
#include <scene/FileIo.h>

namespace bench {

namespace {

using render::failUsage;

constexpr int kLeastRuns = 5;
constexpr int kMostRuns = 1000;
constexpr const char* kAllFolder = "bench-report";

/// The options as typed; lists are separated by commas.
struct Typed {
  std::string scenes, techniques, sizes, shadowSizes, lights, densities, contexts, references, runs, out, cache;
  bool quick = false, all = false, plots = false, scaling = false, floors = false;
};

std::vector<std::string> splitList(const std::string& option, const std::string& value) {
  std::vector<std::string> parts = render::split(value, ',');
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty()) failUsage(option, "\"" + value + "\"", "must be a list separated by single commas");
    if (std::find(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i), parts[i]) !=
        parts.begin() + static_cast<std::ptrdiff_t>(i))
      failUsage(option, value, "names " + parts[i] + " twice");
  }
  return parts;
}

std::vector<int> parseInts(const std::string& option, const std::string& value, int low, int high) {
  std::vector<int> numbers;
  for (const std::string& part : splitList(option, value))
    numbers.push_back(render::parseInt(option, part, low, high));
  return numbers;
}

std::vector<double> parseDensities(const std::string& value) {
  std::vector<double> numbers;
  for (const std::string& part : splitList("--densities", value)) {
    const auto number = render::parseWhole<double>(part);
    if (!number || !(*number > 0 && *number <= 1e6))
      failUsage("--densities", part, "must be numbers above 0, at most 1e6");
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<std::pair<int, int>> parseSizes(const std::string& value) {
  std::vector<std::pair<int, int>> sizes;
  for (const std::string& part : splitList("--sizes", value))
    sizes.push_back(render::parseSize("--sizes", part, 16));
  return sizes;
}

std::vector<std::string> parseScenes(const std::string& value) {
  const std::vector<std::string>& known = tests::sampleScenes();
  if (value == "all") return known;
  std::vector<std::string> names = splitList("--scenes", value);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      failUsage("--scenes", name, fmt::format("must be all or of {}", fmt::join(known, ", ")));
  return names;
}

std::vector<Technique> parseTechniques(const std::string& value) {
  std::vector<Technique> techniques;
  for (const std::string& name : value == "all" ? allTechniques() : splitList("--techniques", value))
    try {
      techniques.push_back(parseTechnique(name));
    } catch (const std::invalid_argument& error) {
      throw render::UsageError(std::string("--techniques ") + error.what());
    }
  return techniques;
}

std::vector<host::ContextKind> parseContexts(const std::string& value) {
  std::vector<host::ContextKind> kinds;
  for (const std::string& name : splitList("--contexts", value))
    kinds.push_back(render::parseContext("--contexts", name));
  return kinds;
}

void requireWritableFolder(const std::string& option, const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) failUsage(option, folder.string(), "must be a folder that exists");
  try {
    host::requireWritable(folder / "bench.csv");
  } catch (const host::Error& error) {
    failUsage(option, folder.string(), std::string("must be a folder that can be written to: ") + error.what());
  }
}

void readReferences(const Typed& typed, Options& options) {
  if (typed.references.empty()) return;
  for (const std::string& name : splitList("--references", typed.references)) {
    if (name != "map" && name != "scene") failUsage("--references", name, "must be of map, scene");
    (name == "map" ? options.mapExact : options.sceneExact) = true;
  }
}

void readOutputs(const Typed& typed, Options& options) {
  options.plots = typed.plots || typed.all;
  if (!typed.out.empty()) {
    requireWritableFolder("--out", typed.out);
    options.out = typed.out;
  } else if (typed.all) {
    std::error_code ignored;
    std::filesystem::create_directory(kAllFolder, ignored);
    requireWritableFolder("--out", kAllFolder);
    options.out = kAllFolder;
  }
  if (options.plots && options.out.empty()) failUsage("--plots", "", "needs --out");
  if (!typed.cache.empty()) {
    requireWritableFolder("--cache", typed.cache);
    options.cache = typed.cache;
  } else if (!options.out.empty()) {
    options.cache = options.out / "references";
  }
}

/// Small enough to end within a minute on one core, and a bit of everything.
void applyQuick(Typed& typed) {
  typed.scenes = "nave,stage";
  typed.techniques = "exact,high,performance,fixed:16,fixed:64,half:16,half:64,froxels:64,epipolar-march:128,tree:128,"
                     "pyramid,volumes:128,incremental:128";
  typed.sizes = "160x90";
  typed.shadowSizes = "256";
}

void applyAll(Typed& typed) {
  typed.scenes = "nave,nave-glass,forest,terrain,cage,stage,projector"; // concert is stage, as the series of lights is
  typed.techniques = "all";
  typed.references = "map,scene";
  typed.scaling = true;
  typed.floors = true;
}

Options fromTyped(Typed typed) {
  if (typed.quick && typed.all) failUsage("--quick", "", "cannot go with --all");
  if (typed.quick) applyQuick(typed);
  if (typed.all) applyAll(typed);
  Options options;
  Request request;
  request.scenes = parseScenes(typed.scenes);
  request.techniques = parseTechniques(typed.techniques);
  request.sizes = parseSizes(typed.sizes);
  request.shadowSizes = parseInts("--shadow-sizes", typed.shadowSizes, 16, tyndall::kMaxImageSize);
  request.lights =
      typed.lights.empty() ? std::vector<int>{0} : parseInts("--lights", typed.lights, 1, tyndall::kMaxLights);
  request.densities = parseDensities(typed.densities);
  if (typed.contexts.empty()) typed.contexts = host::nameOf(host::defaultContextKind());
  request.contexts = parseContexts(typed.contexts);
  options.setups = planCurves(request);
  if (typed.scaling)
    for (Setup& setup : planScaling())
      options.setups.push_back(std::move(setup));
  options.runs = render::parseInt("--runs", typed.runs, kLeastRuns, kMostRuns);
  options.floors = typed.floors;
  readReferences(typed, options);
  readOutputs(typed, options);
  return options;
}

void addOptions(CLI::App& app, Typed& typed) {
  app.add_option("--scenes", typed.scenes, "sample scenes, or all (default nave)")->type_name("LIST");
  app.add_option("--techniques", typed.techniques, "see below, or all (default)")->type_name("LIST");
  app.add_option("--sizes", typed.sizes, "of the image (default 1280x720)")->type_name("LIST");
  app.add_option("--shadow-sizes", typed.shadowSizes, "texels per side (default 4096)")->type_name("LIST");
  app.add_option("--lights", typed.lights, "how many of the scene's lights, 1 to 16 (default: all)")->type_name("LIST");
  app.add_option("--densities", typed.densities, "factors on the medium's density (default 1)")->type_name("LIST");
  app.add_option("--contexts", typed.contexts, "osmesa (default; egl where it is not installed), egl, glfw")
      ->type_name("LIST");
  app.add_option("--references", typed.references, "judge against these as well as exact: map, scene")
      ->type_name("LIST");
  app.add_option("--runs", typed.runs, "timed runs of each technique, at least 5 (default 5)")->type_name("N");
  app.add_option("--out", typed.out, "a folder for bench.csv, bench.json and plots")->type_name("FOLDER");
  app.add_option("--cache", typed.cache, "a folder for slow references (default: references/ in --out)")
      ->type_name("FOLDER");
  app.add_flag("--floors", typed.floors, "what each pass of ours would cost if it only read and wrote its bytes");
  app.add_flag("--scaling", typed.scaling, "the scaling series, too");
  app.add_flag("--plots", typed.plots, "draw them (needs python3 with matplotlib)");
  app.add_flag("--quick", typed.quick, "small pictures of two scenes, within a minute; overrides the lists");
  app.add_flag("--all", typed.all, "the whole report: every scene but concert, reference and series, with plots");
}

} // namespace

Options parseOptions(int argc, const char* const* argv) {
  Typed typed;
  typed.scenes = "nave";
  typed.techniques = "all";
  typed.sizes = "1280x720";
  typed.shadowSizes = "4096";
  typed.densities = "1";
  typed.runs = "5";
  CLI::App app("Measures Tyndall's run time against its error, beside what people use today.", "tyndall-bench");
  app.footer("\nTechniques\n" + techniqueHelp() +
             "\nExit status\n  0: done; 1: a case failed, or Ctrl-C ended it early; 2: wrong usage.");
  addOptions(app, typed);
  render::parseArguments(app, argc, argv);
  return fromTyped(typed);
}

} // namespace bench
