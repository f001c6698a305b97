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
  explicit Renderer(const MapScene& scene) : scene_(scene), rays_(scene.camera, scene.width, scene.height) {
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
    if (isLit(scene_.ambient))
      answer.inscatter += ambientLight(scene_.medium, scene_.ambient, ray, end) *
                          openShare(scene_.occlusion, (x + 0.5) / scene_.width, (y + 0.5) / scene_.height);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      const Airlight airlight(scene_.medium, scene_.lights[i], ray);
      answer.inscatter += lightOf(i, airlight, ray, end);
    }
    return answer;
  }

  Rgb lightOf(std::size_t i, const Airlight& airlight, const Ray& ray, double end) const {
    if (scene_.curves.empty() || scene_.curves[i].size == 0)
      return shadowedInscatter(lights_[i], airlight, ray, 0, end);
    constexpr int kSteps = 2000;
    Rgb sum(0);
    for (int k = 0; k < kSteps; ++k) {
      const double from = end * k / kSteps, to = end * (k + 1) / kSteps;
      sum += shadowedInscatter(lights_[i], airlight, ray, from, to) *
             dimming(scene_.curves[i], scene_.lights[i], ray.at(0.5 * (from + to)), ray.direction);
    }
    return sum;
  }

  const MapScene& scene_;
  CameraRays rays_;
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
