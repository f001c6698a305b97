// tyndall-viewer-bench SCENE: what the viewer makes one wait for. A camera that orbits, then rests until the error is
// known.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <gl/Context.h>
#include <render/CommandLine.h>
#include <render/OptionRules.h>
#include <scene/Error.h>
#include <thread>
#include <vector>
#include <viewer/core/Viewer.h>

namespace {

using Clock = std::chrono::steady_clock;

double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }
double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Options {
  std::filesystem::path scene;
  int width = 960, height = 540, frames = 60;
  double frameMilliseconds = 100;
  std::string context = host::nameOf(host::defaultContextKind());
};

void load(viewer::Viewer& viewer, const Options& options) {
  viewer.resize(options.width, options.height);
  viewer.quality.setTarget(options.frameMilliseconds);
  viewer.open(options.scene);
  while (viewer.loader().isLoading()) {
    viewer.update(now());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (!viewer.scene()) throw host::Error(viewer.takeMessage().value_or(viewer::Message{"no scene", true}).text);
}

void run(const Options& options) {
  const std::unique_ptr<host::Context> made = host::Context::create(host::parseContextKind(options.context));
  host::Context& context = *made;
  viewer::Viewer viewer(context, {});
  double lastBreath = now();
  std::vector<double> pauses; // between two moments at which a window could have lived
  viewer.whileDrawing = [&] {
    pauses.push_back(1e3 * (now() - lastBreath));
    lastBreath = now();
  };
  const auto breathe = [&] { viewer.whileDrawing(); };
  load(viewer, options);
  std::vector<double> walls, processors, scenes, effects;
  for (int i = 0; i < options.frames; ++i) {
    viewer.setView(viewer::orbited(viewer.view(), 0.02, 0));
    const double start = now(), processor = processorSeconds();
    viewer.update(now());
    if (i < options.frames / 3) continue; // the quality is still being looked for
    walls.push_back(1e3 * (now() - start));
    processors.push_back(1e3 * (processorSeconds() - processor));
    scenes.push_back(viewer.sceneMilliseconds());
    effects.push_back(viewer.first().milliseconds());
  }
  const double rest = now();
  double settled = 0;
  pauses.clear();
  lastBreath = now();
  for (;;) {
    const viewer::Activity activity = viewer.update(now());
    breathe();
    if (settled == 0 && viewer.isSettled()) settled = now() - rest;
    if (activity == viewer::Activity::Idle) break;
    if (activity == viewer::Activity::Waiting) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const double measured = now() - rest;
  std::printf("%s at %dx%d, %s\n\n| what | figure |\n|---|---|\n", options.scene.stem().c_str(), options.width,
              options.height, context.driver().c_str());
  std::printf("| a frame while the camera moves: median, 95th percentile | %.0f ms, %.0f ms |\n", quantile(walls, 0.5),
              quantile(walls, 0.95));
  std::printf("| processor time of it, all cores | %.0f ms |\n", quantile(processors, 0.5));
  std::printf("| of it maps and surfaces, effect | %.0f ms, %.0f ms |\n", quantile(scenes, 0.5),
              quantile(effects, 0.5));
  std::printf("| level of quality, 0 the best, %d the fastest | %d |\n", viewer::qualityLevels() - 1,
              viewer.quality.level());
  std::printf("| full quality after | %.1f s |\n", settled);
  std::printf("| of it maps and surfaces, effect | %.0f ms, %.0f ms |\n", viewer.sceneMilliseconds(),
              viewer.first().milliseconds());
  std::printf("| error known after | %.1f s |\n", measured);
  const viewer::Errors errors = viewer.meter().errors().at(0);
  std::printf("| rRMSE, p99 | %.2g %%, %.2g %% |\n", 100 * errors.rRmse, 100 * errors.p99);
  std::printf("| longest that a window waits meanwhile: 99th percentile, all | %.0f ms, %.0f ms |\n",
              quantile(pauses, 0.99), quantile(pauses, 1));
}

} // namespace

int main(int argc, char** argv) {
  return render::runCommand("tyndall-viewer-bench", [&] {
    Options options;
    CLI::App app("Times the viewer without its window.", "tyndall-viewer-bench");
    app.add_option("SCENE", options.scene, "a glTF file")->required();
    app.add_option("--width", options.width, "pixels")->capture_default_str();
    app.add_option("--height", options.height, "pixels")->capture_default_str();
    app.add_option("--frames", options.frames, "of the camera's orbit")->capture_default_str();
    app.add_option("--frame-time", options.frameMilliseconds, "milliseconds that the quality adapts to")
        ->capture_default_str();
    app.add_option("--context", options.context, "osmesa, egl or glfw")->capture_default_str();
    render::parseArguments(app, argc, argv);
    run(options);
    return 0;
  });
}
