// A head of hair before the light: tens of thousands of strands in tufts, and a breath of smoke.
#include "MeshBuilder.h"
#include "Random.h"
#include "Scene.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes {
namespace {

const glm::dvec3 kHead{0, 1.62, 0};
constexpr double kSkull = 0.105; ///< radius, metres
constexpr int kTufts = 900;
constexpr int kPerTuft = 32;
constexpr int kSteps = 22; ///< segments of a strand

/// The i-th of n places that lie evenly on the sphere: Fibonacci's lattice.
glm::dvec3 evenDirection(int i, int n) {
  const double y = 1 - 2 * (i + 0.5) / n;
  const double angle = i * glm::pi<double>() * (3 - std::sqrt(5.0));
  const double around = std::sqrt(1 - y * y);
  return {around * std::sin(angle), y, around * std::cos(angle)};
}

/// Where hair grows: not on the face, which looks along +z, nor under the chin.
bool isScalp(const glm::dvec3& out) { return out.y > -0.55 + 0.9 * std::max(0.0, out.z) && out.z < 0.72; }

glm::dvec3 skullAt(const glm::dvec3& out) { return kHead + kSkull * out * glm::dvec3(0.9, 1.16, 1.04); }

struct Tuft {
  glm::dvec3 out{0};
  double length = 0;
  double wave = 0; ///< phase
  double curl = 0; ///< radius of the wave
};

/// A strand leaves the scalp flat, combed away from the crown with a whirl, bends down under its weight and waves with
/// its tuft.
void grow(Strands& strands, const Tuft& tuft, const glm::dvec3& out, double length, double wave, Random& random) {
  const double step = length / kSteps;
  glm::dvec3 at = skullAt(out);
  const glm::dvec3 crown = glm::normalize(glm::dvec3(0, 1, -0.45));
  const glm::dvec3 away = glm::normalize(out - crown * (glm::dot(out, crown) - 1e-6));
  glm::dvec3 heading = glm::normalize(away + 0.4 * glm::cross(crown, away) + 0.3 * out);
  const glm::dvec3 side = glm::normalize(glm::cross(heading, glm::dvec3(0.3, 1, 0.2)));
  const double stiffness = random.between(0.17, 0.27);
  strands.points.push_back(at - 0.004 * out);
  for (int i = 1; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    heading = glm::normalize(heading + stiffness * glm::dvec3(0, -1, 0));
    at += step * heading;
    const glm::dvec3 fromHead = (at - kHead) / glm::dvec3(0.9, 1.16, 1.04);
    const double clear = kSkull * (1.02 + 0.10 * share);
    if (glm::length(fromHead) < clear) {
      at = kHead + clear * glm::normalize(fromHead) * glm::dvec3(0.9, 1.16, 1.04);
    }
    const double turn = 11 * share + wave;
    const glm::dvec3 waved =
        at + tuft.curl * share * (std::sin(turn) * side + std::cos(turn) * glm::cross(side, heading));
    const auto index = static_cast<std::uint32_t>(strands.points.size());
    strands.points.push_back(waved);
    strands.indices.push_back(index - 1);
    strands.indices.push_back(index);
  }
}

Strands hair(int material) {
  Strands strands;
  strands.name = "hair";
  strands.material = material;
  strands.width = 0.00035;
  strands.opacity = 0.75;
  Random random(4711);
  for (int i = 0; i < kTufts; ++i) {
    Tuft tuft;
    tuft.out = evenDirection(i, kTufts);
    const double longer = random.unit();
    tuft.length = 0.20 + 0.10 * longer;
    tuft.wave = glm::two_pi<double>() * random.unit();
    tuft.curl = random.between(0.004, 0.011);
    if (!isScalp(tuft.out)) continue;
    for (int k = 0; k < kPerTuft; ++k) {
      const double dx = random.between(-1, 1), dy = random.between(-1, 1), dz = random.between(-1, 1);
      const glm::dvec3 out = glm::normalize(tuft.out + 0.085 * glm::dvec3(dx, dy, dz));
      const double length = tuft.length * random.between(0.85, 1.08);
      grow(strands, tuft, out, length, tuft.wave + random.between(-0.5, 0.5), random);
    }
  }
  return strands;
}

void head(MeshBuilder& mesh, int skin, int cloth) {
  mesh.material(skin);
  mesh.frame(glm::scale(glm::translate(glm::dmat4(1), kHead), {0.9, 1.16, 1.04}));
  mesh.sphere({0, 0, 0}, kSkull, 96);
  mesh.frame(glm::dmat4(1));
  mesh.lathe({{0.062, 1.28}, {0.050, 1.40}, {0.052, 1.48}, {0.060, 1.56}}, 48);
  mesh.material(cloth);
  mesh.frame(glm::scale(glm::translate(glm::dmat4(1), {0, 1.17, -0.01}), {1.0, 0.50, 0.50}));
  mesh.sphere({0, 0, 0}, 0.33, 96);
  mesh.frame(glm::dmat4(1)).torus({0, 1.335, 0}, 0.062, 0.012, 64, 16);
}

void booth(MeshBuilder& mesh, int paper) {
  mesh.frame(glm::dmat4(1)).material(paper);
  mesh.quad({3, 0.2, 0.9}, {-3, 0.2, 0.9}, {-3, 3.4, 0.9}, {3, 3.4, 0.9});
}

Smoke breath() {
  Smoke smoke;
  smoke.name = "breath";
  smoke.position = {0.40, 1.20, 0.10};
  smoke.particles = 420;
  smoke.radius = 0.013;
  smoke.growth = 4;
  smoke.density = 9;
  smoke.spread = 0.012;
  smoke.height = 0.85;
  smoke.rise = 0.14;
  smoke.drift = {-0.030, 0, 0.004};
  smoke.turbulence = 0.20;
  smoke.albedo = {0.88, 0.90, 0.94};
  smoke.seed = 5;
  return smoke;
}

} // namespace

Scene makeHair() {
  Scene scene;
  scene.grid = 1.0 / 1048576;
  scene.camera = {{0.54, 1.75, -0.95}, {0.04, 1.55, 0}, 31, 0.02, 20};
  Light key;
  key.kind = LightKind::Spot;
  key.name = "key";
  key.colour = {1.0, 0.90, 0.76};
  key.intensity = 5;
  key.position = {1.55, 2.15, 0.25};
  key.direction = kHead - key.position - glm::dvec3(0, 0.06, 0);
  key.innerConeAngle = 16;
  key.outerConeAngle = 24;
  Light rim = key;
  rim.name = "rim";
  rim.colour = {0.62, 0.78, 1.0};
  rim.intensity = 4.5;
  rim.position = {-1.25, 1.95, 0.15};
  rim.direction = kHead - rim.position;
  scene.lights = {key, rim};
  scene.constituents = {{"henyey-greenstein", glm::dvec3(0.014), 0.4}};
  scene.absorption = glm::dvec3(0.002);
  scene.sky = {0.42, 0.43, 0.46};

  const int skin = scene.add({"skin", {0.62, 0.42, 0.32}});
  const int cloth = scene.add({"cloth", {0.10, 0.12, 0.16}});
  const int paper = scene.add({"paper", {0.26, 0.27, 0.29}});
  const int strand = scene.add({"hair", {0.12, 0.058, 0.022}});
  MeshBuilder mesh(scene);
  head(mesh, skin, cloth);
  booth(mesh, paper);
  scene.strands.push_back(hair(strand));
  scene.smoke.push_back(breath());
  return scene;
}

} // namespace scenes
