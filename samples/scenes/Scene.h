// What a generator makes: triangles by material, bodies that move, one camera, lights and the air. Metres, y up,
// right-handed.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace scenes {

struct Material {
  std::string name;
  glm::dvec3 colour{0.5}; ///< linear base colour
  glm::dvec3 emission{0}; ///< radiance, 0..1
  bool glass = false;     ///< KHR_materials_transmission, tints light by its colour
  bool doubleSided = false;
};

/// The triangles of one material.
struct Surface {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  std::vector<glm::dvec3> colours; ///< times the material's, 0 to 1; none, or one a vertex
  std::vector<std::uint32_t> indices;
};

/// Where a body is at a time: worldFromBody.
struct Pose {
  double seconds = 0;
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
};

/// What moves as a whole. Between its poses it goes straight and turns evenly, by less than half a turn; a last pose
/// equal to the first makes it loop.
struct Body {
  std::string name;
  std::vector<Surface> surfaces; ///< one a material of the scene, in the body's own coordinates
  std::vector<Pose> poses;       ///< one or more, in order of time
};

/// A source of smoke, as extras.tyndall.smoke of a node (scene/Scene.h of the host explains the fields).
struct Smoke {
  std::string name;
  glm::dvec3 position{0};
  int particles = 200;
  double radius = 0.2; ///< metres
  double growth = 3;
  double density = 1; ///< 1/metre
  double spread = 0.1;
  double height = 2;
  double rise = 0.5; ///< metres a second
  glm::dvec3 drift{0};
  double turbulence = 0.3;
  glm::dvec3 albedo{0.9};
  int seed = 0;
};

/// A bank of fog, as extras.tyndall.fog of a node (scene/Scene.h of the host explains the fields).
struct Fog {
  std::string name;
  glm::dvec3 position{0}, halfSize{1}; ///< metres
  bool sphere = false;
  double extinction = 0.1; ///< 1/metre
  double fade = 0.5;
  glm::ivec3 billows{0};
  double clear = 0.3;
  int seed = 0;
};

/// Lines of one material that are hair, ropes and the like.
struct Strands {
  std::string name;
  int material = 0;
  double width = 0.001; ///< metres
  double opacity = 0.6;
  std::vector<glm::dvec3> points;
  std::vector<std::uint32_t> indices; ///< two a segment
};

struct Camera {
  glm::dvec3 eye{0, 1.7, 5};
  glm::dvec3 target{0, 1.7, 0};
  double verticalFov = 60; ///< degrees
  double nearPlane = 0.1;
  double farPlane = 200;
};

enum class LightKind { Directional, Point, Spot };

struct Light {
  LightKind kind = LightKind::Directional;
  std::string name = "sun";
  glm::dvec3 colour{1};           ///< 0..1, multiplied by the intensity
  double intensity = 1;           ///< directional: irradiance; point, spot: radiant intensity
  glm::dvec3 position{0};         ///< point, spot
  glm::dvec3 direction{0, -1, 0}; ///< where the light travels to
  double innerConeAngle = 20;     ///< degrees, half angle
  double outerConeAngle = 25;     ///< degrees, half angle
  int body = -1;                  ///< that carries it: position and direction are in its coordinates; -1: none
};

struct Constituent {
  std::string phase;        ///< as in extras.tyndall.medium
  glm::dvec3 scattering{0}; ///< 1/metre
  double g = 0;             ///< written for the phases that have one
  int layer = -1;           ///< of the scene's; -1: none
};

/// Of the medium, as extras.tyndall.medium has it: thinner by 1/e each `scale`, from 1 at `height`; even below
/// `ground`.
struct Layer {
  double height = 0, scale = 1, ground = 0; ///< metres
};

struct Scene {
  std::string name;
  std::vector<Material> materials;
  std::vector<Surface> surfaces; ///< one a material, of what stands still
  std::vector<Body> bodies;
  std::vector<Smoke> smoke;
  std::vector<Fog> fog;
  bool isSmokeLit = false;    ///< as fog is, by the effect
  glm::dvec3 fogAlbedo{0.95}; ///< what fog scatters of the light that it takes, by Henyey and Greenstein's phase
  double fogG = 0.6;          ///< function with this asymmetry
  std::vector<Strands> strands;
  Camera camera;
  std::vector<Light> lights;
  std::vector<Constituent> constituents;
  glm::dvec3 absorption{0}; ///< 1/metre
  std::vector<Layer> layers;
  double farDistance = 0; ///< metres; 0: none
  glm::dvec3 ambient{0};  ///< radiance of the surroundings, which the medium scatters
  glm::dvec3 sky{0};      ///< radiance of the sky and of ambient light
  /// Positions are rounded to this step, so that the last bits of sin and cos do not reach the file and points
  /// that are meant to coincide do.
  double grid = 1.0 / 16384;

  int add(Material material) {
    materials.push_back(std::move(material));
    surfaces.emplace_back();
    return static_cast<int>(materials.size()) - 1;
  }
};

Scene makeNave(bool glazed);
Scene makeForest();
Scene makeTerrain();
Scene makeCage();
/// Four spot lights, or the twelve of a concert.
Scene makeStage(bool concert);
/// The stage with lamps that turn: their beams sweep.
Scene makeSweep();
Scene makeProjector();
Scene makeOrrery();

Scene makePendulum();
/// Three columns of smoke that shadow one another and the wall behind them.
Scene makeSmoke();
/// A head of hair in a breath of smoke.
Scene makeHair();
/// The glazed nave with a smoking censer.
Scene makeCenser();
/// A low sun behind the ridges around a valley with its morning fog.
Scene makeValley();
/// A harbour at dusk: banks of fog between its lamps.
Scene makeHarbour();
/// The model of a glTF file, turning once in 12.5 s. Throws host::Error or std::runtime_error.
Scene makeTurntable(const std::string& path);

} // namespace scenes
