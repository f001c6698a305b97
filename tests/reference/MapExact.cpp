#include "MapExact.h"

#include "CameraRays.h"
#include "MapVisibility.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace reference {
namespace {

void requireSize(const char* name, std::size_t size, std::size_t expected) {
  if (size != expected)
    throw std::invalid_argument("reference::mapExact: " + std::string(name) + " has " + std::to_string(size) +
                                " values, expected " + std::to_string(expected));
}

void requireConsistent(const MapScene& scene) {
  const auto count = [](int a, int b, int c) {
    return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
  };
  requireSize("depth", scene.depth.size(), count(scene.width, scene.height, scene.samples));
  if (!scene.shadows.empty()) requireSize("shadows", scene.shadows.size(), scene.lights.size());
  if (!scene.curves.empty()) requireSize("curves", scene.curves.size(), scene.lights.size());
  for (std::size_t i = 0; i < scene.shadows.size(); ++i) {
    const ShadowImage& image = scene.shadows[i];
    const std::size_t texels = count(image.width, image.height, image.layers);
    if (!image.depth.empty()) requireSize("shadow depth", image.depth.size(), texels);
    if (!image.glassColour.empty()) {
      requireSize("glass colour", image.glassColour.size(), 3 * texels);
      requireSize("glass depth", image.glassDepth.size(), texels);
    }
    for (const tyndall::ShadowView& view : scene.lights[i].shadow.views)
      if (image.width > 0 && (view.layer < 0 || view.layer >= image.layers))
        throw std::invalid_argument("reference::mapExact: a shadow view's layer is outside its image");
  }
}

/// All that does not depend on the pixel.
class Renderer {
public:
  explicit Renderer(const MapScene& scene)
      : scene_(scene), rays_(scene.camera, scene.width, scene.height), axis_(axisOf(scene.camera)) {
    requireConsistent(scene);
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
      lights_.push_back(prepareLight(scene.lights[i], scene.shadows.empty() ? none_ : scene.shadows[i], scene.filter));
  }
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  PixelAnswer pixel(int x, int y) const {
    PixelAnswer mean{Rgb(0), Rgb(0)};
    const auto first =
        static_cast<std::size_t>(scene_.samples) *
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(scene_.width) + static_cast<std::size_t>(x));
    for (int i = 0; i < scene_.samples; ++i) {
      const PixelAnswer one = sample(x, y, scene_.depth[first + static_cast<std::size_t>(i)]);
      mean.inscatter += one.inscatter / static_cast<double>(scene_.samples);
      mean.transmittance += one.transmittance / static_cast<double>(scene_.samples);
    }
    return mean;
  }

private:
  PixelAnswer sample(int x, int y, float depth) const {
    if (std::isnan(depth)) return {};
    const Ray ray = rays_.ray(x, y);
    const double hit = rays_.distance(x, y, depth);
    const double end = std::isinf(hit) ? scene_.medium.farDistance : std::max(0.0, hit);
    PixelAnswer answer{Rgb(0), transmittance(scene_.medium, ray, end)};
    if (!scene_.medium.dimsBackground) answer.transmittance = Rgb(1);
    const Lights lights = lightsAlong(x, y, ray);
    if (scene_.eyeCurves.map.size == 0) {
      answer.inscatter = lightOf(lights, ray, 0, end, end);
      return answer;
    }
    const double advance = glm::dot(ray.direction, axis_);
    const EyeDimming dimming(scene_.eyeCurves, (x + 0.5) / scene_.width, (y + 0.5) / scene_.height, advance);
    if (scene_.eyeCurves.dimsBackground) answer.transmittance *= dimming.inFogAt(end);
    const auto light = [&](double from, double to) { return lightOf(lights, ray, from, to, end); };
    constexpr double kTold = 3e-6; // of all that the ray has
    const double told = kTold * brightest(light(0, end));
    double from = 0;
    const auto addUpTo = [&](double to) {
      answer.inscatter += dimmedLight(light, dimming, from, to, light(from, to), told);
      answer.inscatter += fogLight(lights, dimming, ray, from, to, end);
      from = to;
    };
    for (const double bend : dimming.bends())
      if (bend > from && bend < end) addUpTo(bend);
    addUpTo(end);
    return answer;
  }

