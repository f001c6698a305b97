// tyndall-avsm-bench: adaptive volumetric shadow maps against other ways to keep how much of a light passes: error,
// memory and time, on the same captured segments.
#include "Judge.h"
#include "Methods.h"
#include "Report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <gl/Context.h>
#include <map>
#include <optional>
#include <render/OptionRules.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/ImageFile.h>
#include <scene/Tool.h>
#include <sstream>

namespace avsmbench {

namespace {

struct Options {
  std::vector<std::string> scenes = mapSceneNames();
  std::vector<std::string> methods;
  int size = 256;
  int runs = 5;
  std::optional<host::ContextKind> context; ///< none: the host's default
  std::string csv, curves, images;
  bool passes = false;
};

template <class Work>
double millisecondsOf(const Work& work) {
  host::gl().Finish();
  const auto start = std::chrono::steady_clock::now();
  work();
  host::gl().Finish();
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  return time.count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

/// Times of one method, run after run.
struct Times {
  std::vector<double> build, lookUp, ownLookUp, ratio, ownRatio;
};

/// A scene, and the baseline beside which every method is timed.
class Bench {
public:
  Bench(const MapScene& scene, const Options& options, tyndall::GlLoader loader)
      : scene_(scene), options_(options), stage_(scene), judge_(scene) {
    config_.loader = loader;
    config_.size = scene.size;
    tyndall::AvsmResult result = tyndall::Avsm::create(config_);
    if (!result.avsm) throw host::Error(result.status.message);
    lists_ = std::move(result.avsm);
    baseline_ = methodNamed(kBaseline).make(*lists_, config_);
    baselineLookUps_.emplace(*baseline_, scene.size, false);
  }

  Row measure(const MethodEntry& entry) {
    const MethodPointer method = entry.make(*lists_, config_);
    Row row{scene_.name, entry.name};
    stage_.captureAll(method->lists());
    method->build();
    row.error = judge_.meanError(stage_.answers(*method, judge_.queries()));
    row.bytes = method->bytes();
    if (method->needsLists()) row.listBytes = method->lists().statistics().listBytes;
    if (options_.runs == 0) return row;
    const Times times = timesOf(*method);
    row.build = median(times.build);
    row.lookUp = median(times.lookUp);
    row.ownLookUp = median(times.ownLookUp);
    row.ratio = median(times.ratio);
    row.ownRatio = median(times.ownRatio);
    return row;
  }

  /// Medians of the passes of resolve(), on a line each.
  void printPasses(int nodes, bool packed, tyndall::CurveReduction reduction) {
    tyndall::AvsmConfig config = config_;
    config.nodes = nodes;
    config.packed = packed;
    config.reduction = reduction;
    config.timing = tyndall::PassTiming::Finish;
    const MethodPointer method = makeAvsm(config);
    stage_.captureAll(method->lists());
    std::map<std::string, std::vector<double>> all;
    for (int run = 0; run <= options_.runs; ++run) {
      all["capture"].push_back(millisecondsOf([&] { stage_.capture(method->lists()); }));
      method->build();
      std::map<std::string, double> own;
      for (const tyndall::PassStatistics& pass : method->lists().statistics().passes)
        own[pass.name] += pass.milliseconds;
      for (const auto& [name, time] : own)
        all[name].push_back(time);
    }
    for (const auto& [name, times] : all)
      host::print(fmt::format("{}, {} nodes: {} {:.2f} ms\n", scene_.name, nodes, name, median(times)));
  }

  /// Transmittance of some texels: "scene,texel,method,depth,transmittance".
  void writeCurves(std::ostream& out, const std::vector<MethodEntry>& methods) {
    constexpr int kDepths = 1000;
    const auto segments = segmentsByTexel(scene_);
    std::vector<Query> queries;
    for (const std::uint32_t texel : texelsToShow(segments))
      for (int i = 0; i <= kDepths; ++i) {
        queries.push_back({texel, static_cast<float>(i) / kDepths});
        out << fmt::format("{},{},product,{:.4f},{:.6f}\n", scene_.name, texel, queries.back().depth,
                           reference::transmittanceAt(segments[texel], static_cast<double>(queries.back().depth)));
      }
    for (const MethodEntry& entry : methods) {
      const MethodPointer method = entry.make(*lists_, config_);
      stage_.captureAll(method->lists());
      method->build();
      const std::vector<float> answers = stage_.answers(*method, queries);
      for (std::size_t i = 0; i < queries.size(); ++i)
        out << fmt::format("{},{},{},{:.4f},{:.6f}\n", scene_.name, queries[i].texel, entry.name, queries[i].depth,
                           answers[i]);
    }
  }

  /// A picture for each method: an image of look-ups, and below it how far that is from the uncompressed lists', four
  /// times.
  void writeImages(const std::filesystem::path& folder, const std::vector<MethodEntry>& methods) {
    const std::vector<float> truth = imageOf(methodNamed("lists"));
    for (const MethodEntry& entry : methods) {
      const std::vector<float> image = imageOf(entry);
      std::vector<std::uint8_t> pixels;
      for (const bool differences : {false, true})
        for (int y = LookUps::kHeight - 1; y >= 0; --y)
          for (int x = 0; x < LookUps::kWidth; ++x) {
            const auto i = static_cast<std::size_t>(y * LookUps::kWidth + x);
            const float value = differences ? 4 * std::abs(image[i] - truth[i]) : image[i];
            pixels.insert(pixels.end(), 3, static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F))));
          }
      std::string name = scene_.name + "-" + entry.name + ".png";
      std::replace(name.begin(), name.end(), ' ', '-');
      host::writePng(folder / name, LookUps::kWidth, 2 * LookUps::kHeight, pixels);
    }
  }

private:
  std::vector<float> imageOf(const MethodEntry& entry) {
    const MethodPointer method = entry.make(*lists_, config_);
    stage_.captureAll(method->lists());
    method->build();
    const LookUps lookUps(*method, scene_.size, false);
    lookUps.run();
    return lookUps.image();
  }

