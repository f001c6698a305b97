// The host's picture of a glTF 2.0 scene: plain data, no GL. Right-handed, y up, as in glTF.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace host {

struct Vertex {
  glm::vec3 position{0};
  glm::vec3 normal{0, 1, 0};
  glm::vec2 uv{0};
  glm::u16vec4 colour{65535}; ///< times the material's base colour, linear, 65535 is 1; alpha is not used
};

enum class Topology { Points, Lines, Triangles };

/// What lines look like: each is a strand of hair, thread and the like.
struct Strand {
  double width = 0;   ///< world units, > 0
  double opacity = 1; ///< share of the light that a strand stops where it covers a place, 0 to 1
};

/// Indexed geometry of one material. Strips, fans and loops are unrolled by the loader; indices are in range.
struct Primitive {
  Topology topology = Topology::Triangles;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  int material = 0; ///< index into Scene::materials, always valid
  Strand strand;    ///< of lines
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

enum class Wrap { Repeat, MirroredRepeat, ClampToEdge };

/// A base-colour texture: sRGB bytes RGBA, row 0 is v = 0 as in glTF (the top row).
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
  Wrap wrapU = Wrap::Repeat;
  Wrap wrapV = Wrap::Repeat;
};

enum class AlphaMode { Opaque, Mask, Blend };

struct Material {
  std::string name;
  glm::vec4 baseColour{1}; ///< linear factor, alpha in w
  int texture = -1;        ///< index into Scene::textures, or -1
  AlphaMode alphaMode = AlphaMode::Opaque;
  float alphaCutoff = 0.5F;
  float transmission = 0;                           ///< KHR_materials_transmission's factor
  glm::vec3 emission{0};                            ///< linear radiance
  bool unlit = false;                               ///< KHR_materials_unlit: radiates baseColour, casts no shadow
  bool isGlass() const { return transmission > 0; } ///< casts no shadow, tints the light by baseColour * transmission
};

struct Camera {
  std::string name;
  bool orthographic = false;
  double verticalFov = 0.8; ///< radians, perspective
  double halfHeight = 1;    ///< world units, orthographic
  double nearPlane = 0.1;
  double farPlane = 0; ///< 0: infinite (perspective)
};

struct Light {
  std::string name;
  tyndall::LightKind kind = tyndall::LightKind::Directional;
  glm::vec3 colour{1}; ///< colour x intensity: irradiance or radiant intensity
  double range = tyndall::kInfinity;
  double innerConeAngle = 0;
  double outerConeAngle = 0.7853981633974483;
};

struct Node {
  std::string name;
  int parent = -1; ///< index into Scene::nodes; parents come before children
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
  glm::dvec3 scale{1};
  std::optional<glm::dmat4> matrix; ///< replaces translation, rotation and scale
  int mesh = -1;
  int camera = -1;
  int light = -1;
};

/// A source of soft balls of smoke (scene/Smoke.h), from extras.tyndall.smoke of a node. Lengths are in world units
/// whatever the node's scale, and smoke rises along the world's y axis.
struct SmokeEmitter {
  int node = 0;        ///< index into Scene::nodes: where smoke comes from
  int particles = 200; ///< alive at any time, 1 to 100000
  double radius = 0.2; ///< of the largest particle when it is born, > 0
  double growth =
      3; ///< radius and distance from the middle of the column at the end of a life, over those at its begin
  double density = 2;      ///< extinction in the middle of a particle before it has grown, 1/world unit, >= 0
  double spread = 0.1;     ///< radius of the disc where particles are born, >= 0
  double height = 2;       ///< that particles rise in their life, > 0
  double rise = 0.5;       ///< speed, world units/s, > 0: a life lasts height / rise
  glm::dvec3 drift{0};     ///< velocity that is added, world units/s
  double turbulence = 0.3; ///< farthest that eddies carry a particle by the end of its life, >= 0
  glm::vec3 albedo{0.9F};  ///< share of the stopped light that is scattered, 0 to 1
  int seed = 0;            ///< of the places and eddies, 0 to 2^31 - 1
  double lifetime() const {
    return height / rise;
  } ///< seconds; the smoke of a node that does not move repeats after it
};

constexpr std::size_t kMostFogBanks = 8; ///< that are captured at once

/// A box or a sphere of fog, from extras.tyndall.fog of a node, whose transform places the cube, or the unit sphere,
/// from -1 to 1. A node that has lost an extent has none.
struct FogBank {
  int node = 0;            ///< index into Scene::nodes
  bool sphere = false;     ///< else a box
  double extinction = 0.1; ///< where it is densest, 1/world unit, >= 0
  double fade = 0.5;       ///< share of the half extent over which it thins out to its border, 0 to 1
  glm::ivec3 billows{0};   ///< by axis, each 1 to 32; all 0: it is even
  double clear = 0.3;      ///< share of it without fog where it has billows, 0 to 1
  int seed = 0;            ///< of the billows, 0 to 2^31 - 1
};

/// What all banks scatter, and smoke where a scene says it, from extras.tyndall.fog of the scene.
struct FogScattering {
  tyndall::Rgb albedo = {0.95F, 0.95F, 0.95F}; ///< share of the light that fog takes, 0 to 1
  tyndall::Phase phase = tyndall::Phase::HenyeyGreenstein;
  float g = 0.6F;
};

enum class AnimationPath { Translation, Rotation, Scale };
enum class Interpolation { Step, Linear, CubicSpline };

struct AnimationChannel {
  int node = 0;
  AnimationPath path = AnimationPath::Translation;
  Interpolation interpolation = Interpolation::Linear;
  std::vector<float> times;      ///< seconds, increasing
  std::vector<glm::vec4> values; ///< one a time (CubicSpline: in-tangent, value, out-tangent)
};

struct Scene {
  std::string name;
  std::vector<Node> nodes;
  std::vector<Mesh> meshes;
  std::vector<Material> materials; ///< never empty
  std::vector<Texture> textures;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<SmokeEmitter> smoke;
  std::vector<FogBank> fog; ///< at most kMostFogBanks; not in a scene that has smoke
  /// None: banks scatter as FogScattering begins, and smoke is drawn with its own light.
  std::optional<FogScattering> fogScattering;
  std::vector<AnimationChannel> animation;  ///< all animations of the file, played at once
  std::optional<tyndall::Medium> medium;    ///< extras.tyndall.medium of the file's scene
  std::optional<tyndall::Ambient> ambient;  ///< extras.tyndall.ambient: light that the medium scatters
  glm::vec3 skyRadiance{0.0F};              ///< extras.tyndall.sky: radiance of the sky, and what surfaces get of it
  std::vector<std::filesystem::path> files; ///< it was read from, and those it refers to, read or not
  std::vector<std::string> notes;           ///< what was ignored, clamped or made up, a line each
};

/// The node transforms at a time in seconds, worldFromNode for each node.
std::vector<glm::dmat4> poseAt(const Scene& scene, double seconds);

/// The bounds of all triangles and strands in a pose, low and high corner; both 0 if there is none.
struct Bounds {
  glm::dvec3 low{0};
  glm::dvec3 high{0};
};
Bounds boundsOf(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode);

} // namespace host
