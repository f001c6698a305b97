#include "Options.h"
#include "SettingOptions.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <scene/Error.h>
#include <scene/ProgramFiles.h>
#include <settings/StateFile.h>
#include <tuple>

namespace render {

namespace {

constexpr int kMaxFrame = 999999;
constexpr int kMaxRepeat = 10000;
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
States
  --state takes what the viewer saves: scene, camera, lights, medium, picture and all settings, as JSON; what is left out
  is at its default. --lights, --medium, --ambient and --fog take parts of it as they are there:
  '{"absorption": [0.01, 0.01, 0.01]}'.
Program cache
  Linked programs are kept in $XDG_CACHE_HOME/tyndall/programs, ~/.cache/tyndall/programs by default, at most 64 MiB:
  what was not used for the longest time goes. Where that folder cannot be written, none are kept.
Exit status
  0: done; 1: failed, with one line that names file and cause; 2: wrong usage.)";

/// What does not go into the options as it is.
struct Given {
  settings::LookAt lookAt;
  std::optional<int> camera;
  std::filesystem::path scene;
  Overrides profile, overrides; ///< in this order
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

void addCamera(CLI::App& app, Given& given) {
  auto* camera = app.add_option("--camera", given.camera, "the N-th camera of the scene, from 0 (default 0)")
                     ->check(CLI::Range(0, kMaxFrame));
  const auto addPoint = [&](const char* name, glm::dvec3& point, const char* help) {
    return app
        .add_option_function<std::string>(
            name, [name, &point](const std::string& text) { point = parsePoint(name, text); }, help)
        ->type_name("X,Y,Z");
  };
  const auto& rows = settings::lookAtTable();
  auto* eye = addPoint("--eye", given.lookAt.eye, rows["eye"].help.c_str())->excludes(camera);
  auto* target = addPoint("--target", given.lookAt.target, rows["target"].help.c_str())->needs(eye);
  eye->needs(target);
  app.add_option("--fov", given.lookAt.fovDegrees, rows["fovDegrees"].help + " (default 50)")
      ->check(numberThat("must be" + settings::rangeOf(rows["fovDegrees"].rule) + " degrees",
                         [](double x) { return x > 0 && x < 180; }))
      ->needs(eye);
}

/// Text of a part of a state, as JSON, from which `parse` makes it.
template <typename Parse>
auto parsedPart(const std::string& option, const std::string& text, const Parse& parse) {
  try {
    return parse(text, option);
  } catch (const host::Error& error) {
    throw UsageError(error.what());
  }
}

void addLights(CLI::App& app, Options& options, Given& given) {
  auto* sun = app.add_option_function<std::string>(
                     "--sun", [&](const std::string& text) { options.sun = parseSun(text); },
                     "a sun instead of the scene's lights: where its light travels to, and irradiance")
                  ->type_name("DX,DY,DZ[,R,G,B]");
  app.add_option_function<std::string>(
         "--lights",
         [&given](const std::string& text) {
           const auto lights = parsedPart("--lights", text, settings::parseLights);
           given.overrides.emplace_back([lights](settings::State& state) { state.lights = lights; });
         },
         "lights instead of the scene's: a list as in state files")
      ->type_name("JSON")
      ->excludes(sun);
  app.add_option_function<std::string>(
         "--medium",
         [&](const std::string& text) {
           if (text.front() != '{') {
             options.mediumFile = text;
             return;
           }
           const auto medium = parsedPart("--medium", text, settings::parseMedium);
           given.overrides.emplace_back([medium](settings::State& state) { state.medium = medium; });
         },
         "the medium, instead of the scene's: a file, or a medium as in state files")
      ->type_name("M.json");
  app.add_option_function<std::string>(
         "--ambient",
         [&](const std::string& text) {
           if (text.front() != '{') {
             options.ambientFile = text;
             return;
           }
           const auto ambient = parsedPart("--ambient", text, settings::parseAmbient);
           given.overrides.emplace_back([ambient](settings::State& state) { state.ambient = ambient; });
         },
         "light of the surroundings that the medium scatters, instead of the scene's: a file, or as in state files")
      ->type_name("A.json");
  app.add_option_function<std::string>(
         "--fog",
         [&given](const std::string& text) {
           const auto fog = parsedPart("--fog", text, settings::parseFog);
           given.overrides.emplace_back([fog](settings::State& state) { state.fog = fog; });
         },
         "what fog, or lit smoke, scatters and what fills the scene's banks, instead of the scene's: as in state files")
      ->type_name("JSON");
}

void addState(CLI::App& app, Options& options, Given& given) {
  app.add_option("--state", options.stateFile,
                 "scene, view and settings of the viewer's; what is given besides wins over it")
      ->type_name("STATE.json");
  addCamera(app, given);
  addLights(app, options, given);
  app.add_option_function<std::string>(
         "--size",
         [&](const std::string& text) {
           const auto size = parseSize("--size", text, 1);
           given.overrides.emplace_back([size](settings::State& state) { std::tie(state.width, state.height) = size; });
         },
         "pixels (default 1280x720)")
      ->type_name("WxH");
  const auto whole = [](settings::State& state) -> settings::State& { return state; };
  addSettings(app, settings::pictureTable(), whole, given.overrides);
  addEffectSettings(app, given.profile, given.overrides);
  addSettings(
      app, settings::tuningTable(), [](settings::State& s) -> tyndall::Tuning& { return s.tuning; }, given.overrides);
  addSettings(app, settings::mapsTable(), whole, given.overrides);
  addSettings(app, settings::volumesTable(), whole, given.overrides);
  addSettings(
      app, settings::reuseTable(), [](settings::State& s) -> tyndall::Reuse& { return s.reuse; }, given.overrides);
}

void addFrames(CLI::App& app, Options& options, Given& given) {
  auto* frames = app.add_option_function<std::string>(
                        "--frames", [&](const std::string& text) { options.frames = parseFrames(text); },
                        "frames of the animation, at 24 a second")
                     ->type_name("A-B")
                     ->excludes(app.get_option("--time"));
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
}

/// The state: a file's or the defaults, and what is given besides.
void makeState(Options& options, const Given& given) {
  if (options.stateFile) static_cast<settings::State&>(options) = settings::loadState(*options.stateFile);
  if (!given.scene.empty()) options.scene = given.scene;
  if (options.scene.empty()) throw UsageError("SCENE is required, or a --state that names one");
  for (const Overrides* overrides : {&given.profile, &given.overrides})
    for (const auto& override : *overrides)
      override(options);
  if (!given.camera) return;
  options.camera = given.camera;
  options.lookAt.reset();
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
  // What is kept of the frame before is so only to rounding: where frames are left out, each is drawn by itself.
  if (options.frames && !given.noReuse && !options.share && !options.resume && !options.repeat)
    options.reuse.changes = given.detectChanges ? tyndall::Changes::Detect : tyndall::Changes::Objects;
  if (options.frames) options.seconds = 0;
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
  Given given;
  CLI::App app("Renders a glTF scene with Tyndall's volumetric shadows.", "tyndall-render");
  app.footer(kFooter);
  app.set_version_flag("--version", "tyndall-render " TYNDALL_VERSION);
  app.add_option("SCENE", given.scene, "a glTF 2.0 file, .glb or .gltf");
  addState(app, options, given);
  addFrames(app, options, given);
  addRest(app, options, given);
  parseArguments(app, argc, argv);
  makeState(options, given);
  if (app.count("--eye") > 0) {
    options.lookAt = given.lookAt;
    options.camera.reset();
  }
  complete(options, given);
  return options;
}

} // namespace render
