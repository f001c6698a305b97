// What the host draws before the effect: the picture, and the maps that it hands over.
#include "Tables.h"

namespace settings {

namespace {

constexpr double kMostPlace = std::numeric_limits<double>::max();
constexpr double kMostSeconds = 1e6;

std::vector<Choice> tones() {
  using host::Tone;
  return {{"film", "Film", static_cast<int>(Tone::Film)},
          {"reinhard", "Reinhard", static_cast<int>(Tone::Reinhard)},
          {"clip", "Clip", static_cast<int>(Tone::Clip)}};
}

std::vector<Choice> layouts() {
  using host::MapLayout;
  return {{"array", "Array", static_cast<int>(MapLayout::Array)},
          {"atlas", "Atlas", static_cast<int>(MapLayout::Atlas)},
          {"cube", "Cube", static_cast<int>(MapLayout::Cube)}};
}

std::vector<Choice> encodings() {
  using tyndall::DepthEncoding;
  return {{"window", "Window", static_cast<int>(DepthEncoding::Window)},
          {"axial", "Axial", static_cast<int>(DepthEncoding::Axial)},
          {"radial", "Radial", static_cast<int>(DepthEncoding::Radial)}};
}

template <typename Row>
Row renamed(Row row, const char* field) {
  row.field = field;
  return row;
}

std::vector<Setting<host::MapForm>> formRows() {
  using host::MapForm;
  return {
      choice("layout", &MapForm::layout, "MapLayout", layouts(),
             "of the maps that the effect gets: cube maps for point lights")
          .withOption("--shadow-layout"),
      choice("encoding", &MapForm::encoding, "DepthEncoding", encodings(),
             "of their depths: distances along the axis, or from a lamp")
          .withOption("--shadow-encoding"),
  };
}

} // namespace

const Table<LookAt>& lookAtTable() {
  static const Table<LookAt> table{
      "LookAt",
      {
          vector("eye", &LookAt::eye, Type::Place, from(-kMostPlace, kMostPlace), "look from here instead"),
          vector("target", &LookAt::target, Type::Place, from(-kMostPlace, kMostPlace), "at this point, y up"),
          number("fovDegrees", &LookAt::fovDegrees, between(0, 180), "vertical angle of that view, in degrees")
              .withSlider(10, 120)
              .in("degrees"),
      }};
  return table;
}

const Table<State>& pictureTable() {
  static const Table<State> table{
      "State",
      {
          number("seconds", &State::seconds, from(0, kMostSeconds), "a moment of the animation, in seconds")
              .withOption("--time")
              .in("s"),
          number("width", &State::width, from(1, tyndall::kMaxImageSize), "pixels of the picture"),
          number("height", &State::height, from(1, tyndall::kMaxImageSize), "pixels of the picture"),
          number("supersample", &State::supersample, from(1, 8), "render N x N pixels for each one of the picture")
              .withOption("--supersample"),
          number("msaa", &State::msaa, only({1, 2, 4, 8}), "samples of a pixel, of colour and depth")
              .withOption("--msaa"),
          number("halton", &State::halton, from(0, 1024),
                 "jitter the camera, from frame to frame, by N points of Halton's in a pixel; 0: none")
              .withOption("--halton"),
          number("exposureStops", &State::exposureStops, from(-100, 100), "of the PNG, in stops")
              .withOption("--exposure", OptionForm::Value,
                          "of the PNG, in stops (default: by the first picture's brightness)")
              .withSlider(-10, 10)
              .in("stops"),
          choice("tone", &State::tone, "Tone", tones(), "of the PNG: how radiance becomes what a screen shows")
              .withOption("--tone"),
      }};
  return table;
}

const Table<State>& mapsTable() {
  static const Table<State> table = [] {
    Table<State> made{
        "State",
        {
            number("shadowSize", &State::shadowSize, from(1, tyndall::kMaxImageSize), "texels per side of a shadow map")
                .withOption("--shadow-size")
                .withSlider(256, 8192, true),
            number("cascades", &State::cascades, from(1, 4), "shadow maps of a directional light")
                .withOption("--cascades"),
            number("cascadeFade", &State::cascadeFade, from(0, 0.5),
                   "share of a cascade's width over which it fades into the next")
                .withOption("--cascade-fade"),
            switchOf("steadyShadows", &State::steadyShadows,
                     "texels of a directional light's shadow maps, which are coarser, stay in place while the camera "
                     "moves")
                .withOption("--steady-shadows", OptionForm::FlagOn),
            renamed(part("mapForm", &State::mapForm, formRows()[0]), "layout"),
            renamed(part("mapForm", &State::mapForm, formRows()[1]), "encoding"),
            switchOf("reversedDepth", &State::reversedDepth, "camera and shadow depth fall from 1 to 0")
                .withOption("--reversed-depth", OptionForm::FlagOn),
        }};
    return made;
  }();
  return table;
}

const Table<State>& volumesTable() {
  constexpr double kMostTimes = 100;
  static const Table<State> table{
      "State",
      {
          switchOf("avsm", &State::avsm, "smoke, fog and strands cast shadows, and fog is drawn")
              .withOption("--no-avsm", OptionForm::FlagOff,
                          "smoke, fog and strands cast no shadows, and fog is not drawn"),
          switchOf("eyeCurves", &State::eyeCurves, "and smoke dims the shafts behind it, and fog is drawn")
              .withOption("--no-eye-curves", OptionForm::FlagOff,
                          "shafts shine through smoke before them, which they do not light, and fog is not drawn"),
          switchOf("litSmoke", &State::litSmoke,
                   "the effect lights smoke, as it does fog, where the scene says what that scatters")
              .withOption("--no-lit-smoke", OptionForm::FlagOff,
                          "smoke is drawn before the effect, with a light of its own"),
          number("avsmSize", &State::avsmSize, from(1, 4096), "texels per side of the maps of smoke, fog and strands")
              .withOption("--avsm-size")
              .withSlider(32, 1024, true),
          number("avsmNodes", &State::avsmNodes, only({4, 8, 12, 16}), "nodes of its curves")
              .withOption("--avsm-nodes"),
          number("smokeDensity", &State::smokeDensity, from(0, kMostTimes), "extinction of smoke, times the scene's")
              .withOption("--smoke-density")
              .withSlider(0, 4),
          number("strandWidth", &State::strandWidth, above(0, kMostTimes), "width of strands, times the scene's")
              .withOption("--strand-width")
              .withSlider(0.1, 10, true),
          number("strandOpacity", &State::strandOpacity, from(0, 1), "opacity of strands, times the scene's")
              .withOption("--strand-opacity"),
      }};
  return table;
}

const Table<PathPoint>& pathTable() {
  static const Table<PathPoint> table = [] {
    Table<PathPoint> made{
        "PathPoint", {number("seconds", &PathPoint::seconds, from(0, kMostSeconds), "from the path's begin").in("s")}};
    for (const Setting<LookAt>& row : lookAtTable().rows)
      made.rows.push_back(renamed(part("view", &PathPoint::view, row), row.field.c_str()));
    return made;
  }();
  return table;
}

} // namespace settings
