// Technique epipolar: scenes that differ by a symmetry, a depth convention or a unit of length give one picture, and an
// orthographic camera comes as close to exact as a perspective one.
#include "ShaftRig.h"
#include "reference/CameraRays.h"
#include "support/Catch.h"

#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace {

const std::vector<LightKind> kKinds = {LightKind::Directional, LightKind::Point, LightKind::Spot};

// A sun beyond a corner of the image, or a lamp above it: no slice begins at a lamp.
Light highLight(LightKind kind) {
  Light light = tests::shaftLight(kind);
  if (kind == LightKind::Directional) light.direction = {-0.9, -0.8, 1};
  return light;
}

// Of a sun or spot, for an eye that looks along -z.
const std::vector<Vec3> kDirections = {{0.25, -0.6, 1}, {0.3, -0.6, -1}, {0, -1, 0}, {1, -0.4, 0}, {0, -0.4, 1}};

void checkBothTechniques(tests::ShaftRig& rig) {
  for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
    const tests::ShaftError error = rig.error(rig.picture(technique));
    CAPTURE(static_cast<int>(technique), error.rRmse, error.displaced);
    CHECK(error.rRmse <= error.displaced + (technique == Technique::Tree ? 0 : rig.scene.frame.settings.bendThreshold));
  }
}

reference::Image flipped(const reference::Image& image, bool x, bool y) {
  reference::Image result(image.width, image.height);
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i)
      result.set(i, j, image.at(x ? image.width - 1 - i : i, y ? image.height - 1 - j : j));
  return result;
}

// Mirrors clip space, and the depth image with it: every slice has its mirror image, counted the other way around the
// border unless both axes are mirrored.
void mirrorPicture(tests::SceneRig& scene, bool x, bool y) {
  const glm::dmat4 mirror = glm::scale(glm::dmat4(1), glm::dvec3(x ? -1 : 1, y ? -1 : 1, 1));
  const int width = scene.frame.viewport.width, height = scene.frame.viewport.height;
  const std::vector<float> depth = scene.depth();
  std::vector<float> result;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      result.push_back(depth[static_cast<std::size_t>((y ? height - 1 - j : j) * width + (x ? width - 1 - i : i))]);
  scene.frame.camera.clipFromView = tests::toMat4(mirror * reference::toMat4(scene.frame.camera.clipFromView));
  scene.setDepth(result);
}

} // namespace

// Where a sample lies on a border the mirrored one may fall to the other side: by a tenth of the error that is allowed.
TEST_CASE("epipolar gives the mirrored picture of a mirrored camera") {
  for (const LightKind kind : kKinds)
    for (const glm::bvec2& axes : {glm::bvec2(true, false), glm::bvec2(false, true), glm::bvec2(true, true)}) {
      CAPTURE(static_cast<int>(kind), axes.x, axes.y);
      tests::ShaftRig rig;
      rig.addLight(highLight(kind));
      const reference::Image expected = rig.picture(Technique::Epipolar);
      const tests::ShaftError error = rig.error(expected);
      mirrorPicture(rig.scene, axes.x, axes.y);
      const reference::Image mirrored = flipped(rig.picture(Technique::Epipolar), axes.x, axes.y);
      const double difference = tests::errorWhere(mirrored, expected, [](int, int) { return true; });
      CAPTURE(error.rRmse, difference);
      CHECK(difference <= 0.1 * (error.displaced + rig.scene.frame.settings.bendThreshold));
    }
}

