#include "TestScenes.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <reference/CameraRays.h>
#include <reference/LightSlice.h>
#include <reference/MapExact.h>
#include <reference/Metrics.h>
#include <reference/Optics.h>
#include <reference/SceneExact.h>

using namespace reference;
using namespace tests;

namespace {

tyndall::Medium mist() {
  tyndall::Medium medium;
  medium.constituents = {{{0.05F, 0.08F, 0.12F}, tyndall::Phase::HenyeyGreenstein, 0.3F}};
  medium.absorption = {0.01F, 0.01F, 0.02F};
  return medium;
}

SceneView viewFrom(const glm::dvec3& eye, const glm::dvec3& target, int width, int height) {
  SceneView view;
  view.camera.viewFromWorld = toTyndall(glm::lookAt(eye, target, glm::dvec3(0, 1, 0)));
  view.camera.clipFromView = toTyndall(glm::infinitePerspective(0.9, static_cast<double>(width) / height, 0.05));
  view.medium = mist();
  view.width = width;
  view.height = height;
  return view;
}

tyndall::Light sunAlong(const glm::dvec3& direction) {
  tyndall::Light sun;
  sun.direction = {direction.x, direction.y, direction.z};
  sun.colour = {3, 2, 1};
  return sun;
}

tyndall::Light pointAt(const glm::dvec3& p) {
  tyndall::Light light;
  light.kind = tyndall::LightKind::Point;
  light.position = {p.x, p.y, p.z};
  return light;
}

/// A parallelogram of two triangles that share a diagonal.
void addQuad(std::vector<Triangle>& out, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
             bool glass = false, const Rgb& tint = Rgb(0)) {
  out.push_back({corner, corner + u, corner + u + v, glass, tint});
  out.push_back({corner, corner + u + v, corner + v, glass, tint});
}

void addBox(std::vector<Triangle>& out, const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
  addQuad(out, low, x, y);
  addQuad(out, low, y, z);
  addQuad(out, low, z, x);
  addQuad(out, low + z, x, y);
  addQuad(out, low + x, y, z);
  addQuad(out, low + y, z, x);
}

std::vector<Triangle> manyBoxes(int count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Triangle> triangles;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 centre = 5.0 * glm::dvec3(uniform(random), uniform(random), uniform(random));
    const glm::dvec3 half = size * (glm::dvec3(1.2) + glm::dvec3(uniform(random), uniform(random), uniform(random)));
    addBox(triangles, centre - half, centre + half);
  }
  return triangles;
}

Rgb tintAt(const std::vector<LitSpan>& spans, double s) {
  for (const LitSpan& span : spans)
    if (s >= span.begin && s < span.end) return span.tint;
  return Rgb(0);
}

/// The share of points along [0, end] where litSpans and Embree's shadow rays disagree.
double disagreement(const SceneExact& scene, const tyndall::Light& light, const Ray& ray, double end, int points) {
  const std::vector<LitSpan> spans = scene.litSpans(ray, light, 0, end);
  int wrong = 0;
  for (int i = 0; i < points; ++i) {
    const double s = end * (i + 0.5) / points;
    if (glm::length(tintAt(spans, s) - scene.visibilityAt(ray.at(s), light)) > 1e-6) ++wrong;
  }
  return static_cast<double>(wrong) / points;
}

} // namespace

TEST_CASE("scene-exact: an empty scene is the closed form", "[reference][scene]") {
  SceneView view = viewFrom({1, 2, 3}, {0, 0, -5}, 8, 6);
  view.lights = {sunAlong({0.2, -1, 0.3}), pointAt({0.5, 0.4, -4})};
  const SceneExact scene({});
  const ImageAnswer answer = scene.render(view);
  const Ray ray = CameraRays(view.camera, 8, 6).ray(2, 4);
  const Rgb expected = integrate(view.medium, view.lights[0], ray, 0, kInfinity) +
                       integrate(view.medium, view.lights[1], ray, 0, kInfinity);
  CHECK(glm::length(answer.inscatter.at(2, 4) - expected) < 1e-12);
  CHECK(answer.transmittance.at(2, 4) == Rgb(0));
  CHECK(scene.render(view, {{2, 4}})[0].inscatter == answer.inscatter.at(2, 4));
}

