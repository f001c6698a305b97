#include "Options.h"
#include "CommandLine.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <scene/ProgramFiles.h>
#include <string_view>
#include <tuple>

namespace render {

namespace {

constexpr std::array<std::string_view, 4> kProfiles = {"performance", "balanced", "high", "reference"};
constexpr std::array<std::string_view, 4> kTechniques = {"exact", "tree", "epipolar", "lowrank"};
// In the order of tyndall::DebugView.
constexpr std::array<std::string_view, 11> kViews = {"composite",     "slices",       "samples",     "breaks",
                                                     "march-samples", "fixup-pixels", "node-visits", "inscatter",
                                                     "transmittance", "difference",   "redrawn"};
constexpr int kMaxFrame = 999999;
constexpr int kMaxRepeat = 10000;
constexpr int kMaxSupersample = 8;
constexpr const char* kFramePlace = "%04d";

constexpr const char* kFooter = R"(
Files
  EXR: 32-bit float; R G B (composite), inscatter.{R,G,B}, transmittance.{R,G,B}, Z (distance along the view
  axis in world units; 1e30 where there is only sky). PNG: the tone-mapped composite.
  With --supersample the PNG is the mean after tone mapping; the EXR keeps every pixel that was rendered.
  Files are written in their folder and renamed when complete. A link is followed; a file that is write-protected, an
  input, or named by another output is refused.
Views
  composite (default), inscatter, transmittance, and difference (to exact; grey 0, red +10 %, blue -10 % of the mean);
  redrawn (red: not kept from the last frame);
  with --technique tree, lowrank or epipolar slices and node-visits (black 0 to white 1023, ticks at 4, 16, 64, 256); with
  epipolar samples, breaks, march-samples and fixup-pixels. tyndall.h explains the colours. All but composite and
  inscatter go into the PNG without tone mapping.
Shares
  Several runs draw one animation: --share 1/3, 2/3 and 3/3, at once or not, write what one run with --no-reuse does, bit
  for bit. The exposure is that of the first of --frames in each. With --resume a run goes on where one was ended: a
  picture is whole if all of it can be read and its size and channels are those asked for; options are not compared.
  --missing prints "3-7,12", say, and ends with 1, or prints nothing and ends with 0.
Program cache
  Linked programs are kept in $XDG_CACHE_HOME/tyndall/programs, ~/.cache/tyndall/programs by default, at most 64 MiB:
  what was not used for the longest time goes. Where that folder cannot be written, none are kept.
Exit status
  0: done; 1: failed, with one line that names file and cause; 2: wrong usage.)";

/// The options as typed.
struct Typed {
  std::string scene, camera, eye, target, fov, sun, size, supersample, profile, technique, view, slices, samples,
      rowStep, tree, breakThreshold, bendThreshold, leastWeight, averageThreshold, spreadThreshold, lowRankTerms,
      sampleBudget, cascadeFade, filter, medium, shadowSize, avsmSize, avsmNodes, cascades, frames, repeat, context,
      stats, exposure, share;
  std::vector<std::string> out;
  bool reversedDepth = false, noReuse = false, noAvsm = false, noProgramCache = false, detectChanges = false,
       strict = false, resume = false, missing = false;
};

double parseFinite(const std::string& option, const std::string& value, const std::string& part) {
  const auto number = parseWhole<double>(part);
  if (!number || !std::isfinite(*number)) failUsage(option, value, fmt::format("\"{}\" is not a finite number", part));
  return *number;
}

std::vector<double> parseNumbers(const std::string& option, const std::string& value) {
  std::vector<double> numbers;
  for (const std::string& part : split(value, ','))
    numbers.push_back(parseFinite(option, value, part));
  return numbers;
}

glm::dvec3 parsePoint(const std::string& option, const std::string& value) {
  const std::vector<double> numbers = parseNumbers(option, value);
  if (numbers.size() != 3) failUsage(option, value, "must be three numbers X,Y,Z");
  return {numbers[0], numbers[1], numbers[2]};
}

Sun parseSun(const std::string& value) {
  const std::vector<double> n = parseNumbers("--sun", value);
  if (n.size() != 3 && n.size() != 6) failUsage("--sun", value, "must be DX,DY,DZ or DX,DY,DZ,R,G,B");
  Sun sun;
  sun.direction = {n[0], n[1], n[2]};
  const double length = glm::length(sun.direction);
  if (!(length > 0) || !std::isfinite(length)) failUsage("--sun", value, "its direction must have a length");
  if (n.size() == 6) {
    if (n[3] < 0 || n[4] < 0 || n[5] < 0) failUsage("--sun", value, "its colour must not be negative");
    sun.colour = glm::vec3(n[3], n[4], n[5]);
    if (!std::isfinite(sun.colour->r + sun.colour->g + sun.colour->b))
      failUsage("--sun", value, "its colour must be finite as 32-bit floats");
  }
  return sun;
}

void readSize(const std::string& value, const std::string& supersample, Options& options) {
  std::tie(options.width, options.height) = parseSize("--size", value, 1);
  options.supersample = parseInt("--supersample", supersample, 1, kMaxSupersample);
  if (std::max(renderedWidth(options), renderedHeight(options)) > tyndall::kMaxImageSize)
    failUsage("--supersample", supersample, fmt::format("makes more than {} pixels a side", tyndall::kMaxImageSize));
}

FrameRange parseFrames(const std::string& value) {
  const std::vector<std::string> parts = split(value, '-');
  const std::string rule = fmt::format("must be FIRST-LAST, 0 <= FIRST <= LAST <= {}", kMaxFrame);
  if (parts.size() != 2) failUsage("--frames", value, rule);
  const auto first = parseWhole<int>(parts[0]);
  const auto last = parseWhole<int>(parts[1]);
  if (!first || !last || *first < 0 || *last < *first || *last > kMaxFrame) failUsage("--frames", value, rule);
  return {*first, *last};
}

Share parseShare(const std::string& value) {
  const std::vector<std::string> parts = split(value, '/');
  const std::string rule = fmt::format("must be K/N, 1 <= K <= N <= {}", kMaxFrame + 1);
  if (parts.size() != 2) failUsage("--share", value, rule);
  const auto index = parseWhole<int>(parts[0]);
  const auto count = parseWhole<int>(parts[1]);
  if (!index || !count || *index < 1 || *count < *index || *count > kMaxFrame + 1) failUsage("--share", value, rule);
  return {*index, *count};
}

// What is kept of the frame before is so only to rounding: where frames are left out, each is drawn by itself.
void readFrames(const Typed& typed, Options& options) {
  if (!typed.frames.empty()) options.frames = parseFrames(typed.frames);
  if (!typed.share.empty()) {
    if (typed.frames.empty()) failUsage("--share", typed.share, "needs --frames");
    options.share = parseShare(typed.share);
  }
  options.resume = typed.resume;
  options.missing = typed.missing;
  for (const auto& [option, given] : {std::pair("--resume", typed.resume), std::pair("--missing", typed.missing)}) {
    if (given && typed.out.empty()) failUsage(option, "given", "needs --out");
    if (given && !typed.stats.empty()) failUsage(option, "given", "cannot go with --stats");
  }
  const bool leavesOut = options.share || options.resume;
  if (typed.detectChanges && (typed.noReuse || leavesOut))
    failUsage("--detect-changes", "given", "cannot go with --no-reuse, --share or --resume");
  if (options.frames && !typed.noReuse && !leavesOut && !options.repeat)
    options.changes = typed.detectChanges ? tyndall::Changes::Detect : tyndall::Changes::Objects;
}

void readView(const Typed& typed, Options& options) {
  if (!typed.camera.empty()) {
    if (!typed.eye.empty()) failUsage("--camera", typed.camera, "cannot go with --eye");
    options.camera = parseInt("--camera", typed.camera, 0, kMaxFrame);
  }
  if (typed.eye.empty() != typed.target.empty())
    failUsage(typed.eye.empty() ? "--target" : "--eye", typed.eye.empty() ? typed.target : typed.eye,
              "--eye and --target go together");
  if (typed.eye.empty()) {
    if (!typed.fov.empty()) failUsage("--fov", typed.fov, "needs --eye and --target");
    return;
  }
  LookAt lookAt;
  lookAt.eye = parsePoint("--eye", typed.eye);
  lookAt.target = parsePoint("--target", typed.target);
  if (lookAt.eye == lookAt.target) failUsage("--target", typed.target, "must differ from --eye");
  if (!typed.fov.empty()) {
    lookAt.fovDegrees = parseFinite("--fov", typed.fov, typed.fov);
    if (lookAt.fovDegrees <= 0 || lookAt.fovDegrees >= 180)
      failUsage("--fov", typed.fov, "must be between 0 and 180 degrees");
  }
  options.lookAt = lookAt;
}

// A threshold, from above 0 or from 0 on.
std::optional<float> parseThreshold(const std::string& option, const std::string& value, bool zero, double high) {
  if (value.empty()) return std::nullopt;
  const double number = parseFinite(option, value, value);
  if (number < 0 || (number == 0 && !zero) || number > high)
    failUsage(option, value, fmt::format("must be {} 0, at most {}", zero ? "at least" : "above", high));
  return static_cast<float>(number);
}

tyndall::DebugView parseView(const std::string& name) {
  const auto* const found = std::find(kViews.begin(), kViews.end(), name);
  if (found == kViews.end()) failUsage("--view", name, fmt::format("must be one of {}", fmt::join(kViews, ", ")));
  return static_cast<tyndall::DebugView>(found - kViews.begin());
}

void readQuality(const Typed& typed, Options& options) {
  if (std::find(kProfiles.begin(), kProfiles.end(), typed.profile) == kProfiles.end())
    failUsage("--profile", typed.profile, "must be performance, balanced, high or reference");
  options.profile = typed.profile;
  if (!typed.slices.empty()) options.slices = parseInt("--slices", typed.slices, 1, 8192);
  if (!typed.samples.empty()) options.samples = parseInt("--samples", typed.samples, 64, 8192);
  if (options.samples.value_or(64) % 64 != 0) failUsage("--samples", typed.samples, "must be a multiple of 64");
  if (!typed.rowStep.empty()) options.rowStep = parseInt("--row-step", typed.rowStep, 1, 8);
  options.breakThreshold = parseThreshold("--break-threshold", typed.breakThreshold, false, 1e6);
  options.bendThreshold = parseThreshold("--bend-threshold", typed.bendThreshold, false, 1e6);
  options.leastWeight = parseThreshold("--least-weight", typed.leastWeight, true, 1);
  options.averageThreshold = parseThreshold("--average-threshold", typed.averageThreshold, true, 1);
  options.spreadThreshold = parseThreshold("--spread-threshold", typed.spreadThreshold, false, 1e6);
  if (!typed.lowRankTerms.empty()) options.lowRankTerms = parseInt("--low-rank-terms", typed.lowRankTerms, 1, 8);
  if (!typed.sampleBudget.empty())
    options.sampleBudget = parseInt("--sample-budget", typed.sampleBudget, 4096, 1 << 30);
  if (!typed.tree.empty() && typed.tree != "on" && typed.tree != "off")
    failUsage("--tree", typed.tree, "must be on or off");
  options.minMaxTree = typed.tree != "off";
  options.technique = !typed.technique.empty() ? typed.technique : typed.profile == "reference" ? "exact" : "epipolar";
  if (std::find(kTechniques.begin(), kTechniques.end(), options.technique) == kTechniques.end())
    failUsage("--technique", options.technique, "must be exact, tree, epipolar or lowrank");
  if (!typed.view.empty()) options.view = parseView(typed.view);
  if (typed.filter == "bilinear")
    options.shadowFilter = tyndall::ShadowFilter::Bilinear;
  else if (typed.filter != "nearest")
    failUsage("--filter", typed.filter, "must be nearest or bilinear");
  options.shadowSize = parseInt("--shadow-size", typed.shadowSize, 1, tyndall::kMaxImageSize);
  options.cascades = parseInt("--cascades", typed.cascades, 1, 4);
  if (const auto fade = parseThreshold("--cascade-fade", typed.cascadeFade, true, 0.5)) options.cascadeFade = *fade;
  options.avsm = !typed.noAvsm;
  options.avsmSize = parseInt("--avsm-size", typed.avsmSize, 1, 4096);
  options.avsmNodes = parseInt("--avsm-nodes", typed.avsmNodes, 4, 16);
  if (options.avsmNodes % 4 != 0) failUsage("--avsm-nodes", typed.avsmNodes, "must be 4, 8, 12 or 16");
  options.reversedDepth = typed.reversedDepth;
  if (!typed.repeat.empty()) options.repeat = parseInt("--repeat", typed.repeat, 1, kMaxRepeat);
}

void readOutputs(const Typed& typed, Options& options) {
  if (typed.out.size() > 2) failUsage("--out", typed.out.back(), "may be given twice at most");
  for (const std::string& name : typed.out) {
    std::string extension = std::filesystem::path(name).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (extension != ".exr" && extension != ".png") failUsage("--out", name, "must end in .exr or .png");
    const bool holdsPlace = name.find(kFramePlace) != std::string::npos;
    if (holdsPlace != options.frames.has_value())
      failUsage("--out", name,
                holdsPlace ? "holds %04d, which needs --frames" : "must hold %04d when --frames is given");
    options.out.emplace_back(name);
  }
  if (!typed.stats.empty()) options.stats = typed.stats;
}

void addOptions(CLI::App& app, Typed& typed) {
  app.add_option("SCENE", typed.scene, "a glTF 2.0 file, .glb or .gltf")->required();
  app.add_option("--camera", typed.camera, "the N-th camera of the scene, from 0 (default 0)")->type_name("N");
  app.add_option("--eye", typed.eye, "look from here instead")->type_name("X,Y,Z");
  app.add_option("--target", typed.target, "at this point, y up")->type_name("X,Y,Z");
  app.add_option("--fov", typed.fov, "vertical angle of that view (default 50)")->type_name("DEGREES");
  app.add_option("--sun", typed.sun, "a sun instead of the scene's lights: where its light travels to, and irradiance")
      ->type_name("DX,DY,DZ[,R,G,B]");
  app.add_option("--size", typed.size, "pixels (default 1280x720)")->type_name("WxH");
  app.add_option("--supersample", typed.supersample, "render N x N pixels for each one of the picture (default 1)")
      ->type_name("N");
  app.add_option("--profile", typed.profile, "quality: performance, balanced, high (default) or reference")
      ->type_name("NAME");
  app.add_option("--technique", typed.technique, "exact, tree, epipolar or lowrank; by the profile if not given")
      ->type_name("NAME");
  app.add_option("--view", typed.view, "a debug view instead of the composite, see below")->type_name("NAME");
  app.add_option("--slices", typed.slices, "epipolar lines; by the profile if not given")->type_name("N");
  app.add_option("--samples", typed.samples, "samples of a slice, a multiple of 64; by the profile if not given")
      ->type_name("N");
  app.add_option("--row-step", typed.rowStep,
                 "shadow texels from one sample of a row to the next; by the profile if not given")
      ->type_name("N");
  app.add_option("--tree", typed.tree, "skip along rows by their min/max tree: on (default) or off")
      ->type_name("SWITCH");
  app.add_option("--break-threshold", typed.breakThreshold, "change of distance that counts as a depth break")
      ->type_name("X");
  app.add_option("--bend-threshold", typed.bendThreshold, "bend of the inscatter that is marched more finely")
      ->type_name("X");
  app.add_option("--least-weight", typed.leastWeight, "bilateral weight under which a pixel is marched by itself");
  app.add_option("--average-threshold", typed.averageThreshold,
                 "optical depth of a stretch of a row that is taken by its average (default 0.1)");
  app.add_option("--spread-threshold", typed.spreadThreshold,
                 "spread of the samples around a pixel over which it is marched by itself")
      ->type_name("X");
  app.add_option("--sample-budget", typed.sampleBudget, "slices x samples of all lights together, from 4096 on")
      ->type_name("N");
  app.add_option("--low-rank-terms", typed.lowRankTerms, "terms of technique lowrank, 1 to 8 (default 4)")
      ->type_name("N");
  app.add_option("--filter", typed.filter, "of the shadow map: nearest (default) or bilinear")->type_name("NAME");
  app.add_option("--medium", typed.medium, "the medium, instead of the scene's")->type_name("M.json");
  app.add_option("--shadow-size", typed.shadowSize, "texels per side of a shadow map (default 4096)")->type_name("N");
  app.add_option("--cascade-fade", typed.cascadeFade,
                 "share of a cascade's width over which it fades into the next, up to 0.5 (default 0.1)");
  app.add_option("--cascades", typed.cascades, "shadow maps of a directional light, 1 to 4 (default 1)")
      ->type_name("N");
  app.add_option("--avsm-size", typed.avsmSize, "texels per side of a light's map of smoke and strands (default 256)")
      ->type_name("N");
  app.add_option("--avsm-nodes", typed.avsmNodes, "nodes of its curves: 4, 8 (default), 12 or 16")->type_name("N");
  app.add_flag("--no-avsm", typed.noAvsm, "smoke and strands cast no shadows");
  app.add_flag("--reversed-depth", typed.reversedDepth, "camera and shadow depth fall from 1 to 0");
  app.add_option("--frames", typed.frames, "frames of the animation, at 24 a second")->type_name("A-B");
  app.add_option("--share", typed.share, "of these frames only every N-th from the K-th on, each drawn in full")
      ->type_name("K/N");
  app.add_flag("--resume", typed.resume, "leave frames whose pictures are whole as they are, draw the others in full");
  app.add_flag("--missing", typed.missing, "draw nothing: print which frames' pictures are not there or not whole");
  app.add_flag("--no-reuse", typed.noReuse, "draw every frame in full, not only what has moved since the last one");
  app.add_flag("--detect-changes", typed.detectChanges, "find what has moved by comparison, not by the scene's nodes");
  app.add_option("--repeat", typed.repeat, "after a warm-up, time N renders of each frame, in full")->type_name("N");
  app.add_option("--context", typed.context, "osmesa (default; egl where it is not installed), egl or glfw")
      ->type_name("NAME");
  app.add_option("--out", typed.out, "a picture, .exr or .png; may be given twice; %04d is the frame")
      ->type_name("IMAGE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--stats", typed.stats, "timings and counts as JSON")->type_name("S.json");
  app.add_flag("--no-program-cache", typed.noProgramCache,
               "compile every shader: linked programs are neither read from the user's cache folder nor kept there");
  app.add_flag("--strict", typed.strict, "fail where there is a note: nothing is made up, left out or changed");
  app.add_option("--exposure", typed.exposure, "of the PNG, in stops (default: by the first picture's brightness)")
      ->type_name("STOPS");
}

Options fromTyped(const Typed& typed) {
  Options options;
  options.scene = typed.scene;
  readView(typed, options);
  if (!typed.sun.empty()) options.sun = parseSun(typed.sun);
  readSize(typed.size, typed.supersample, options);
  readQuality(typed, options);
  if (!typed.medium.empty()) options.medium = typed.medium;
  readFrames(typed, options);
  if (!typed.noProgramCache) options.programs = host::programFolder();
  if (!typed.context.empty()) options.context = parseContext("--context", typed.context);
  readOutputs(typed, options);
  options.strict = typed.strict;
  if (!typed.exposure.empty()) {
    options.exposureStops = parseFinite("--exposure", typed.exposure, typed.exposure);
    if (std::abs(*options.exposureStops) > 100)
      failUsage("--exposure", typed.exposure, "must be from -100 to 100 stops");
  }
  return options;
}

} // namespace

std::vector<int> framesOf(const Options& options) {
  const FrameRange range = options.frames.value_or(FrameRange{});
  const Share share = options.share.value_or(Share{});
  std::vector<int> frames;
  for (int frame = range.first + share.index - 1; frame <= range.last; frame += share.count)
    frames.push_back(frame);
  return frames;
}

Options parseOptions(int argc, const char* const* argv) {
  Typed typed;
  typed.size = "1280x720";
  typed.supersample = "1";
  typed.profile = "high";
  typed.filter = "nearest";
  typed.shadowSize = "4096";
  typed.avsmSize = "256";
  typed.avsmNodes = "8";
  typed.cascades = "1";
  CLI::App app("Renders a glTF scene with Tyndall's volumetric shadows.", "tyndall-render");
  app.footer(kFooter);
  app.set_version_flag("--version", "tyndall-render " TYNDALL_VERSION);
  addOptions(app, typed);
  parseArguments(app, argc, argv);
  return fromTyped(typed);
}

} // namespace render
