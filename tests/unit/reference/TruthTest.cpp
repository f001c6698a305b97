// The references against images that others computed: two independent ways to the same numbers.
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <reference/SceneExact.h>
#include <scene/GltfLoader.h>
#include <scene/ImageFile.h>
#include <scene/MediumFile.h>
#include <scene/View.h>
#include <string>

using namespace reference;

namespace {

/// R, G, B of a file with row 0 on top.
Image readTruth(const std::filesystem::path& file) {
  const host::Image exr = host::readExr(file);
  Image image(exr.width, exr.height);
  const char* names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    const std::vector<float>* channel = exr.find(names[c]);
    REQUIRE(channel);
    for (int y = 0; y < exr.height; ++y)
      for (int x = 0; x < exr.width; ++x)
        image.rgb[image.index(x, exr.height - 1 - y) + static_cast<std::size_t>(c)] =
            (*channel)[static_cast<std::size_t>(y) * static_cast<std::size_t>(exr.width) + static_cast<std::size_t>(x)];
  }
  return image;
}

SceneView viewOf(const host::Scene& scene, const std::filesystem::path& medium, int width, int height) {
  const std::vector<glm::dmat4> pose = host::poseAt(scene, 0);
  host::Notes notes;
  SceneView view;
  view.camera = host::makeCamera(scene, pose, 0, static_cast<double>(width) / height);
  view.lights = host::makeLights(scene, pose, notes);
  view.medium = host::loadMedium(medium);
  view.width = width;
  view.height = height;
  return view;
}

} // namespace

TEST_CASE("scene-exact matches the independent truth", "[reference][truth]") {
  const std::filesystem::path truth = std::filesystem::path(TYNDALL_SHARED_DIR) / "truth";
  if (!std::filesystem::exists(truth)) {
    WARN("skipped: no " << truth.string());
    return;
  }
  for (const std::string name : {"dir_open", "point_open", "spot_open", "slit", "columns", "boxes"}) {
    CAPTURE(name);
    const std::string stem = "analytic_" + name;
    const host::Scene scene = host::loadScene(truth / "scenes" / (stem + ".glb"));
    const Image expected = readTruth(truth / "images" / (stem + "_320x180.exr"));
    SceneView view = viewOf(scene, truth / "scenes" / (stem + ".medium.json"), expected.width, expected.height);
    // glTF wants the inner cone smaller than the outer one; the truth's cone is hard.
    for (tyndall::Light& light : view.lights)
      light.innerConeAngle = light.kind == tyndall::LightKind::Spot ? light.outerConeAngle : 0;
    const SceneExact exact(trianglesOf(scene, host::poseAt(scene, 0)));
    const Image inscatter = exact.render(view).inscatter;
    // The files hold 12 bits after the leading one: half a unit of the last is 2^-13 = 1.22e-4.
    double worst = 0, largest = 0;
    for (std::size_t i = 0; i < inscatter.rgb.size(); ++i) {
      worst = std::max(worst, std::abs(inscatter.rgb[i] - expected.rgb[i]) / std::max(expected.rgb[i], 1e-12));
      largest = std::max(largest, expected.rgb[i]);
    }
    CHECK(largest > 0.001);
    CHECK(worst <= 1.23e-4);
  }
}
