#include "Plan.h"

#include <cmath>
#include <fmt/format.h>

namespace bench {

namespace {

std::vector<Technique> parseAll(const std::vector<std::string>& names) {
  std::vector<Technique> techniques;
  for (const std::string& name : names)
    techniques.push_back(parseTechnique(name));
  return techniques;
}

Setup scalingSetup(const std::string& series, const std::string& scene, double x) {
  Setup setup;
  setup.series = series;
  setup.scene = scene;
  setup.x = x;
  setup.techniques = parseAll({"high", "balanced", "performance", "fixed:64", "half:64", "epipolar-march:512"});
  return setup;
}

void addShadowSeries(std::vector<Setup>& setups) {
  for (const int size : {512, 1024, 2048, 4096, 8192}) {
    Setup setup = scalingSetup("shadow", "nave", size);
    setup.shadowSize = size;
    setup.techniques.push_back(parseTechnique("exact"));
    setups.push_back(setup);
  }
}

void addImageSeries(std::vector<Setup>& setups) {
  for (const auto& [width, height] : {std::pair(640, 360), {1280, 720}, {1920, 1080}, {2560, 1440}, {3840, 2160}}) {
    Setup setup = scalingSetup("image", "nave", static_cast<double>(width) * height);
    setup.width = width;
    setup.height = height;
    setup.shadowSize = 2048;
    setups.push_back(setup);
  }
}

void addSliceSeries(std::vector<Setup>& setups) {
  for (const int slices : {128, 256, 512, 1024, 2048}) {
    Setup setup = scalingSetup("slices", "nave", slices);
    setup.techniques = parseAll(
        {fmt::format("epipolar:{}", slices), fmt::format("tree:{}", slices), fmt::format("epipolar-march:{}", slices)});
    setups.push_back(setup);
  }
}

} // namespace

std::string Setup::label() const {
  std::string text = fmt::format("{} {}x{} shadow {} {}", scene, width, height, shadowSize, host::nameOf(context));
  if (lights > 0) text += fmt::format(" lights {}", lights);
  if (density != 1) text += fmt::format(" density {}", density);
  return text;
}

std::vector<Setup> planCurves(const Request& request) {
  std::vector<Setup> setups;
  for (const host::ContextKind context : request.contexts)
    for (const std::string& scene : request.scenes)
      for (const auto& [width, height] : request.sizes)
        for (const int shadowSize : request.shadowSizes)
          for (const int lights : request.lights)
            for (const double density : request.densities)
              setups.push_back(
                  {"curve", 0, scene, width, height, shadowSize, lights, density, context, request.techniques});
  return setups;
}

std::vector<Setup> planScaling(host::ContextKind context) {
  std::vector<Setup> setups;
  addShadowSeries(setups);
  addImageSeries(setups);
  addSliceSeries(setups);
  for (const int lights : {1, 2, 4, 8}) {
    Setup setup = scalingSetup("lights", "stage", lights);
    setup.lights = lights;
    setup.shadowSize = 1024;
    setups.push_back(setup);
  }
  for (const double density : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    Setup setup = scalingSetup("density", "nave", density);
    setup.density = density;
    setups.push_back(setup);
  }
  for (Setup& setup : setups)
    setup.context = context;
  return setups;
}

} // namespace bench
