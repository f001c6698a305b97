#include "Measure.h"

#include "Memory.h"
#include "render/SceneAnswers.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <gl/Driver.h>
#include <gl/ReadBack.h>
#include <gl/RenderTargets.h>
#include <numeric>
#include <optional>
#include <render/RenderFrame.h>
#include <scene/Error.h>
#include <scene/FileIo.h>

namespace bench {

namespace {

template <class Element>
void cycle(std::vector<Element>& elements, int count) {
  const std::vector<Element> all = elements;
  elements.clear();
  for (int i = 0; i < count && !all.empty(); ++i)
    elements.push_back(all[static_cast<std::size_t>(i) % all.size()]);
}

void scaleMedium(tyndall::Medium& medium, double density) {
  const auto scale = [density](tyndall::Rgb& rgb) {
    for (float& value : rgb)
      value = static_cast<float>(value * density);
  };
  for (tyndall::Constituent& constituent : medium.constituents)
    scale(constituent.scattering);
  scale(medium.absorption);
}

render::Options optionsOf(const Setup& setup, const std::string& scenesFolder) {
  render::Options options;
  options.scene = scenesFolder + "/" + setup.scene + ".glb";
  options.width = setup.width;
  options.height = setup.height;
  options.shadowSize = setup.shadowSize;
  options.context = setup.context;
  options.profile = tyndall::Profile::Performance; // the frame is only drawn for its depth and shadow maps
  options.settings = tyndall::settingsOf(options.profile);
  options.debug = false;
  return options;
}

/// GL's own clock before and after work, which does not know how long the processor takes to ask for it.
class Timestamps {
public:
  Timestamps() { host::gl().GenQueries(2, names_); }
  ~Timestamps() { host::gl().DeleteQueries(2, names_); }
  Timestamps(const Timestamps&) = delete;
  Timestamps& operator=(const Timestamps&) = delete;

  void begin() const { host::gl().QueryCounter(names_[0], GL_TIMESTAMP); }
  void end() const { host::gl().QueryCounter(names_[1], GL_TIMESTAMP); }
  double milliseconds() const {
    GLuint64 nanoseconds[2] = {};
    for (int i = 0; i < 2; ++i)
      host::gl().GetQueryObjectui64v(names_[i], GL_QUERY_RESULT, &nanoseconds[i]);
    return static_cast<double>(nanoseconds[1] - nanoseconds[0]) / 1e6;
  }

private:
  GLuint names_[2] = {};
};

/// The scene's frame on the GPU, with a back buffer to blend into and outputs to judge.
class Stage {
public:
  Stage(const Setup& setup, const std::string& scenesFolder) : renderer_(optionsOf(setup, scenesFolder)) {
    renderer_.render(0);
    frame_ = renderer_.frame();
    if (setup.lights > 0) cycle(frame_.lights, setup.lights);
    scaleMedium(frame_.medium, setup.density);
    const auto make = [&](GLenum format) { return host::makeTexture2D(format, setup.width, setup.height); };
    inscatter_ = make(GL_RGBA32F);
    transmittance_ = make(GL_RGBA32F);
    colour_.emplace(host::RenderTargetOptions{setup.width, setup.height});
  }

  const std::string& driver() const { return renderer_.context().driver(); }
  tyndall::GlLoader loader() const { return renderer_.context().loader(); }

  /// Blended into the back buffer, as an engine would.
  tyndall::Frame composited() const {
    tyndall::Frame frame = frame_;
    frame.colour = colour_->colour();
    frame.output = {};
    return frame;
  }

  reference::Image inscatterOf(Runner& runner) const {
    tyndall::Frame frame = frame_;
    frame.colour = 0;
    frame.output = {inscatter_.name(), transmittance_.name()};
    runner.render(frame);
    throwGlErrors();
    return {frame.viewport.width, frame.viewport.height,
            host::readColour(inscatter_.name(), frame.viewport.width, frame.viewport.height, 3)};
  }

