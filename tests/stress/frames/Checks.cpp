#include "Checks.h"

#include "Compare.h"
#include "reference/CameraRays.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <stdexcept>

using namespace tyndall;

namespace stress {

namespace {

constexpr int kTruePixels = 24; // that map-exact is asked about
constexpr double kSame = 1e-3;  // what exact's pictures of the same may differ by
constexpr double kNoise = 1;    // what rows through casters that change from texel to texel may miss, of the mean
// Steps of numbers, relative to what they are a part of.
constexpr double kOfWorld = 1e-14, kOfScene = 1e-13, kOfFloat = 2e-7;

struct Run {
  std::string name;
  Settings settings;
  bool isHeld = false; ///< to the tolerance; the others are counted: how near they come is theirs to choose
};

/// As fine as the frame can be drawn: what is left is what the technique itself does.
Settings finest(Technique technique, ShadowFilter filter) {
  Settings settings;
  settings.technique = technique;
  settings.shadowFilter = filter;
  settings.slices = settings.samples = 8192;
  settings.averageThreshold = 0;
  settings.breakThreshold = settings.bendThreshold = 1e-6F; // every sample is marched
  settings.lowRankTerms = 8;
  return settings;
}

std::vector<Run> runsOf(const Case& made) {
  const ShadowFilter filter = made.frame.settings.shadowFilter;
  std::vector<Run> runs = {{"tree", finest(Technique::Tree, filter), true},
                           {"epipolar", finest(Technique::Epipolar, filter), true},
                           {"lowrank", finest(Technique::LowRank, filter), false}};
  for (const auto& [name, profile] : {std::pair{"performance", Profile::Performance},
                                      std::pair{"balanced", Profile::Balanced}, std::pair{"high", Profile::High}}) {
    runs.push_back({name, settingsOf(profile), false});
    runs.back().settings.shadowFilter = filter;
  }
  runs.push_back({"any settings", made.anySettings, false});
  return runs;
}

/// Whether a lamp is within so many roundings of the eye, which turn its cone or, ofViews, the sides of views of
/// floats.
bool isLampWithin(const Case& made, double roundings, bool ofViews) {
  const glm::dvec3 eye = EyeFrame(made.frame.camera).position;
  for (std::size_t i = 0; i < made.frame.lights.size(); ++i) {
    const Light& light = made.frame.lights[i];
    if (light.kind == LightKind::Directional) continue;
    const glm::dvec3 position = reference::toVec3(light.position);
    const double rounding = kOfWorld * glm::length(eye) + kOfScene * made.worldScale +
                            (ofViews && made.maps[i].isOfFloats ? kOfFloat * glm::length(position) : 0);
    const double angle = light.kind == LightKind::Spot ? std::min(1.0, double(light.outerConeAngle)) : 1.0;
    if (glm::length(position - eye) * angle < roundings * rounding) return true;
  }
  return false;
}

double largest(const Rgb& colour) { return *std::max_element(colour.begin(), colour.end()); }

bool isGood(double value) { return std::isfinite(value) && value >= 0; }

/// The largest value of the pixels around one.
double mostAround(const reference::Image& image, int x, int y, std::size_t channel, int reach) {
  double most = 0;
  for (int v = std::max(0, y - reach); v <= std::min(image.height - 1, y + reach); ++v)
    for (int u = std::max(0, x - reach); u <= std::min(image.width - 1, x + reach); ++u)
      most = std::max(most, image.rgb[image.index(u, v) + channel]);
  return most;
}

class Checker {
public:
  Checker(const Case& made, Effect& effect, const std::string& pictures)
      : made_(made), pictures_(pictures), rig_(made, effect) {}

  Outcome run(const std::set<std::string>& runs) {
    exactSettings_ = made_.frame.settings;
    exactSettings_.technique = Technique::Exact;
    exact_ = draw("exact", exactSettings_);
    unshadowed_ = drawUnshadowed();
    comparable_ = comparableIn();
    checkBound("exact", exact_.inscatter, 0, 1e-3);
    checkTruth();
    for (const Run& one : runsOf(made_))
      if (runs.empty() || runs.count(one.name) > 0) checkRun(one);
    return std::move(outcome_);
  }