  /// The busiest texel, and one busier than three quarters of those that hold anything.
  static std::vector<std::uint32_t> texelsToShow(const std::vector<std::vector<reference::Segment>>& segments) {
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < segments.size(); ++i)
      if (!segments[i].empty()) all.push_back(static_cast<std::uint32_t>(i));
    std::stable_sort(all.begin(), all.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return segments[a].size() < segments[b].size(); });
    if (all.empty()) return {};
    return {all.back(), all[all.size() * 3 / 4]};
  }

  /// The first run is the warm-up.
  Times timesOf(Method& method) {
    Times times;
    const LookUps lookUps(method, scene_.size, false);
    std::optional<LookUps> ownLookUps;
    if (method.filters()) ownLookUps.emplace(method, scene_.size, true);
    for (int run = 0; run <= options_.runs; ++run) {
      stage_.capture(method.lists());
      const double baseline = millisecondsOf([&] {
        baseline_->build();
        baselineLookUps_->run();
      });
      const double build = millisecondsOf([&] { method.build(); });
      const double lookUp = millisecondsOf([&] { lookUps.run(); });
      const double own = ownLookUps ? millisecondsOf([&] { ownLookUps->run(); }) : 0;
      if (run == 0) continue;
      times.build.push_back(build);
      times.lookUp.push_back(lookUp);
      times.ratio.push_back((build + lookUp) / baseline);
      if (!ownLookUps) continue;
      times.ownLookUp.push_back(own);
      times.ownRatio.push_back((build + own) / baseline);
    }
    return times;
  }

  const MapScene& scene_;
  const Options& options_;
  Stage stage_;
  Judge judge_;
  tyndall::AvsmConfig config_;
  std::unique_ptr<tyndall::Avsm> lists_;
  MethodPointer baseline_;
  std::optional<LookUps> baselineLookUps_;
};