TEST_CASE("epipolar gives the same picture by every depth convention of camera and shadow map") {
  for (const LightKind kind : kKinds) {
    tests::ShaftRig rig;
    rig.addLight(highLight(kind));
    tests::DepthConvention convention = rig.scene.convention();
    convention.infinite = false;
    convention.far = 400;
    rig.setConvention(convention);
    const reference::Image expected = rig.picture(Technique::Epipolar);
    for (const bool reversed : {false, true})
      for (const ClipDepth clipDepth : {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne}) {
        CAPTURE(static_cast<int>(kind), reversed, static_cast<int>(clipDepth));
        convention.reversed = reversed;
        convention.clipDepth = clipDepth;
        rig.setConvention(convention);
        const reference::Image image = rig.picture(Technique::Epipolar);
        const double difference = tests::errorWhere(image, expected, [](int, int) { return true; });
        CHECK(difference <= 5e-6); // standard depth holds distances to 1e-4 and less
      }
  }
}

TEST_CASE("epipolar gives the same picture with a reversed shadow map") {
  for (const LightKind kind : kKinds) {
    CAPTURE(static_cast<int>(kind));
    tests::ShaftRig rig;
    Light& light = rig.addLight(highLight(kind));
    const reference::Image expected = rig.picture(Technique::Epipolar);
    const glm::dmat4 reverse = glm::scale(glm::dmat4(1), glm::dvec3(1, 1, -1));
    for (ShadowView& view : light.shadow.views)
      view.clipFromWorld = tests::toMat4(reverse * reference::toMat4(view.clipFromWorld));
    reference::ShadowImage image = rig.scene.shadow(0);
    for (float& depth : image.depth)
      depth = 1 - depth;
    rig.scene.setShadow(0, image);
    const double difference =
        tests::errorWhere(rig.picture(Technique::Epipolar), expected, [](int, int) { return true; });
    CHECK(difference <= 5e-6);
  }
}

// Each ray is a point in the map, or nearly so: slices follow no ray there, but the picture.
TEST_CASE("epipolar comes close to exact where a sun shines along or against an orthographic view") {
  for (const double aslant : {0.0, 1e-17, 1e-12, 1e-8, 1e-5, 1e-3})
    for (const double along : {-1, 1}) {
      CAPTURE(aslant, along);
      tests::ShaftRig rig;
      rig.look(tests::lookAt({0, 3, 0}, {0, 3, -1}));
      tests::DepthConvention convention = rig.scene.convention();
      convention.infinite = false;
      convention.orthographic = true;
      rig.setConvention(convention);
      Light light = tests::shaftLight(LightKind::Directional);
      light.direction = {aslant, 0.3 * aslant, along};
      rig.addLight(light);
      checkBothTechniques(rig);
    }
}

TEST_CASE("epipolar comes close to exact through an orthographic camera, standard or reversed", "[sweep]") {
  for (const bool reversed : {false, true})
    for (const LightKind kind : kKinds)
      for (const Vec3& direction : kDirections) {
        if (kind == LightKind::Point && &direction != &kDirections[0]) continue; // it has none
        CAPTURE(reversed, static_cast<int>(kind), direction[0], direction[1], direction[2]);
        tests::ShaftRig rig;
        rig.look(tests::lookAt({0, 3, 0}, {0, 3, -1})); // all of the picture above the floor
        tests::DepthConvention convention = rig.scene.convention();
        convention.infinite = false;
        convention.orthographic = true;
        convention.reversed = reversed;
        rig.setConvention(convention);
        Light light = tests::shaftLight(kind);
        light.direction = direction;
        rig.addLight(light);
        checkBothTechniques(rig);
      }
}

TEST_CASE("epipolar gives the same picture of a scene in another unit") {
  for (const LightKind kind : kKinds) {
    tests::ShaftRig rig;
    rig.addLight(highLight(kind));
    const Frame frame = rig.scene.frame;
    for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
      rig.scene.frame = frame;
      const reference::Image expected = rig.picture(technique);
      for (const double scale : {1e-3, 1e3}) {
        CAPTURE(static_cast<int>(kind), static_cast<int>(technique), scale);
        rig.scene.frame = frame;
        tests::transformWorld(rig.scene.frame, scale, glm::dvec3(0));
        const double difference = tests::errorWhere(rig.picture(technique), expected, [](int, int) { return true; });
        CHECK(difference <= 5e-6);
      }
    }
  }
}