  /// Of the picture of another frame.
  void checkRelation(Effect& effect, Outcome& outcome) {
    const std::optional<Case> other = related(made_, made_.relation);
    if (!other) return;
    CaseRig rig(*other, effect);
    // In another place doubles hold a lamp next to the eye in another direction.
    const bool isMoved = made_.relation == Relation::Offset &&
                         (isLampWithin(made_, 1 / kSame, true) || isLampWithin(*other, 1 / kSame, true));
    const std::string name = std::string(nameOf(made_.relation));
    for (const Technique technique : {Technique::Exact, Technique::Epipolar}) {
      if (technique == Technique::Epipolar && comparable_.isLampAtEye) continue; // its light has no end
      const Settings settings =
          technique == Technique::Exact ? exactSettings_ : finest(technique, exactSettings_.shadowFilter);
      const reference::Image before = rig_.render(settings).inscatter;
      const reference::Image picture = rig.render(settings).inscatter;
      outcome.pictures += 2;
      const reference::Image expected = relatedPicture(before, made_.relation);
      Range range;
      const std::vector<double> wanted = withoutGlare(expected.rgb, comparable_);
      range.include(wanted);
      const double scale = meanOfFinite(wanted);
      const std::string check = (technique == Technique::Exact ? "exact: " : "epipolar: ") + name;
      double error = errorBeyond(picture.rgb, range, std::max(scale, comparable_.least));
      outcome.errors[check] = error;
      const double limit = technique == Technique::Exact ? kSame : kTolerance;
      if (error <= limit || (isMoved && std::isfinite(error))) continue;
      if (technique == Technique::Exact) {
        outcome.findings.push_back({check, error, limit, ""});
        continue;
      }
      // Other slices are on the other side of a pixel or texel: as the one picture may be off, so may the other.
      const double left =
          beyondDisplaced(rig, settings, picture, std::max({scale, comparable_.least, storable(settings)}), 1000);
      if (left > kTolerance)
        outcome.findings.push_back(
            {check, error, limit, fmt::format("{:.3g} beyond what half a pixel and half a texel explain", left)});
    }
  }

private:
  Picture draw(const std::string& name, const Settings& settings) {
    ++outcome_.pictures;
    Picture picture = rig_.render(settings);
    for (const reference::Image* image : {&picture.inscatter, &picture.transmittance})
      for (std::size_t i = 0; i < image->rgb.size(); ++i)
        if (!isGood(image->rgb[i])) {
          add(name + ": finite", image->rgb[i], 0,
              fmt::format("{} of pixel {}", image == &picture.inscatter ? "inscatter" : "transmittance", i / 3));
          break;
        }
    if (!picture.lookupFault.empty()) add(name + ": look-up", 1, 0, picture.lookupFault);
    if (!picture.isWithinViewport) add(name + ": viewport", 1, 0, "a texel outside was written");
    if (!pictures_.empty()) write(picture.inscatter, fmt::format("{}/{}-{}.f32", pictures_, made_.seed, name));
    return picture;
  }

  static void write(const reference::Image& image, const std::string& file) {
    const std::vector<float> values(image.rgb.begin(), image.rgb.end());
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(4 * values.size()));
    if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
  }

  reference::Image drawUnshadowed() {
    const Frame frame = rig_.frame;
    for (Light& light : rig_.frame.lights) {
      light.shadow = {};
      light.glass = {};
    }
    reference::Image image = draw("unshadowed", exactSettings_).inscatter;
    rig_.frame = frame;
    return image;
  }

  void add(const std::string& check, double value, double limit, const std::string& detail = "") {
    outcome_.findings.push_back({check, value, limit, detail});
  }

  Comparable comparableIn() const {
    Comparable comparable;
    comparable.isLampAtEye = isLampWithin(made_, 10, false);
    comparable.least = std::max({1e-6 * meanOfFinite(withoutGlare(unshadowed_.rgb, comparable)), invisible(), 1e-30});
    return comparable;
  }