  /// A timed run. Enters nothing if it fails.
  void time(Runner& runner, Result& result) const {
    const GladGLContext& gl = host::gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, colour_->framebuffer());
    gl.Disable(GL_SCISSOR_TEST);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.ClearColor(0.2F, 0.2F, 0.2F, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    const tyndall::Frame frame = composited();
    const Timestamps timestamps;
    gl.Finish();
    const auto start = std::chrono::steady_clock::now();
    timestamps.begin();
    runner.render(frame);
    timestamps.end();
    gl.Finish();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    const double onGpu = timestamps.milliseconds();
    throwGlErrors();
    result.milliseconds.push_back(time.count());
    result.gpuMilliseconds.push_back(onGpu);
  }

private:
  static void throwGlErrors() {
    const GLenum error = host::gl().GetError();
    if (error != GL_NO_ERROR) throw host::Error(fmt::format("GL error 0x{:04x}", error));
  }

  render::FrameRenderer renderer_;
  tyndall::Frame frame_;
  host::GlTexture inscatter_;
  host::GlTexture transmittance_;
  std::optional<host::RenderTargets> colour_;
};

struct Case {
  Result result;
  Result warmUp; ///< the time of its warm-up, which stands in where a run was ended before any other
  std::unique_ptr<Runner> runner;
  bool runs() const { return runner && result.failed.empty() && result.skipped.empty(); }
};

/// Calls work and enters what it throws into the result.
template <class Work>
void guarded(Result& result, const Work& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    result.failed = "out of memory";
  } catch (const std::exception& error) {
    result.failed = host::printable(error.what());
  }
}

using Truths = std::map<std::string, reference::Image>;

/// A renderer of its own: it is gone, with its maps, before anything is timed.
void addSlowTruths(const Setup& setup, const MeasureOptions& options, const ReferenceCache& cache, Truths& truths) {
  if (!options.mapExact && !options.sceneExact) return;
  tests::SceneAnswers answers = tests::renderScene(optionsOf(setup, options.scenesFolder));
  for (auto* lights : {&answers.maps.lights, &answers.view.lights})
    if (setup.lights > 0) cycle(*lights, setup.lights);
  if (setup.lights > 0) cycle(answers.maps.shadows, setup.lights);
  for (auto* medium : {&answers.maps.medium, &answers.view.medium})
    scaleMedium(*medium, setup.density);
  if (options.mapExact) truths["map"] = cache.mapExact(answers.maps);
  if (options.sceneExact) truths["scene"] = cache.sceneExact(answers.view, answers.triangles);
}

class Bench {
public:
  Bench(const Setup& setup, const MeasureOptions& options, const ReferenceCache& cache, const Report& report)
      : setup_(setup), options_(options), report_(report) {
    resetPeakMemory();
    report("references", 0);
    addSlowTruths(setup, options, cache, truths_);
    report("scene", 0);
    stage_.emplace(setup, options.scenesFolder);
  }

  std::vector<Result> run() {
    const std::unique_ptr<Runner> exact = make(parseTechnique("exact"));
    report_("exact", 0);
    truths_["exact"] = stage_->inscatterOf(*exact);
    for (const Technique& technique : setup_.techniques)
      if (!stopped()) warmUp(technique);
    for (int run = 0; run < options_.runs; ++run)
      for (Case& c : cases_) {
        if (stopped()) break;
        report_(fmt::format("{} run {}", c.result.technique.name, run + 1), 1);
        if (c.runs() && !isTimedEnough(c.result)) guarded(c.result, [&] { stage_->time(*c.runner, c.result); });
      }
    std::vector<Result> results;
    for (Case& c : cases_) {
      if (stopped() && c.runs() && c.result.milliseconds.empty()) takeWarmUp(c);
      finish(c);
      // What Ctrl-C left without a single time is left out; how many runs the others have is in the results.
      const bool untimed = c.runs() && c.result.milliseconds.empty();
      if (!untimed) results.push_back(c.result);
    }
    return results;
  }

private:
  bool stopped() const { return options_.stop && *options_.stop; }

  bool isTimedEnough(const Result& result) const {
    constexpr std::size_t kLeastRuns = 3;
    const std::vector<double>& times = result.milliseconds;
    return times.size() >= kLeastRuns &&
           std::accumulate(times.begin(), times.end(), 0.0) >= 1000 * options_.secondsOfRuns;
  }

