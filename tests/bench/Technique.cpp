#include "Technique.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <gl/ReadBack.h>
#include <scene/Error.h>
#include <stdexcept>

namespace bench {

namespace {

struct Family {
  const char* name;
  Group group;
  int leastParameters, mostParameters;
  int low, high; // of each parameter
  const char* help;
};

constexpr Family kFamilies[] = {
    {"exact", Group::Exact, 0, 0, 0, 0, "every shadow texel of every pixel's ray: the reference"},
    {"high", Group::Ours, 0, 0, 0, 0, "the effect's profile"},
    {"balanced", Group::Ours, 0, 0, 0, 0, "the effect's profile"},
    {"performance", Group::Ours, 0, 0, 0, 0, "the effect's profile"},
    {"epipolar", Group::Ours, 1, 2, 1, 8192, "the effect with :SLICES or :SLICESxSAMPLES, else as profile high"},
    {"target", Group::Ours, 1, 1, 1, 1000, "the effect as profile high, for an error of :N thousandths of the mean"},
    {"fixed", Group::Shipping, 1, 1, 1, 4096, ":N steps a pixel with interleaved gradient noise"},
    {"half", Group::Shipping, 1, 1, 1, 4096, ":N steps at half resolution, blurred and upsampled by depth"},
    {"froxels", Group::Shipping, 1, 3, 1, 1024, ":D for 160x90xD, or :WxHxD"},
    {"epipolar-march", Group::Shipping, 1, 2, 2, 8192, ":LINES or :LINESxSAMPLES, a march per texel (2010)"},
    {"tree", Group::Research, 0, 1, 1, 8192, "every pixel through its slice's tree (Chen 2011), [:SLICES]"},
    {"lowrank", Group::Research, 0, 1, 1, 8, "the same with low-rank airlight (Chen 2011), [:TERMS]"},
    {"pyramid", Group::Research, 0, 0, 0, 0, "a 2D min/max pyramid of the shadow map, walked per pixel"},
    {"incremental", Group::Research, 1, 2, 2, 8192, ":LINES or :LINESxSAMPLES, on the CPU (Baran 2010)"},
    {"volumes", Group::Research, 1, 1, 2, 4096,
     ":CELLS a side of the shadow map as a mesh, rasterised (Billeter 2010)"},
};

const Family* familyOf(const std::string& name) {
  for (const Family& family : kFamilies)
    if (name == family.name) return &family;
  return nullptr;
}

std::vector<int> parseParameters(const std::string& name, const std::string& text, const Family& family) {
  std::vector<int> parameters;
  const char* at = text.data();
  const char* end = at + text.size();
  while (true) {
    int value = 0;
    const auto [rest, error] = std::from_chars(at, end, value);
    const bool valid = error == std::errc() && value >= family.low && value <= family.high;
    if (!valid || (rest != end && (*rest != 'x' || rest + 1 == end)))
      throw std::invalid_argument(
          fmt::format("\"{}\": what follows {}: must be whole numbers from {} to {}, joined by x", name, family.name,
                      family.low, family.high));
    parameters.push_back(value);
    if (rest == end) return parameters;
    at = rest + 1;
  }
}

std::string familyNames() {
  std::string names;
  for (const Family& family : kFamilies)
    names += (names.empty() ? "" : ", ") + std::string(family.name);
  return names;
}

} // namespace

const char* nameOf(Group group) {
  constexpr const char* kNames[] = {"exact", "ours", "shipping", "research"};
  return kNames[static_cast<int>(group)];
}

Technique parseTechnique(const std::string& name) {
  const std::size_t colon = name.find(':');
  const std::string head = name.substr(0, colon);
  const Family* family = familyOf(head);
  if (!family) throw std::invalid_argument(fmt::format("\"{}\": must be one of {}", name, familyNames()));
  Technique technique{name, head, {}, family->group};
  if (colon != std::string::npos && family->mostParameters == 0)
    throw std::invalid_argument(fmt::format("\"{}\": {} takes no numbers", name, head));
  if (colon != std::string::npos) technique.parameters = parseParameters(name, name.substr(colon + 1), *family);
  const auto count = static_cast<int>(technique.parameters.size());
  const bool froxelPair = head == "froxels" && count == 2;
  if (count < family->leastParameters || count > family->mostParameters || froxelPair)
    throw std::invalid_argument(fmt::format("\"{}\": {} needs {}", name, head, family->help));
  if (head == "epipolar" && count == 2 && technique.parameters[1] % 64 != 0)
    throw std::invalid_argument(fmt::format("\"{}\": samples must be a multiple of 64", name));
  return technique;
}

std::string techniqueHelp() {
  std::string text;
  for (const Family& family : kFamilies)
    text += fmt::format("  {:<16}{}\n", family.name, family.help);
  return text;
}

std::vector<std::string> allTechniques() {
  std::vector<std::string> names = {"exact", "high", "balanced", "performance"};
  for (const char* family : {"fixed", "half"})
    for (const int steps : {16, 32, 64, 128, 256, 512})
      names.push_back(fmt::format("{}:{}", family, steps));
  for (const char* name :
       {"froxels:64", "froxels:128", "epipolar-march:256", "epipolar-march:512", "epipolar-march:1024", "tree:256",
        "tree:512", "tree:1024", "lowrank:4", "pyramid", "volumes:256", "volumes:512", "volumes:1024", "volumes:2048",
        "incremental:256", "incremental:512", "incremental:1024"})
    names.emplace_back(name);
  return names;
}

tyndall::Settings settingsFor(const Technique& technique) {
  using tyndall::Profile;
  tyndall::Settings settings = tyndall::settingsOf(technique.family == "exact"         ? Profile::Reference
                                                   : technique.family == "performance" ? Profile::Performance
                                                   : technique.family == "balanced"    ? Profile::Balanced
                                                                                       : Profile::High);
  if (technique.family == "tree") settings.technique = tyndall::Technique::Tree;
  if (technique.family == "lowrank") {
    settings.technique = tyndall::Technique::LowRank;
    if (!technique.parameters.empty()) settings.lowRankTerms = technique.parameters[0];
    return settings;
  }
  if (technique.family == "target") {
    settings.errorTarget = 1e-3F * static_cast<float>(technique.parameters[0]);
    return settings;
  }
  if (!technique.parameters.empty()) settings.slices = technique.parameters[0];
  if (technique.parameters.size() > 1) settings.samples = technique.parameters[1];
  return settings;
}

std::optional<double> Counts::visitsEstimate() const {
  if (!visitsPerRay) return std::nullopt;
  return *visitsPerRay * static_cast<double>(rays);
}

namespace {

/// Of frames with the same passes.
std::vector<tyndall::PassStatistics> mediansOf(const std::vector<std::vector<tyndall::PassStatistics>>& frames) {
  std::vector<tyndall::PassStatistics> passes = frames[0];
  for (std::size_t i = 0; i < passes.size(); ++i) {
    std::vector<double> times;
    for (const auto& frame : frames)
      times.push_back(frame.at(i).milliseconds);
    std::sort(times.begin(), times.end());
    passes[i].milliseconds = times[times.size() / 2];
  }
  return passes;
}

/// Two effects, so that what times the passes does not slow what is timed as a whole.
class EffectRunner : public Runner {
public:
  EffectRunner(const tyndall::Settings& settings, tyndall::GlLoader loader, bool software)
      : settings_(settings), loader_(loader),
        timing_(software ? tyndall::PassTiming::Finish : tyndall::PassTiming::TimerQuery),
        effect_(create(tyndall::PassTiming::Off)) {}