  /// What is left of the lights behind the 40 optical depths after which the effect adds nothing, and some more.
  double invisible() const { return 1e-16 * brightest(); }

  /// Epipolar textures hold coloured light in half floats of what it would be in clear air (setStored of
  /// optics/Slices.cpp): their last steps are no share of less.
  double storable(const Settings& settings) const {
    return settings.technique == Technique::Epipolar && isColoured() ? 0x1p-26 * brightest() : 0;
  }

  bool isColoured() const {
    const auto isGrey = [](const Rgb& rgb) { return rgb[0] == rgb[1] && rgb[1] == rgb[2]; };
    const std::vector<Constituent>& constituents = made_.frame.medium.constituents;
    const bool isTinted = std::any_of(made_.maps.begin(), made_.maps.end(),
                                      [](const LightMaps& maps) { return !maps.image.glassDepth.empty(); });
    return isTinted || !isGrey(made_.frame.medium.absorption) ||
           !std::all_of(constituents.begin(), constituents.end(),
                        [&](const Constituent& constituent) { return isGrey(constituent.scattering); });
  }

  /// Light that a lamp would scatter in clear air; a sun's own.
  double brightest() const {
    const glm::dvec3 eye = EyeFrame(made_.frame.camera).position;
    double scattering = 0, brightest = 0;
    for (const Constituent& constituent : made_.frame.medium.constituents)
      scattering += largest(constituent.scattering);
    for (const Light& light : made_.frame.lights) {
      double radiance = largest(light.colour);
      if (light.kind != LightKind::Directional) {
        const double distance = glm::length(reference::toVec3(light.position) - eye);
        radiance *= std::min(1.0, scattering * distance) / (distance * distance);
      }
      brightest = std::max(brightest, radiance);
    }
    return brightest;
  }

  /// What errors are shares of: the mean, or a thousandth of what it is without shadows if those leave less.
  double scaleOf(const std::vector<double>& values, const Settings& settings) const {
    constexpr double kShadowed = 1e-3;
    return std::max({meanOfFinite(values), kShadowed * meanOfFinite(withoutGlare(unshadowed_.rgb, comparable_)),
                     comparable_.least, storable(settings)});
  }

  /// No light comes from shadows: nowhere more than without them, in the pixel or in those that it is interpolated
  /// from.
  void checkBound(const std::string& name, const reference::Image& image, int reach, double slack) {
    if (comparable_.isLampAtEye) slack = std::max(slack, 0.01); // its light ends by floors alone
    double worst = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const reference::Rgb value = image.at(x, y);
        reference::Rgb most(mostAround(unshadowed_, x, y, 0, reach), mostAround(unshadowed_, x, y, 1, reach),
                            mostAround(unshadowed_, x, y, 2, reach));
        if (reach == 0 && !comparable_.isLampAtEye && excess(value, most) > slack)
          most = unshadowedTruth({x, y});             // which rounds otherwise
        if (reach > 0 && excess(value, most) > slack) // a sample may meet a peak between the pixels
          for (int c = 0; c < 3; ++c)
            most[c] = std::max(most[c], mostAround(brightestBetween(), x, y, static_cast<std::size_t>(c), reach));
        worst = std::max(worst, excess(value, most));
      }
    if (worst > slack) add(name + ": bound", worst, slack, "more than without shadows");
  }

  /// Without shadows, the most that a pixel holds wherever within it rays are cast.
  const reference::Image& brightestBetween() {
    if (brightestBetween_) return *brightestBetween_;
    const Frame frame = rig_.frame;
    for (Light& light : rig_.frame.lights) {
      light.shadow = {};
      light.glass = {};
    }
    constexpr int kPlaces = 100;
    const Range range = displacedExact(rig_, exactSettings_, 0, {0, false}, kPlaces);
    outcome_.pictures += kPlaces;
    rig_.frame = frame;
    brightestBetween_ = unshadowed_;
    for (std::size_t i = 0; i < range.high.size(); ++i)
      if (std::isfinite(range.high[i])) brightestBetween_->rgb[i] = std::max(brightestBetween_->rgb[i], range.high[i]);
    return *brightestBetween_;
  }