  std::unique_ptr<Runner> make(const Technique& technique) const {
    return makeRunner(technique, stage_->loader(), host::isSoftware(stage_->driver()));
  }

  /// Draws once for the error and, where compiling shaders could matter, once more as it will be timed.
  void warmUp(const Technique& technique) {
    constexpr double kCompilingMatters = 2000; // milliseconds
    cases_.push_back({});
    Case& c = cases_.back();
    c.result.setup = setup_;
    c.result.setup.techniques.clear();
    c.result.technique = technique;
    c.result.driver = stage_->driver();
    c.result.lightCount = stage_->composited().lights.size();
    report_(technique.name, 1);
    guarded(c.result, [&] {
      c.runner = make(technique);
      c.result.skipped = c.runner->reasonAgainst(stage_->composited());
      if (!c.result.skipped.empty()) return;
      const auto start = std::chrono::steady_clock::now();
      const reference::Image image = stage_->inscatterOf(*c.runner);
      const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
      for (const auto& [name, truth] : truths_)
        c.result.errors[name] = reference::compare(image, truth);
      if (c.result.errors["exact"].nonFinite > 0) throw host::Error("the picture has a NaN or an infinity");
      if (time.count() < kCompilingMatters) stage_->time(*c.runner, c.warmUp);
    });
  }

  static void takeWarmUp(Case& c) {
    c.result.milliseconds = c.warmUp.milliseconds;
    c.result.gpuMilliseconds = c.warmUp.gpuMilliseconds;
  }

  /// As many as fit into the time of a technique's runs.
  int runsOfPasses(const Result& result) const {
    constexpr double kLeast = 1;
    const double fitting = 1000 * options_.secondsOfRuns / result.median();
    return static_cast<int>(std::clamp<double>(fitting, kLeast, options_.runs));
  }

  void finish(Case& c) {
    c.result.peakMemory = peakMemory();
    if (!c.runs() || c.result.milliseconds.empty()) return;
    c.result.bytes = c.runner->bytes();
    if (stopped()) return;
    report_(c.result.technique.name + " passes", 1);
    if (c.result.technique.group == Group::Exact) // one pass a light: what it takes is known
      return;
    guarded(c.result, [&] {
      c.result.counts = c.runner->counts(stage_->composited());
      const int runs = host::isSoftware(stage_->driver()) ? 1 : runsOfPasses(c.result); // a GPU's are small and differ
      if (!addFloors(c)) c.result.passes = c.runner->timedPasses(stage_->composited(), runs, [] {});
      if (options_.calls && c.result.technique.group == Group::Ours)
        c.result.calls =
            callTimes(settingsFor(c.result.technique), stage_->loader(), stage_->composited(), runsOfPasses(c.result));
    });
  }

  /// False unless the floors are wanted and there are any; else the passes are timed, too.
  bool addFloors(Case& c) {
    tyndall::Frame frame = stage_->composited();
    if (!options_.floors || c.result.technique.group != Group::Ours) return false;
    frame.settings = settingsFor(c.result.technique);
    if (!reasonAgainstFloors(frame).empty()) return false;
    Floors floors(frame, *c.result.counts);
    c.result.passes = c.runner->timedPasses(frame, runsOfPasses(c.result), [&floors] { floors.run(); });
    c.result.floors = floors.beside(c.result.passes);
    return true;
  }

  const Setup& setup_;
  const MeasureOptions& options_;
  const Report& report_;
  Truths truths_;
  std::optional<Stage> stage_; ///< outlives the runners
  std::vector<Case> cases_;
};

} // namespace

std::vector<Result> measure(const Setup& setup, const MeasureOptions& options, const ReferenceCache& cache,
                            const Report& report) {
  Result whole;
  std::vector<Result> results;
  guarded(whole, [&] { results = Bench(setup, options, cache, report).run(); });
  if (whole.failed.empty()) return results;
  for (const Technique& technique : setup.techniques) {
    results.push_back(whole);
    results.back().setup = setup;
    results.back().setup.techniques.clear();
    results.back().technique = technique;
  }
  return results;
}

} // namespace bench