  std::string reasonAgainst(const tyndall::Frame& /*frame*/) const override { return {}; }
  void render(const tyndall::Frame& frame) override { renderBy(*effect_, frame); }
  std::vector<tyndall::PassStatistics> timedPasses(const tyndall::Frame& frame, int runs,
                                                   const std::function<void()>& between) override {
    const std::unique_ptr<tyndall::Effect> timed = create(timing_);
    renderBy(*timed, frame); // compiles
    std::vector<std::vector<tyndall::PassStatistics>> all;
    for (int run = 0; run < runs; ++run) {
      renderBy(*timed, frame);
      all.push_back(timed->statistics().passes);
      between();
    }
    return mediansOf(all);
  }
  std::uint64_t bytes() override { return effect_->statistics().bytes; }
  std::optional<Counts> counts(const tyndall::Frame& frame) override {
    const std::unique_ptr<tyndall::Effect> counting = create(tyndall::PassTiming::Off);
    renderBy(*counting, frame);
    const tyndall::Statistics statistics = counting->statistics();
    Counts counts;
    counts.rays = statistics.marchedSamples;
    counts.fixupPixels = statistics.fixupPixels;
    counts.slices = statistics.drawnSlices;
    counts.errorEstimate = statistics.errorEstimate;
    counts.shareOverTarget = statistics.shareOverTarget;
    if (settings_.technique == tyndall::Technique::Exact) return counts;
    renderBy(*counting, frame, tyndall::DebugView::NodeVisits);
    counts.visitsPerRay = counting->statistics().visitsPerRay;
    if (settings_.technique != tyndall::Technique::Epipolar) return counts;
    renderBy(*counting, frame, tyndall::DebugView::MarchSamples);
    const std::vector<float> shown = host::readColour(frame.colour, frame.viewport.width, frame.viewport.height, 3);
    for (std::size_t i = 0; i < shown.size(); i += 3)
      counts.packedRays += 0.5 * shown[i] + shown[i + 1]; // red: breaks, green: bends
    return counts;
  }

private:
  std::unique_ptr<tyndall::Effect> create(tyndall::PassTiming timing) const {
    tyndall::CreateResult created = tyndall::Effect::create({loader_, timing});
    if (!created.effect) throw host::Error("effect: " + created.status.message);
    return std::move(created.effect);
  }
  void renderBy(tyndall::Effect& effect, tyndall::Frame frame,
                tyndall::DebugView view = tyndall::DebugView::Composite) const {
    frame.settings = settings_;
    frame.settings.debugView = view;
    const tyndall::Status status = effect.render(frame);
    if (!status) throw host::Error("effect: " + status.message);
  }