  static double brightest(const Rgb& light) { return std::max({light.x, light.y, light.z}); }

  /// Of a stretch of so much light, over which dimming changes evenly: halved until it tells no more in which half the
  /// light is.
  template <typename LightBetween>
  static Rgb dimmedLight(const LightBetween& light, const EyeDimming& dimming, double from, double to, const Rgb& all,
                         double told, int depth = 0) {
    constexpr int kLeast = 2, kDeepest = 16;
    if (std::isinf(to)) return all * dimming.at(1e30); // no change on to the sky
    const double middle = 0.5 * (from + to), change = std::abs(dimming.at(to) - dimming.at(from));
    if (change * brightest(all) <= told || depth == kDeepest) return all * dimming.at(middle);
    const Rgb first = light(from, middle), second = all - first;
    if (depth >= kLeast && change * brightest(glm::abs(first - second)) <= told)
      return first * dimming.at(0.5 * (from + middle)) + second * dimming.at(0.5 * (middle + to));
    return dimmedLight(light, dimming, from, middle, first, told, depth + 1) +
           dimmedLight(light, dimming, middle, to, second, told, depth + 1);
  }

  /// Of the surroundings, times the share that is open, and of the lights. Foggy: as if each unit of length scattered,
  /// besides, as much as fog does of what is taken.
  struct Lights {
    std::vector<Airlight> surroundings, lights, foggySurroundings, foggy;
    double open = 1;
  };

  Lights lightsAlong(int x, int y, const Ray& ray) const {
    Lights along;
    if (isLit(scene_.ambient)) {
      along.surroundings.push_back(ambientAirlight(scene_.medium, scene_.ambient, ray));
      along.open = openShare(scene_.occlusion, (x + 0.5) / scene_.width, (y + 0.5) / scene_.height);
    }
    for (const tyndall::Light& light : scene_.lights)
      along.lights.emplace_back(scene_.medium, light, ray);
    if (toRgb(scene_.eyeCurves.fog.scattering) == Rgb(0)) return along;
    const tyndall::Medium foggy = foggyMedium();
    for (const tyndall::Light& light : scene_.lights)
      along.foggy.emplace_back(foggy, light, ray);
    if (!isLit(scene_.ambient)) return along;
    std::vector<Rgb> radiances(foggy.constituents.size(), Rgb(0));
    radiances.back() = glm::max(scatteredRadiance(scene_.eyeCurves.fog, scene_.ambient, ray.direction), 0.0);
    along.foggySurroundings.emplace_back(foggy, radiances, ray);
    return along;
  }

  /// The medium, of whose absorption so much scatters instead.
  tyndall::Medium foggyMedium() const {
    tyndall::Medium medium = scene_.medium;
    if (medium.absorptionLayer != -1 && toRgb(medium.absorption) != Rgb(0))
      throw std::invalid_argument("reference::mapExact: fog before the eye needs an absorption that is even");
    medium.absorptionLayer = -1;
    medium.constituents.push_back(scene_.eyeCurves.fog);
    for (std::size_t c = 0; c < 3; ++c)
      medium.absorption[c] -= scene_.eyeCurves.fog.scattering[c];
    return medium;
  }

  Rgb fogLightOf(const Lights& lights, const Ray& ray, double from, double to, double end) const {
    Rgb sum(0);
    for (const Airlight& airlight : lights.foggySurroundings)
      sum += lights.open * airlight.span(from, to);
    for (std::size_t i = 0; i < lights.lights.size(); ++i)
      sum += lightOf(i, lights.foggy[i], ray, from, to, end) - lightOf(i, lights.lights[i], ray, from, to, end);
    return sum;
  }