std::vector<MethodEntry> chosen(const Options& options) {
  if (options.methods.empty()) return allMethods();
  std::vector<MethodEntry> entries;
  for (const std::string& name : options.methods)
    entries.push_back(methodNamed(name));
  return entries;
}

void run(const Options& options) {
  const std::unique_ptr<host::Context> context =
      host::Context::create(options.context ? *options.context : host::defaultContextKind(), {/*debug*/ false});
  if (context->glVersion() < 43) throw host::Error("the context is older than OpenGL 4.3");
  const std::vector<MethodEntry> methods = chosen(options);
  for (const std::string& file : {options.csv, options.curves})
    if (!file.empty()) host::requireWritable(file);
  std::ostringstream curves;
  curves << "scene,texel,method,depth,transmittance\n";
  std::vector<Row> rows;
  for (const std::string& name : options.scenes) {
    const MapScene scene = makeMapScene(name, options.size);
    std::size_t most = 0;
    for (const auto& texel : segmentsByTexel(scene))
      most = std::max(most, texel.size());
    host::print(fmt::format("{}: {} segments, {:.1f} a texel, {} at most\n", name, scene.segments.size(),
                            static_cast<double>(scene.segments.size()) / (options.size * options.size), most));
    Bench bench(scene, options, context->loader());
    if (options.passes)
      for (const tyndall::CurveReduction reduction :
           {tyndall::CurveReduction::Fitted, tyndall::CurveReduction::WholeCurve})
        bench.printPasses(8, true, reduction);
    for (const MethodEntry& entry : methods) {
      rows.push_back(bench.measure(entry));
      if (!options.csv.empty()) writeCsv(options.csv, rows); // so that a run which is ended leaves what it has
      host::say(fmt::format("{}: {}", name, entry.name));
    }
    if (!options.curves.empty()) bench.writeCurves(curves, methods);
    if (!options.images.empty()) bench.writeImages(options.images, methods);
    for (const std::string& error : context->takeErrors())
      throw host::Error(error);
  }
  host::print(fmt::format("{}; baseline: {}; median of {} runs\n\n", context->driver(), kBaseline, options.runs));
  printMarkdown(rows);
  if (!options.curves.empty()) host::writeText(options.curves, curves.str());
}

Options parseOptions(int argc, char** argv) {
  Options options;
  std::vector<std::string> methods;
  for (const MethodEntry& entry : allMethods())
    methods.push_back(entry.name);
  CLI::App app("Adaptive volumetric shadow maps against other methods: error, memory, time.", "tyndall-avsm-bench");
  render::addList(app, "--scenes", options.scenes, render::oneOf("--scenes", mapSceneNames()),
                  "smoke, smoke-tenth, hair, hair-tenth; all if not named");
  render::addList(app, "--methods", options.methods, render::oneOf("--methods", methods),
                  "by the names that the table has; all if not named");
  app.add_option("--size", options.size, "texels per side of the map")->check(CLI::Range(8, 1024));
  app.add_option("--runs", options.runs, "timed runs behind a warm-up; 0: errors and memory only")
      ->check(CLI::Range(0, 100));
  render::chooseFrom(render::kContextNames, app.add_option("--context", options.context,
                                                           "GL's (default osmesa; egl where it is not installed)"));
  app.add_option("--csv", options.csv, "a file for the table");
  app.add_option("--curves", options.curves, "a file for curves of single texels, for plotCurves.py");
  app.add_option("--images", options.images, "a folder for pictures of look-ups, with differences")
      ->check(CLI::ExistingDirectory);
  app.add_flag("--passes", options.passes, "times of the passes of resolve() as well");
  render::parseArguments(app, argc, argv);
  return options;
}

} // namespace

} // namespace avsmbench

int main(int argc, char** argv) {
  return render::runCommand("tyndall-avsm-bench", [&] {
    avsmbench::run(avsmbench::parseOptions(argc, argv));
    return 0;
  });
}