  /// Relative, of the channel in which it is the most.
  double excess(const reference::Rgb& value, const reference::Rgb& most) const {
    double worst = 0;
    for (int c = 0; c < 3; ++c)
      if (value[c] > most[c] + comparable_.least)
        worst = std::max(worst, value[c] / std::max(most[c], comparable_.least) - 1);
    return worst;
  }

  reference::Rgb unshadowedTruth(const glm::ivec2& pixel) const {
    reference::MapScene open = rig_.scene();
    for (reference::ShadowImage& map : open.shadows)
      map = {};
    return reference::mapExact(open, {pixel}).front().inscatter;
  }

  void checkTruth() {
    Random random(made_.seed, Axis::Size);
    const Rectangle& viewport = made_.frame.viewport;
    std::vector<glm::ivec2> pixels;
    std::vector<double> values;
    for (int i = 0; i < kTruePixels; ++i) {
      const glm::ivec2 pixel(random.integer(0, viewport.width - 1), random.integer(0, viewport.height - 1));
      if (made_.isOdd[static_cast<std::size_t>(pixel.y * viewport.width + pixel.x)] || isRayThroughLamp(pixel))
        continue;
      pixels.push_back(pixel);
      const reference::Rgb value = exact_.inscatter.at(pixel.x, pixel.y);
      values.insert(values.end(), {value.r, value.g, value.b});
    }
    if (pixels.empty()) return;
    if (comparable_.isLampAtEye) { // the truth has no end
      outcome_.illConditioned.push_back("exact");
      return;
    }
    const std::vector<double> truth = truthOf(rig_.scene(), pixels, comparable_);
    Range range;
    range.include(truth);
    const double scale = scaleOf(truth, exactSettings_);
    double error = errorBeyond(values, range, scale);
    outcome_.errors["exact"] = error;
    if (error <= kTolerance) return;
    if (isLampWithin(made_, 10, true) && std::isfinite(error)) {
      outcome_.illConditioned.push_back("exact");
      return;
    }
    const Range rounded = roundedTruth(rig_.scene(), pixels, comparable_);
    const double left = errorBeyond(values, rounded, scale);
    if (left <= kTolerance)
      outcome_.illConditioned.push_back("exact");
    else
      add("exact: map-exact", error, kTolerance,
          fmt::format("{:.3g} beyond what rounding explains; {}", left, worstOf(values, truth, pixels)));
  }

  /// Whether a lamp lies on the ray of a pixel, as far as floats tell: its light there has no end.
  bool isRayThroughLamp(const glm::ivec2& pixel) const {
    constexpr double kRounding = 3e-6;
    const Rectangle& viewport = made_.frame.viewport;
    const reference::Ray ray =
        reference::CameraRays(made_.frame.camera, viewport.width, viewport.height).ray(pixel.x, pixel.y);
    const double ofWorld = kOfWorld * glm::length(ray.origin);
    return std::any_of(made_.frame.lights.begin(), made_.frame.lights.end(), [&](const Light& light) {
      const glm::dvec3 toLamp = reference::toVec3(light.position) - ray.origin;
      return light.kind != LightKind::Directional && glm::dot(toLamp, ray.direction) > 0 &&
             glm::length(glm::cross(toLamp, ray.direction)) < kRounding * glm::length(toLamp) + 10 * ofWorld;
    });
  }

  /// The value that is farthest from the truth, where that is finite.
  std::string worstOf(const std::vector<double>& values, const std::vector<double>& truth,
                      const std::vector<glm::ivec2>& pixels) const {
    std::size_t worst = 0;
    const auto errorOf = [&](std::size_t i) { return std::isfinite(truth[i]) ? std::abs(values[i] - truth[i]) : -1; };
    for (std::size_t i = 1; i < values.size(); ++i)
      if (errorOf(i) > errorOf(worst)) worst = i;
    const glm::ivec2 pixel = pixels[worst / 3];
    return fmt::format("pixel ({}, {}) has {:.6g} for {:.6g}, unshadowed {:.6g}", pixel.x, pixel.y, values[worst],
                       truth[worst], unshadowed_.rgb[unshadowed_.index(pixel.x, pixel.y) + worst % 3]);
  }