TEST_CASE("scene-exact: one quad casts a slab of shadow in the sun", "[reference][scene]") {
  std::vector<Triangle> triangles;
  addQuad(triangles, {-1, 5, -20}, {2, 0, 0}, {0, 0, 40});
  addQuad(triangles, {-50, -3, -50}, {100, 0, 0}, {0, 0, 100});
  const SceneExact scene(triangles);
  const tyndall::Light sun = sunAlong({1, -2, 0}); // the slab at height y: |x - (5 - y) / 2| < 1
  const Ray ray{{-8, 1, 2}, glm::normalize(glm::dvec3(8, -1, 0.5))};
  const double end = scene.firstHit(ray);
  CHECK(end == Approx(4 * glm::length(glm::dvec3(8, -1, 0.5))).epsilon(1e-12));
  // x - (5 - y) / 2 along the ray is -10 + (8 - 0.5) q, with q the ray in units of its unnormalised direction.
  const double unit = glm::length(glm::dvec3(8, -1, 0.5));
  const double dark0 = (10 - 1) / 7.5 * unit, dark1 = (10 + 1) / 7.5 * unit;
  const std::vector<LitSpan> spans = scene.litSpans(ray, sun, 0, end);
  REQUIRE(spans.size() == 2);
  CHECK(spans[0].begin == 0);
  CHECK(spans[0].end == Approx(dark0).epsilon(1e-12));
  CHECK(spans[1].begin == Approx(dark1).epsilon(1e-12));
  CHECK(spans[1].end == end);
  // Above the quad all is lit: only what lies between light and ray shades.
  const std::vector<LitSpan> above = scene.litSpans({{-8, 6, 0}, {1, 0, 0}}, sun, 0, 30);
  REQUIRE(above.size() == 1);
  CHECK(above[0].end == 30);
  // Endless rays keep their shadows: level at height 1 the slab is 1 < x < 3.
  const std::vector<LitSpan> sky = scene.litSpans({{0, 1, 0}, {1, 0, 0}}, sun, 0, 1e6);
  REQUIRE(sky.size() == 2);
  CHECK(sky[0].end == Approx(1).epsilon(1e-12));
  CHECK(sky[1].begin == Approx(3).epsilon(1e-12));
  CHECK(sky[1].end == 1e6);
}

TEST_CASE("scene-exact: a quad before a point light shades to the horizon", "[reference][scene]") {
  std::vector<Triangle> triangles;
  addQuad(triangles, {-1, 2, -5}, {2, 0, 0}, {0, 0, 10}); // |x| < 1 at height 2, light at height 4: |x| < 2 at height 0
  const SceneExact scene(triangles);
  const tyndall::Light light = pointAt({0, 4, 0});
  const std::vector<LitSpan> spans = scene.litSpans({{-9, 0, 0}, {1, 0, 0}}, light, 0, 100);
  REQUIRE(spans.size() == 2);
  CHECK(spans[0].end == Approx(7).epsilon(1e-12));
  CHECK(spans[1].begin == Approx(11).epsilon(1e-12));

  std::vector<Triangle> wall; // upright at x = 1, from the ground to above the light: dark from x = 1 on
  addQuad(wall, {1, -1, -5}, {0, 9, 0}, {0, 0, 10});
  const std::vector<LitSpan> open = SceneExact(wall).litSpans({{-9, 0, 0}, {1, 0, 0}}, light, 0, 1e6);
  REQUIRE(open.size() == 1);
  CHECK(open[0].end == Approx(10).epsilon(1e-12));
}

TEST_CASE("scene-exact: shadow intervals agree with Embree's shadow rays", "[reference][scene]") {
  std::vector<Triangle> box;
  addBox(box, {-0.5, 0.5, -0.5}, {0.5, 1.5, 0.5});
  const SceneExact one(box);
  CHECK(disagreement(one, pointAt({0.2, 1.3, -2}), {{0.1, 1.2, 6}, {0, 0, -1}}, 5.5, 100000) < 2e-5);
  CHECK(disagreement(one, pointAt({0.2, 1.3, -2}), {{3, 1, 6}, glm::normalize(glm::dvec3(-0.2, 0, -1))}, 30, 100000) <
        2e-5);

  const SceneExact many(manyBoxes(400, 0.15, 3));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 24; ++i) {
    CAPTURE(i);
    const glm::dvec3 eye = 8.0 * glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
    const glm::dvec3 target = 3.0 * glm::dvec3(uniform(random), uniform(random), uniform(random));
    const Ray ray{eye, glm::normalize(target - eye)};
    const double end = std::min(16.0, many.firstHit(ray));
    const glm::dvec3 p = 6.0 * glm::dvec3(uniform(random), uniform(random), uniform(random));
    CHECK(disagreement(many, pointAt(p), ray, end, 20000) < 3e-4);
    CHECK(disagreement(many, sunAlong(p), ray, end, 20000) < 3e-4);
  }
}