  tyndall::Settings settings_;
  tyndall::GlLoader loader_;
  tyndall::PassTiming timing_;
  std::unique_ptr<tyndall::Effect> effect_;
};

class BaselineRunner : public Runner {
public:
  explicit BaselineRunner(std::unique_ptr<Baseline> baseline) : baseline_(std::move(baseline)) {}

  std::string reasonAgainst(const tyndall::Frame& frame) const override { return baseline_->reasonAgainst(frame); }
  void render(const tyndall::Frame& frame) override { baseline_->render(frame); }
  std::vector<tyndall::PassStatistics> timedPasses(const tyndall::Frame& frame, int /*runs*/,
                                                   const std::function<void()>& /*between*/) override {
    baseline_->timePasses(true);
    baseline_->render(frame);
    baseline_->timePasses(false);
    return baseline_->passes();
  }
  std::uint64_t bytes() override { return baseline_->bytes(); }

private:
  std::unique_ptr<Baseline> baseline_;
};

std::unique_ptr<Baseline> makeBaseline(const Technique& technique) {
  const std::vector<int>& p = technique.parameters;
  if (technique.family == "fixed") return makeFixedSteps(p[0]);
  if (technique.family == "half") return makeHalfResolution(p[0]);
  if (technique.family == "froxels") return p.size() == 1 ? makeFroxels(160, 90, p[0]) : makeFroxels(p[0], p[1], p[2]);
  if (technique.family == "pyramid") return makePyramid();
  if (technique.family == "incremental") return makeIncremental(p[0], p.back());
  if (technique.family == "volumes") return makeLightVolumes(p[0]);
  return makeEpipolarMarch(p[0], p.back());
}

} // namespace

std::unique_ptr<Runner> makeRunner(const Technique& technique, tyndall::GlLoader loader, bool software) {
  const bool isEffect = technique.group == Group::Exact || technique.group == Group::Ours ||
                        technique.family == "tree" || technique.family == "lowrank";
  if (isEffect) return std::make_unique<EffectRunner>(settingsFor(technique), loader, software);
  return std::make_unique<BaselineRunner>(makeBaseline(technique));
}

} // namespace bench