  /// What is left of a picture's error beyond what half a pixel and half a texel change in exact, in up to `most` of 9,
  /// 100 and 1,000 pictures that are displaced at random.
  double beyondDisplaced(CaseRig& rig, const Settings& settings, const reference::Image& picture, double scale,
                         int most) {
    double left = reference::kInfinity;
    for (const int count : {9, 100, 1000}) {
      if (left <= kTolerance || count > most) break;
      const Range displaced = displacedExact(rig, exactSettings_, settings.rowStep, comparable_, count);
      outcome_.pictures += count;
      left = errorBeyond(picture.rgb, displaced, scale);
    }
    return left;
  }

  void checkRun(const Run& one) {
    const Picture picture = draw(one.name, one.settings);
    // Of what a pixel may be interpolated from: its own ray, samples next to it, or regular samples.
    const bool isTree = one.settings.technique == Technique::Tree;
    checkBound(one.name, picture.inscatter, isTree ? 0 : one.isHeld ? 2 : 16, isTree ? 2e-3 : 0.05);
    if (one.name == "any settings") return;
    if (comparable_.isLampAtEye) { // its light has no end
      outcome_.illConditioned.push_back(one.name);
      return;
    }
    Range range;
    const std::vector<double> exact = withoutGlare(exact_.inscatter.rgb, comparable_);
    range.include(exact);
    const double scale = scaleOf(exact, one.settings);
    const double error = errorBeyond(picture.inscatter.rgb, range, scale);
    outcome_.errors[one.name] = error;
    if (error <= kTolerance || !std::isfinite(error)) return; // what is not finite has been said
    const double left = beyondDisplaced(rig_, one.settings, picture.inscatter, scale, one.isHeld ? 1000 : 9);
    outcome_.errors[one.name + ", beyond half a pixel and half a texel"] = left;
    const bool isNoise =
        std::any_of(made_.maps.begin(), made_.maps.end(), [](const LightMaps& maps) { return maps.isNoise; });
    if (left > kTolerance && left <= kNoise && isNoise)
      outcome_.illConditioned.push_back(one.name);
    else if (left > kTolerance && one.isHeld)
      add(one.name + ": exact", error, kTolerance,
          fmt::format("{:.3g} beyond what half a pixel and half a texel explain", left));
  }

  const Case& made_;
  const std::string& pictures_;
  CaseRig rig_;
  Settings exactSettings_;
  Picture exact_;
  reference::Image unshadowed_;
  std::optional<reference::Image> brightestBetween_;
  Comparable comparable_;
  Outcome outcome_;
};

} // namespace

const std::vector<std::string>& runNames() {
  static const std::vector<std::string> names = {"exact",    "tree", "epipolar",     "lowrank", "performance",
                                                 "balanced", "high", "any settings", "relation"};
  return names;
}

Outcome check(const Case& made, Effect& effect, const std::set<std::string>& runs, const std::string& pictures) {
  Outcome outcome;
  try {
    Checker checker(made, effect, pictures);
    outcome = checker.run(runs);
    if (runs.empty() || runs.count("relation") > 0) checker.checkRelation(effect, outcome);
  } catch (const std::runtime_error& error) {
    if (std::string(error.what()).find("clipFromWorld is singular") != std::string::npos && outcome.pictures == 0)
      outcome.illConditioned.push_back("refused"); // a view that doubles do not hold
    else
      outcome.findings.push_back({"status", 0, 0, error.what()});
  }
  for (const std::string& error : tests::testContext().takeErrors())
    outcome.findings.push_back({"GL error", 0, 0, error});
  return outcome;
}

} // namespace stress