  /// What fog scatters of what is taken of light between two bends, and at once at the first.
  Rgb fogLight(const Lights& lights, const EyeDimming& dimming, const Ray& ray, double from, double to,
               double end) const {
    if (lights.foggy.empty() && lights.foggySurroundings.empty()) return Rgb(0);
    Rgb sum(0);
    const auto add = [&](double taken, double a, double b) {
      if (taken > 1e-9 && b > a && std::isfinite(b)) sum += fogLightOf(lights, ray, a, b, end) * (taken / (b - a));
    };
    const auto behind = [&](double s) { return dimming.inFogAt(s + 1e-9 * s); };
    const auto before = [&](double s) { return dimming.inFogAt(s - 1e-9 * s); };
    add(before(from) - behind(from), from - 1e-6 * from, from + 1e-6 * from);
    constexpr int kParts = 16;
    for (int i = 0; i < kParts; ++i) {
      const double a = from + (to - from) * i / kParts, b = from + (to - from) * (i + 1) / kParts;
      add(behind(a) - before(b), a, b);
    }
    return sum;
  }

  /// Between two places of a ray that ends at `end`.
  Rgb lightOf(const Lights& lights, const Ray& ray, double from, double to, double end) const {
    Rgb sum(0);
    for (const Airlight& airlight : lights.surroundings)
      sum += lights.open * airlight.span(from, to);
    for (std::size_t i = 0; i < lights.lights.size(); ++i)
      sum += lightOf(i, lights.lights[i], ray, from, to, end);
    return sum;
  }

  Rgb lightOf(std::size_t i, const Airlight& airlight, const Ray& ray, double from, double to, double end) const {
    if (scene_.curves.empty() || scene_.curves[i].size == 0)
      return shadowedInscatter(lights_[i], airlight, ray, from, to);
    constexpr double kSteps = 2000; // of the whole ray
    if (!(to > from)) return Rgb(0);
    const int steps =
        std::isinf(end) ? static_cast<int>(kSteps) : 1 + static_cast<int>(std::ceil(kSteps * (to - from) / end));
    Rgb sum(0);
    for (int k = 0; k < steps; ++k) {
      const double begin = from + (to - from) * k / steps, behind = from + (to - from) * (k + 1) / steps;
      sum += shadowedInscatter(lights_[i], airlight, ray, begin, behind) *
             dimming(scene_.curves[i], scene_.lights[i], ray.at(0.5 * (begin + behind)), ray.direction);
    }
    return sum;
  }

  /// Along which distances to the eye are measured.
  static glm::dvec3 axisOf(const tyndall::Camera& camera) {
    const glm::dmat4 view = glm::transpose(toMat4(camera.viewFromWorld));
    const glm::dvec3 w(glm::transpose(toMat4(camera.clipFromView) * toMat4(camera.viewFromWorld))[3]);
    return glm::normalize(w == glm::dvec3(0) ? -glm::dvec3(view[2]) : w);
  }

  const MapScene& scene_;
  CameraRays rays_;
  glm::dvec3 axis_;
  ShadowImage none_;
  std::vector<PreparedLight> lights_;
};

} // namespace

ImageAnswer mapExact(const MapScene& scene) {
  const Renderer renderer(scene);
  ImageAnswer answer{Image(scene.width, scene.height), Image(scene.width, scene.height)};
  parallelFor(scene.height, [&](int y) {
    for (int x = 0; x < scene.width; ++x) {
      const PixelAnswer pixel = renderer.pixel(x, y);
      answer.inscatter.set(x, y, pixel.inscatter);
      answer.transmittance.set(x, y, pixel.transmittance);
    }
  });
  return answer;
}

std::vector<PixelAnswer> mapExact(const MapScene& scene, const std::vector<glm::ivec2>& pixels) {
  const Renderer renderer(scene);
  std::vector<PixelAnswer> answers(pixels.size());
  parallelFor(static_cast<int>(pixels.size()), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    answers[k] = renderer.pixel(pixels[k].x, pixels[k].y);
  });
  return answers;
}

} // namespace reference