TEST_CASE("scene-exact: looking into the light and along it", "[reference][scene]") {
  std::vector<Triangle> triangles;
  addQuad(triangles, {-1, -1, -10}, {2, 0, 0}, {0, 2, 0});
  const SceneExact scene(triangles);
  const Ray ray{{0.1, 0.2, 0}, {0, 0, -1}};
  const auto lit = [&](const tyndall::Light& light, double s0, double s1) {
    double sum = 0;
    for (const LitSpan& span : scene.litSpans(ray, light, s0, s1))
      sum += span.end - span.begin;
    return sum;
  };
  CHECK(lit(sunAlong({0, 0, 1}), 0, 9) == Approx(0).margin(1e-6));    // the sun behind the quad
  CHECK(lit(sunAlong({0, 0, 1}), 11, 20) == Approx(9).epsilon(1e-6)); // beyond it
  CHECK(lit(sunAlong({0, 0, -1}), 0, 9) == Approx(9).epsilon(1e-6));  // the sun in the back
  CHECK(lit(sunAlong({0, 0, -1}), 11, 20) == Approx(0).margin(1e-6));
  CHECK(lit(pointAt({0.1, 0.2, -12}), 0, 9) == Approx(0).margin(1e-5));
  CHECK(lit(pointAt({0.1, 0.2, -12}), 10.5, 15) == Approx(4.5).epsilon(1e-5));
  CHECK(lit(pointAt({0.1, 0.2, -5}), 0, 20) == Approx(10).epsilon(1e-5));
}

TEST_CASE("scene-exact: glass multiplies, and panes that share an edge count once", "[reference][scene]") {
  std::vector<Triangle> triangles;
  // Two panes one above the other over x in [0, 4], the lower one continued to x = 8 by a neighbour of its own colour.
  addQuad(triangles, {0, 5, -5}, {4, 0, 0}, {0, 0, 10}, true, {0.5, 0.25, 1});
  addQuad(triangles, {0, 4, -5}, {4, 0, 0}, {0, 0, 10}, true, {0.5, 1, 0.125});
  addQuad(triangles, {4, 4, -5}, {4, 0, 0}, {0, 0, 10}, true, {0.75, 0.75, 0.75});
  const SceneExact scene(triangles);
  const tyndall::Light sun = sunAlong({0, -1, 0});
  const Ray ray{{-2, 0, 0.3}, {1, 0, 0}};
  const std::vector<LitSpan> spans = scene.litSpans(ray, sun, 0, 20);
  const Rgb expected[] = {Rgb(1), {0.25, 0.25, 0.125}, Rgb(0.75), Rgb(1)};
  const double ends[] = {2, 6, 10, 20};
  for (int i = 0; i < 4; ++i) {
    CAPTURE(i);
    CHECK(tintAt(spans, ends[i] - 1) == expected[i]);
    CHECK(tintAt(spans, ends[i] - 1e-9) == expected[i]);
  }
  double covered = 0;
  for (const LitSpan& span : spans) {
    // Neither gap nor overlap anywhere, the panes' diagonals included.
    CHECK(span.begin == Approx(covered).margin(1e-12));
    CHECK(std::find(std::begin(expected), std::end(expected), span.tint) != std::end(expected));
    covered = span.end;
  }
  CHECK(covered == 20);
  CHECK(glm::length(scene.visibilityAt({1, 0, 0.3}, sun) - expected[1]) < 1e-12);
  CHECK(tintAt(scene.litSpans({{-2, 4.5, 0.3}, {1, 0, 0}}, sun, 0, 20), 4) == Rgb(0.5, 0.25, 1));
  // Glass hides nothing from the camera.
  CHECK(std::isinf(scene.firstHit({{1, 10, 0}, {0, -1, 0}})));
}

TEST_CASE("scene-exact: a closed mesh leaks no light at its edges", "[reference][scene]") {
  std::vector<Triangle> triangles; // a sheet of 60 x 60 cells, heights at random, all vertices shared
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<glm::dvec3> v;
  for (int i = 0; i <= 60 * 61 + 60; ++i)
    v.emplace_back(0.1 * (i % 61), 2 + uniform(random), 0.1 * static_cast<int>(i / 61));
  for (std::size_t z = 0; z < 60; ++z)
    for (std::size_t x = 0; x < 60; ++x) {
      const std::size_t i = z * 61 + x;
      triangles.push_back({v[i], v[i + 1], v[i + 62], false, Rgb(0)});
      triangles.push_back({v[i], v[i + 62], v[i + 61], false, Rgb(0)});
    }
  const SceneExact scene(triangles);
  for (int i = 0; i < 200; ++i) {
    const Ray ray{{0.5, 1, 0.4}, glm::normalize(glm::dvec3(1, 0.1 * uniform(random), 0.02 + uniform(random)))};
    CAPTURE(i);
    CHECK(scene.litSpans(ray, sunAlong({0.1, -1, 0.05}), 0, 4).empty());
    CHECK(scene.litSpans(ray, pointAt({3, 9, 3}), 0, 4).empty());
  }
}

