// What is in the air and what lights it: Medium, Constituent, Light, banks of fog.
#include "Tables.h"

namespace settings {

using tyndall::Ambient;
using tyndall::Constituent;
using tyndall::HeightLayer;
using tyndall::Light;
using tyndall::Medium;
using tyndall::MediumBoundary;

namespace {

constexpr double kMostFloat = 3e38;
constexpr double kMostDouble = std::numeric_limits<double>::max();
constexpr double kRightAngle = 1.5707963267948966;

std::vector<Choice> phases() {
  using tyndall::Phase;
  return {{"isotropic", "Isotropic", static_cast<int>(Phase::Isotropic)},
          {"rayleigh", "Rayleigh", static_cast<int>(Phase::Rayleigh)},
          {"henyey-greenstein", "HenyeyGreenstein", static_cast<int>(Phase::HenyeyGreenstein)},
          {"cornette-shanks", "CornetteShanks", static_cast<int>(Phase::CornetteShanks)}};
}

std::vector<Choice> kinds() {
  using tyndall::LightKind;
  return {{"directional", "Directional", static_cast<int>(LightKind::Directional)},
          {"point", "Point", static_cast<int>(LightKind::Point)},
          {"spot", "Spot", static_cast<int>(LightKind::Spot)}};
}

Rule finite() { return from(-kMostDouble, kMostDouble); }

std::vector<Setting<MediumBoundary>> boundaryRows() {
  return {
      switchOf("enabled", &MediumBoundary::enabled, "directional: light is attenuated from a plane on"),
      vector("point", &MediumBoundary::point, Type::Place, finite(), "a point of that plane"),
      vector("normal", &MediumBoundary::normal, Type::Direction, finite(), "its normal, of any length"),
  };
}

std::vector<Setting<Light>> lightRows() {
  std::vector<Setting<Light>> rows = {
      choice("kind", &Light::kind, "LightKind", kinds(), "directional: a sun; point: a lamp; spot: a cone"),
      vector("direction", &Light::direction, Type::Direction, finite(),
             "directional, spot: where the light travels to"),
      vector("position", &Light::position, Type::Place, finite(), "point, spot: where the lamp is"),
      vector("colour", &Light::colour, Type::Colour, from(0, kMostFloat),
             "directional: irradiance on a plane facing the light; point, spot: radiant intensity"),
      number("range", &Light::range, also(tyndall::kInfinity, above(0, kMostDouble)), "point, spot: no light beyond"),
      number("innerConeAngle", &Light::innerConeAngle, from(0, kRightAngle),
             "spot: full intensity up to this half angle")
          .in("rad"),
      number("outerConeAngle", &Light::outerConeAngle, above(0, kRightAngle), "spot: none beyond this half angle")
          .in("rad"),
      number("scatteringScale", &Light::scatteringScale, from(0, kMostFloat),
             "all but 1 is unphysical: times what the medium scatters of it")
          .withSlider(0, 10),
      switchOf("litOutsideViews", &Light::litOutsideViews, "visibility where no shadow view reaches"),
      number("cascadeFade", &Light::cascadeFade, from(0, 0.5),
             "directional: share of a cascade's width over which it fades into the next"),
  };
  for (const Setting<MediumBoundary>& row : boundaryRows())
    rows.push_back(part("boundary", &Light::boundary, row));
  return rows;
}

} // namespace

const Table<Medium>& mediumTable() {
  static const Table<Medium> table{
      "Medium",
      {
          vector("absorption", &Medium::absorption, Type::Colour, from(0, kMostFloat),
                 "absorption coefficient, 1/world unit"),
          number("farDistance", &Medium::farDistance, also(tyndall::kInfinity, above(0, kMostDouble)),
                 "where rays to the sky end, world units"),
          number("absorptionLayer", &Medium::absorptionLayer, from(-1, tyndall::kMaxHeightLayers - 1),
                 "the layer whose density absorption is multiplied by; -1: none"),
          vector("up", &Medium::up, Type::Direction, finite(), "along which the density of layers falls"),
          switchOf("dimsBackground", &Medium::dimsBackground,
                   "off is unphysical: it adds its light and dims nothing behind it"),
      }};
  return table;
}

const Table<Constituent>& constituentTable() {
  static const Table<Constituent> table{
      "Constituent",
      {
          vector("scattering", &Constituent::scattering, Type::Colour, from(0, kMostFloat),
                 "scattering coefficient, 1/world unit"),
          choice("phase", &Constituent::phase, "Phase", phases(), "where scattered light goes"),
          number("g", &Constituent::g, between(-1, 1),
                 "asymmetry of HenyeyGreenstein and CornetteShanks: forward above 0, backward below")
              .withSlider(-0.99, 0.99),
          number("layer", &Constituent::layer, from(-1, tyndall::kMaxHeightLayers - 1),
                 "the layer whose density scattering is multiplied by; -1: none"),
      }};
  return table;
}

const Table<HeightLayer>& layerTable() {
  static const Table<HeightLayer> table{
      "HeightLayer",
      {
          number("height", &HeightLayer::height, finite(), "where density is 1, world units along up"),
          number("scale", &HeightLayer::scale, also(tyndall::kInfinity, above(0, kMostDouble)),
                 "over so much height density falls to 1/e, world units")
              .withSlider(0.1, 1e4, true),
          number("ground", &HeightLayer::ground, also(-tyndall::kInfinity, finite()),
                 "below this height density is that at it, world units"),
      }};
  return table;
}

namespace {

/// One of the coefficients.
Setting<Ambient> harmonic(std::size_t i, const char* help) {
  Setting<Ambient> setting;
  setting.field = "harmonics[" + std::to_string(i) + "]";
  setting.help = help;
  setting.type = Type::Colour;
  setting.rule = from(-kMostFloat, kMostFloat);
  setting.isFloat = true;
  setting.get = [i](const Ambient& ambient) {
    const tyndall::Rgb& c = ambient.harmonics[i];
    return Value(decimalOf(c[0]), decimalOf(c[1]), decimalOf(c[2]));
  };
  setting.set = [i](Ambient& ambient, const Value& value) {
    for (int c = 0; c < 3; ++c)
      ambient.harmonics[i][static_cast<std::size_t>(c)] = static_cast<float>(value[c]);
  };
  return setting;
}

} // namespace

const Table<Ambient>& ambientTable() {
  static const Table<Ambient> table = [] {
    Table<Ambient> made{"Ambient",
                        {vector("radiance", &Ambient::radiance, Type::Colour, from(0, kMostFloat),
                                "of the surroundings, from every side")}};
    constexpr const char* kOf[] = {"radiance besides, by its side: of 0.282095",
                                   "of 0.488603 y",
                                   "of 0.488603 z",
                                   "of 0.488603 x",
                                   "of 1.092548 x y",
                                   "of 1.092548 y z",
                                   "of 0.315392 (3 z^2 - 1)",
                                   "of 1.092548 x z",
                                   "of 0.546274 (x^2 - y^2)"};
    for (std::size_t i = 0; i < std::size(kOf); ++i)
      made.rows.push_back(harmonic(i, kOf[i]));
    return made;
  }();
  return table;
}

const Table<StateFog>& fogTable() {
  using host::FogScattering;
  static const Table<StateFog> table = [] {
    Table<StateFog> made{"FogScattering", {}};
    const std::vector<Setting<FogScattering>> rows = {
        vector("albedo", &FogScattering::albedo, Type::Colour, from(0, 1), "share of the light that fog takes"),
        choice("phase", &FogScattering::phase, "Phase", phases(), "where it goes"),
        number("g", &FogScattering::g, between(-1, 1), "asymmetry of HenyeyGreenstein and CornetteShanks")
            .withSlider(-0.99, 0.99),
    };
    for (const Setting<FogScattering>& row : rows) {
      made.rows.push_back(part("scattering", &StateFog::scattering, row));
      made.rows.back().field = row.field;
    }
    return made;
  }();
  return table;
}

const Table<host::FogBank>& fogBankTable() {
  using host::FogBank;
  constexpr int kMostSeed = std::numeric_limits<int>::max();
  constexpr double kMostExtinction = 1e15; // as in scenes
  static const Table<FogBank> table{
      "FogBank",
      {
          number("extinction", &FogBank::extinction, from(0, kMostExtinction), "where it is densest, 1/world unit")
              .withSlider(1e-3, 10, true),
          number("fade", &FogBank::fade, from(0, 1), "share of the half extent over which it thins out to its border"),
          number("clear", &FogBank::clear, from(0, 1), "share of it without fog"),
          number("seed", &FogBank::seed, from(0, kMostSeed), "of its billows").withSlider(0, 100),
      }};
  return table;
}

const Table<StateLight>& lightTable() {
  static const Table<StateLight> table = [] {
    Table<StateLight> made{"Light",
                           {
                               switchOf("on", &StateLight::on, "whether it shines"),
                               number("follows", &StateLight::follows, from(-1, 9999),
                                      "which of the scene's lights it takes place and direction of; -1: its own"),
                           }};
    for (const Setting<Light>& row : lightRows()) {
      Setting<StateLight> mine = part("light", &StateLight::light, row);
      mine.field = row.field;
      made.rows.push_back(std::move(mine));
    }
    return made;
  }();
  return table;
}

const std::vector<Left>& leftToEngines() {
  const char* const texture = "a texture and how it is laid out";
  static const std::vector<Left> left = {
      {"Frame.viewport", "the size of the picture: \"width\", \"height\""},
      {"Frame.colour", texture},
      {"Frame.colourLayer", texture},
      {"Frame.depth", texture},
      {"Frame.camera", "matrices, of a state's camera"},
      {"Frame.lights", "a list of lightTable()"},
      {"Frame.medium", "mediumTable()"},
      {"Frame.ambient", "ambientTable()"},
      {"Frame.eyeCurves", "a texture and how it is laid out; fogTable()"},
      {"Frame.settings", "settingsTable()"},
      {"Frame.output", texture},
      {"Frame.lookup", texture},
      {"Frame.reuse", "reuseTable()"},
      {"Frame.objects", "what the engine moved"},
      {"Medium.constituents", "a list of constituentTable()"},
      {"Medium.layers", "a list of layerTable()"},
      {"Ambient.harmonics", "each is a row"},
      {"Ambient.occlusion", texture},
      {"Light.boundary", "its fields are rows"},
      {"Light.shadow", texture},
      {"Light.glass", texture},
      {"Light.curves", texture},
      {"Reuse.changes", "how the engine tells what it moved: --no-reuse, --detect-changes"},
      {"Reuse.eye", "the engine's count of cameras"},
      {"Reuse.frame", "the engine's count of frames"},
      {"Config.loader", "the engine's"},
      {"Config.timing", "the tool's"},
      {"Config.programs", "the tool's: --no-program-cache"},
      {"Config.state", "the engine's"},
      {"Config.tuning", "tuningTable()"},
      {"Config.checkInputs", "the tool's: --check-inputs"},
      {"Config.warningsAreErrors", "the tool's: --strict"},
      {"Config.betweenDraws", "the tool's"},
  };
  return left;
}

} // namespace settings
