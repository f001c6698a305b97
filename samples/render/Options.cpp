#include "Options.h"
#include "OptionRules.h"
#include "TuningOptions.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <scene/ProgramFiles.h>
#include <tuple>

namespace render {

namespace {

const std::vector<std::string> kProfiles = {"performance", "balanced", "high", "reference"};
const std::vector<std::string> kTechniques = {"exact", "tree", "epipolar", "lowrank"};
const Names<tyndall::DebugView> kViews = {{"composite", tyndall::DebugView::Composite},
                                          {"slices", tyndall::DebugView::Slices},
                                          {"samples", tyndall::DebugView::Samples},
                                          {"breaks", tyndall::DebugView::Breaks},
                                          {"march-samples", tyndall::DebugView::MarchSamples},
                                          {"fixup-pixels", tyndall::DebugView::FixupPixels},
                                          {"node-visits", tyndall::DebugView::NodeVisits},
                                          {"inscatter", tyndall::DebugView::Inscatter},
                                          {"transmittance", tyndall::DebugView::Transmittance},
                                          {"difference", tyndall::DebugView::Difference},
                                          {"redrawn", tyndall::DebugView::Redrawn},
                                          {"inputs", tyndall::DebugView::Inputs}};
const Names<tyndall::ShadowFilter> kFilters = {{"nearest", tyndall::ShadowFilter::Nearest},
                                               {"bilinear", tyndall::ShadowFilter::Bilinear}};
const Names<host::MapLayout> kLayouts = {
    {"array", host::MapLayout::Array}, {"atlas", host::MapLayout::Atlas}, {"cube", host::MapLayout::Cube}};
const Names<tyndall::DepthEncoding> kEncodings = {{"window", tyndall::DepthEncoding::Window},
                                                  {"axial", tyndall::DepthEncoding::Axial},
                                                  {"radial", tyndall::DepthEncoding::Radial}};
const Names<bool> kSwitch = {{"on", true}, {"off", false}};
constexpr int kMaxFrame = 999999;
constexpr int kMaxRepeat = 10000;
constexpr int kMaxSupersample = 8;
constexpr int kMaxHalton = 1024;
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
  redrawn (red: not kept from the last frame); inputs (distances, and the first light's shadow views);
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

/// What does not go into the options as it is.
struct Given {
  LookAt lookAt;
  bool noReuse = false, detectChanges = false, noProgramCache = false;
};

std::vector<double> parseNumbers(const std::string& option, const std::string& value) {
  std::vector<double> numbers;
  for (const std::string& part : split(value, ',')) {
    const auto number = parseWhole<double>(part);
    if (!number || !std::isfinite(*number)) failUsage(option, value, "\"" + part + "\" is not a finite number");
    numbers.push_back(*number);
  }
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

FrameRange parseFrames(const std::string& value) {
  const std::vector<std::string> parts = split(value, '-');
  const std::string rule = fmt::format("must be FIRST-LAST, 0 <= FIRST <= LAST <= {}", kMaxFrame);
  if (parts.size() != 2) failUsage("--frames", value, rule);
  const auto first = parseWhole<int>(parts[0]);
  const auto last = parseWhole<int>(parts[1]);
  if (!first || !last || *first < 0 || *last < *first || *last > kMaxFrame) failUsage("--frames", value, rule);
  return {*first, *last};
}

void checkOutputs(const Options& options) {
  if (options.out.size() > 2) failUsage("--out", options.out.back(), "may be given twice at most");
  for (const std::filesystem::path& file : options.out) {
    const std::string name = file.string();
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (extension != ".exr" && extension != ".png") failUsage("--out", name, "must end in .exr or .png");
    const bool holdsPlace = name.find(kFramePlace) != std::string::npos;
    if (holdsPlace != options.frames.has_value())
      failUsage("--out", name,
                holdsPlace ? "holds %04d, which needs --frames" : "must hold %04d when --frames is given");
  }
}

CLI::Validator aboveZero(double most) {
  return numberThat(fmt::format("must be above 0, at most {}", most), [most](double x) { return x > 0 && x <= most; });
}

void addView(CLI::App& app, Options& options, LookAt& lookAt) {
  auto* camera = app.add_option("--camera", options.camera, "the N-th camera of the scene, from 0 (default 0)")
                     ->check(CLI::Range(0, kMaxFrame));
  const auto addPoint = [&](const char* name, glm::dvec3& point, const char* help) {
    return app
        .add_option_function<std::string>(
            name, [name, &point](const std::string& text) { point = parsePoint(name, text); }, help)
        ->type_name("X,Y,Z");
  };
  auto* eye = addPoint("--eye", lookAt.eye, "look from here instead")->excludes(camera);
  auto* target = addPoint("--target", lookAt.target, "at this point, y up")->needs(eye);
  eye->needs(target);
  app.add_option("--fov", lookAt.fovDegrees, "vertical angle of that view, in degrees (default 50)")
      ->check(numberThat("must be between 0 and 180 degrees", [](double x) { return x > 0 && x < 180; }))
      ->needs(eye);
  app.add_option_function<std::string>(
         "--sun", [&](const std::string& text) { options.sun = parseSun(text); },
         "a sun instead of the scene's lights: where its light travels to, and irradiance")
      ->type_name("DX,DY,DZ[,R,G,B]");
  app.add_option_function<std::string>(
         "--size",
         [&](const std::string& text) { std::tie(options.width, options.height) = parseSize("--size", text, 1); },
         "pixels (default 1280x720)")
      ->type_name("WxH");
  app.add_option("--supersample", options.supersample, "render N x N pixels for each one of the picture (default 1)")
      ->check(CLI::Range(1, kMaxSupersample));
  app.add_option("--msaa", options.msaa, "samples of a pixel, of colour and depth (default 1)")
      ->check(CLI::IsMember({1, 2, 4, 8}));
  app.add_option("--halton", options.halton,
                 "jitter the camera, from frame to frame, by N points of Halton's in a pixel (default 0: none)")
      ->check(CLI::Range(0, kMaxHalton));
  chooseFrom(kViews, app.add_option("--view", options.view, "a debug view instead of the composite, see below"));
}

void addQuality(CLI::App& app, Options& options) {
  app.add_option("--profile", options.profile, "quality (default high)")
      ->check(CLI::IsMember(kProfiles))
      ->type_name("NAME");
  app.add_option("--technique", options.technique, "by the profile if not given")
      ->check(CLI::IsMember(kTechniques))
      ->type_name("NAME");
  app.add_option("--slices", options.slices, "epipolar lines; by the profile if not given")->check(CLI::Range(1, 8192));
  app.add_option("--samples", options.samples, "samples of a slice, a multiple of 64; by the profile if not given")
      ->check(CLI::Range(64, 8192))
      ->check(numberThat("must be a multiple of 64", [](double x) { return std::fmod(x, 64) == 0; }));
  app.add_option("--row-step", options.rowStep,
                 "shadow texels from one sample of a row to the next; by the profile if not given")
      ->check(CLI::Range(1, 8));
  chooseFrom(kSwitch,
             app.add_option("--tree", options.minMaxTree, "skip along rows by their min/max tree (default on)"));
  app.add_option("--break-threshold", options.breakThreshold, "change of distance that counts as a depth break")
      ->check(aboveZero(1e6));
  app.add_option("--bend-threshold", options.bendThreshold, "bend of the inscatter that is marched more finely")
      ->check(aboveZero(1e6));
  app.add_option("--least-weight", options.leastWeight, "bilateral weight under which a pixel is marched by itself")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--average-threshold", options.averageThreshold,
                 "optical depth of a stretch of a row that is taken by its average (default 0.1)")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--spread-threshold", options.spreadThreshold,
                 "spread of the samples around a pixel over which it is marched by itself")
      ->check(aboveZero(1e6));
  app.add_option("--sample-budget", options.sampleBudget, "slices x samples of all lights together")
      ->check(CLI::Range(4096, 1 << 30));
  app.add_option("--low-rank-terms", options.lowRankTerms, "terms of technique lowrank (default 4)")
      ->check(CLI::Range(1, 8));
}

void addShadows(CLI::App& app, Options& options) {
  chooseFrom(kFilters, app.add_option("--filter", options.shadowFilter, "of the shadow map (default nearest)"));
  app.add_option("--medium", options.medium, "the medium, instead of the scene's")->type_name("M.json");
  app.add_option("--shadow-size", options.shadowSize, "texels per side of a shadow map (default 4096)")
      ->check(CLI::Range(1, tyndall::kMaxImageSize));
  chooseFrom(kLayouts, app.add_option("--shadow-layout", options.mapForm.layout,
                                      "of the maps that the effect gets: cube maps for point lights (default array)"));
  chooseFrom(kEncodings, app.add_option("--shadow-encoding", options.mapForm.encoding,
                                        "of their depths: distances along the axis, or from a lamp (default window)"));
  app.add_option("--cascade-fade", options.cascadeFade,
                 "share of a cascade's width over which it fades into the next (default 0.1)")
      ->check(CLI::Range(0.0, 0.5));
  app.add_option("--cascades", options.cascades, "shadow maps of a directional light (default 1)")
      ->check(CLI::Range(1, 4));
  app.add_option("--avsm-size", options.avsmSize, "texels per side of a light's map of smoke and strands (default 256)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--avsm-nodes", options.avsmNodes, "nodes of its curves (default 8)")
      ->check(CLI::IsMember({4, 8, 12, 16}));
  app.add_flag_callback("--no-avsm", [&] { options.avsm = false; }, "smoke and strands cast no shadows");
  app.add_flag("--reversed-depth", options.reversedDepth, "camera and shadow depth fall from 1 to 0");
}

void addFrames(CLI::App& app, Options& options, Given& given) {
  auto* frames = app.add_option_function<std::string>(
                        "--frames", [&](const std::string& text) { options.frames = parseFrames(text); },
                        "frames of the animation, at 24 a second")
                     ->type_name("A-B");
  auto* share =
      app.add_option_function<std::string>(
             "--share", [&](const std::string& text) { options.share = parseShare("--share", text, kMaxFrame + 1); },
             "of these frames only every N-th from the K-th on, each drawn in full")
          ->type_name("K/N")
          ->needs(frames);
  auto* resume = app.add_flag("--resume", options.resume,
                              "leave frames whose pictures are whole as they are, draw the others in full");
  auto* missing = app.add_flag("--missing", options.missing,
                               "draw nothing: print which frames' pictures are not there or not whole");
  auto* noReuse =
      app.add_flag("--no-reuse", given.noReuse, "draw every frame in full, not only what has moved since the last one");
  app.add_flag("--detect-changes", given.detectChanges, "find what has moved by comparison, not by the scene's nodes")
      ->excludes(noReuse)
      ->excludes(share)
      ->excludes(resume);
  app.add_option("--repeat", options.repeat, "after a warm-up, time N renders of each frame, in full")
      ->check(CLI::Range(1, kMaxRepeat));
  auto* out = app.add_option("--out", options.out, "a picture, .exr or .png; may be given twice; %04d is the frame")
                  ->type_name("IMAGE")
                  ->expected(1)
                  ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  auto* stats = app.add_option("--stats", options.stats, "timings and counts as JSON")->type_name("S.json");
  for (CLI::Option* option : {resume, missing})
    option->needs(out)->excludes(stats);
}

void addRest(CLI::App& app, Options& options, Given& given) {
  chooseFrom(kContextNames,
             app.add_option("--context", options.context, "GL's (default osmesa; egl where it is not installed)"));
  app.add_flag("--no-program-cache", given.noProgramCache,
               "compile every shader: linked programs are neither read from the user's cache folder nor kept there");
  app.add_flag("--check-inputs", options.checkInputs, "note where scene depth and shadow maps do not show one scene");
  app.add_flag("--strict", options.strict, "fail where there is a note: nothing is made up, left out or changed");
  app.add_option("--exposure", options.exposureStops,
                 "of the PNG, in stops (default: by the first picture's brightness)")
      ->check(CLI::Range(-100.0, 100.0));
}

/// What rests on several options.
void complete(Options& options, const Given& given) {
  if (options.lookAt && options.lookAt->eye == options.lookAt->target) {
    const glm::dvec3& at = options.lookAt->target;
    failUsage("--target", fmt::format("{},{},{}", at.x, at.y, at.z), "must differ from --eye");
  }
  if (std::max(renderedWidth(options), renderedHeight(options)) > tyndall::kMaxImageSize)
    failUsage("--supersample", std::to_string(options.supersample),
              fmt::format("makes more than {} pixels a side", tyndall::kMaxImageSize));
  if (options.technique.empty()) options.technique = options.profile == "reference" ? "exact" : "epipolar";
  // What is kept of the frame before is so only to rounding: where frames are left out, each is drawn by itself.
  if (options.frames && !given.noReuse && !options.share && !options.resume && !options.repeat)
    options.changes = given.detectChanges ? tyndall::Changes::Detect : tyndall::Changes::Objects;
  if (!given.noProgramCache) options.programs = host::programFolder();
  checkOutputs(options);
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
  Options options;
  options.technique.clear();
  Given given;
  CLI::App app("Renders a glTF scene with Tyndall's volumetric shadows.", "tyndall-render");
  app.footer(kFooter);
  app.set_version_flag("--version", "tyndall-render " TYNDALL_VERSION);
  app.add_option("SCENE", options.scene, "a glTF 2.0 file, .glb or .gltf")->required();
  addView(app, options, given.lookAt);
  addQuality(app, options);
  addTuning(app, options.tuning);
  addShadows(app, options);
  addFrames(app, options, given);
  addRest(app, options, given);
  parseArguments(app, argc, argv);
  if (app.count("--eye") > 0) options.lookAt = given.lookAt;
  complete(options, given);
  return options;
}

} // namespace render