TEST_CASE("scene-exact and map-exact agree on a map of analytic depth", "[reference][scene][map]") {
  // A level quad under the sun: its depth map is known without rasterising, its edges lie on texel borders.
  std::vector<Triangle> triangles;
  addQuad(triangles, {-1, 4, -2}, {3, 0, 0}, {0, 0, 5});
  SceneView view = viewFrom({0.3, 1.2, 9}, {0.1, 1, 0}, 32, 24);
  view.lights = {sunAlong({0, -1, 0})};
  MapScene map;
  map.camera = view.camera;
  map.lights = view.lights;
  map.medium = view.medium;
  map.width = view.width;
  map.height = view.height;
  map.depth.assign(32 * 24, 1.0F);
  const glm::dmat4 look = glm::lookAt(glm::dvec3(0, 8, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
  map.lights[0].shadow.views = {{toTyndall(glm::ortho(-8.0, 8.0, -8.0, 8.0, 0.0, 16.0) * look), 0}};
  ShadowImage image;
  image.width = image.height = 16;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const double worldX = x - 7.5, worldZ = 7.5 - y;
      image.depth.push_back(worldX > -1 && worldX < 2 && worldZ > -2 && worldZ < 3 ? 0.25F : 1.0F);
    }
  map.shadows = {image};
  // The quad itself ends some rays: give the map the same ends.
  const SceneExact scene(triangles);
  const CameraRays rays(view.camera, 32, 24);
  Image fromMap = mapExact(map).inscatter, fromScene = scene.render(view).inscatter;
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x)
      if (std::isfinite(scene.firstHit(rays.ray(x, y)))) {
        fromMap.set(x, y, Rgb(0));
        fromScene.set(x, y, Rgb(0));
      }
  const ErrorMetrics error = compare(fromMap, fromScene);
  INFO(error.text());
  CHECK(error.mean > 0);
  CHECK(error.max < 1e-9);
}

TEST_CASE("triangles of a host scene: glass, masks, blends, unlit ones and poses", "[reference][scene]") {
  host::Scene source;
  source.materials.resize(6);
  source.materials[1].transmission = 0.5F;
  source.materials[1].baseColour = {0.5F, 1, 0.25F, 1};
  source.materials[2].alphaMode = host::AlphaMode::Mask;
  source.materials[2].baseColour.a = 0.4F;
  source.materials[3].alphaMode = host::AlphaMode::Blend;
  source.materials[3].baseColour.a = 0.6F;
  source.materials[4].alphaMode = host::AlphaMode::Blend;
  source.materials[4].baseColour.a = 0.25F;
  source.materials[4].transmission = 0.5F;
  source.materials[5].unlit = true;
  host::Mesh mesh;
  for (int material = 0; material < 6; ++material) {
    host::Primitive primitive;
    primitive.vertices.resize(3);
    primitive.vertices[1].position = {1, 0, 0};
    primitive.vertices[2].position = {0, 1, static_cast<float>(material)};
    primitive.indices = {0, 1, 2};
    primitive.material = material;
    mesh.primitives.push_back(primitive);
  }
  mesh.primitives.push_back(mesh.primitives[0]);
  mesh.primitives.back().topology = host::Topology::Lines;
  source.meshes = {mesh};
  source.nodes.resize(2);
  source.nodes[1].mesh = 0;
  const std::vector<Triangle> triangles =
      trianglesOf(source, {glm::dmat4(1), glm::translate(glm::dmat4(1), glm::dvec3(0, 10, 0))});
  REQUIRE(triangles.size() == 4);
  CHECK(!triangles[0].glass);
  CHECK(triangles[0].b == glm::dvec3(1, 10, 0));
  CHECK(triangles[1].glass);
  CHECK(triangles[1].tint == Rgb(0.25, 0.5, 0.125));
  CHECK(triangles[2].c == glm::dvec3(0, 11, 3));
  CHECK(triangles[2].glass);
  CHECK(triangles[2].tint.g == Approx(0.4));
  CHECK(triangles[3].glass);
  CHECK(triangles[3].tint.g == Approx(0.75 + 0.25 * 0.5));
}
