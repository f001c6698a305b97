#include "Mistakes.h"

#include "reference/CameraRays.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace tests {

namespace {

constexpr LightKind kSun = LightKind::Directional, kLamp = LightKind::Point, kSpot = LightKind::Spot;

Frame& frameOf(ShaftRig& rig) { return rig.scene.frame; }
Light& lightOf(ShaftRig& rig) { return rig.scene.frame.lights[0]; }

glm::dmat4 of(const Mat4& m) { return reference::toMat4(m); }

// Changes a matrix by one on its left or right.
void multiply(Mat4& m, const glm::dmat4& left) { m = toMat4(left * of(m)); }
void transpose(Mat4& m) { m = toMat4(glm::transpose(of(m))); }
void invert(Mat4& m) { m = toMat4(glm::inverse(of(m))); }

void forViews(ShaftRig& rig, const std::function<void(Mat4&)>& change) {
  for (ShadowView& view : lightOf(rig).shadow.views)
    change(view.clipFromWorld);
}

// From [-1, 1] to [0, 1], as shaders that sample shadow maps want it.
const glm::dmat4 kBias = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.5)), glm::dvec3(0.5));
// Into the upper left of four tiles.
const glm::dmat4 kTile = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(-0.5, 0.5, 0)), glm::dvec3(0.5, 0.5, 1));

// The projection with planes that the depth does not have; depth stays.
void setPlanes(ShaftRig& rig, double near, bool reversed = true, bool infinite = true,
               ClipDepth clipDepth = ClipDepth::ZeroToOne) {
  DepthConvention other = rig.scene.convention();
  other.near = near;
  other.reversed = reversed;
  other.infinite = infinite;
  other.clipDepth = clipDepth;
  frameOf(rig).camera.clipFromView = other.clipFromView(0.5, 1.5);
}

// The rig with a standard depth from -1 to 1, as OpenGL has it unless told otherwise.
void useOldDepth(ShaftRig& rig) {
  DepthConvention old;
  old.near = 0.25;
  old.far = 60;
  rig.setConvention(old);
}

void fillDepth(ShaftRig& rig, float value) { rig.scene.setDepth(std::vector<float>(rig.scene.depth().size(), value)); }

void fillMap(ShaftRig& rig, float value) {
  reference::ShadowImage image = rig.scene.shadow(0);
  std::fill(image.depth.begin(), image.depth.end(), value);
  rig.scene.setShadow(0, image);
}

void scaleMedium(ShaftRig& rig, float factor) {
  for (float& s : frameOf(rig).medium.constituents[0].scattering)
    s *= factor;
}

const std::vector<Mistake> kMistakes = {
    // The camera.
    {"a view matrix by rows",
     kSun,
     [](auto& rig) { transpose(frameOf(rig).camera.viewFromWorld); },
     Answer::Error,
     {"camera.viewFromWorld is not affine"}},
    {"the camera's pose in place of its inverse",
     kSun,
     [](auto& rig) { invert(frameOf(rig).camera.viewFromWorld); },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"a projection by rows",
     kSun,
     [](auto& rig) { transpose(frameOf(rig).camera.clipFromView); },
     Answer::Error,
     {"camera.clipFromView has the last row", "transposed"}},
    {"viewFromClip",
     kSun,
     [](auto& rig) { invert(frameOf(rig).camera.clipFromView); },
     Answer::Error,
     {"camera.clipFromView has the last row", "inverse"}},
    {"view and projection in one, and the view again",
     kSun,
     [](auto& rig) {
       Camera& camera = frameOf(rig).camera;
       multiply(camera.viewFromWorld, glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(0, 1, 0)));
       camera.clipFromView = toMat4(of(camera.clipFromView) * of(camera.viewFromWorld));
     },
     Answer::Warning,
     {"camera.clipFromView has the last row", "view matrix"}},
    {"a near plane 18 times as far as depth has it",
     kSun,
     [](auto& rig) { setPlanes(rig, 18 * 0.05); },
     Answer::Pixels,
     {"lights[0].shadow", "near and far planes"}},
    {"a near plane 18 times as near as depth has it",
     kSun,
     [](auto& rig) { setPlanes(rig, 0.05 / 18); },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"depth from 0 to 1, said to be from -1 to 1",
     kSun,
     [](auto& rig) { frameOf(rig).camera.clipDepth = ClipDepth::NegativeOneToOne; },
     Answer::Error,
     {"camera.clipDepth is NegativeOneToOne", "behind the eye"}},
    {"depth from -1 to 1, said to be from 0 to 1",
     kSun,
     [](auto& rig) {
       useOldDepth(rig);
       frameOf(rig).camera.clipDepth = ClipDepth::ZeroToOne;
     },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"reversed depth from -1 to 1, said to be from 0 to 1",
     kSun,
     [](auto& rig) { setPlanes(rig, 0.05, true, true, ClipDepth::NegativeOneToOne); },
     Answer::Warning,
     {"camera.clipDepth is ZeroToOne", "times as far"}},
    {"reversed depth, and a projection that is not",
     kSun,
     [](auto& rig) { setPlanes(rig, 0.05, false, false); },
     Answer::Pixels,
     {"Frame::depth", "near plane"}},
    {"the aspect ratio of another window",
     kSun,
     [](auto& rig) { frameOf(rig).camera.clipFromView[0] *= 0.75; },
     Answer::Warning,
     {"camera.clipFromView", "times as wide"}},
    {"a jitter of the wrong sign",
     kSun,
     [](auto& rig) {
       Camera& camera = frameOf(rig).camera;
       camera.jitter = {0.25, -0.4};
       multiply(camera.clipFromView, glm::translate(glm::dmat4(1), glm::dvec3(-2 * 0.25 / 96, 2 * 0.4 / 64, 0)));
     },
     Answer::Warning,
     {"camera.jitter is (0.25, -0.4)", "(-0.25, 0.4) pixels"}},
    {"a picture upside down",
     kSun,
     [](auto& rig) { multiply(frameOf(rig).camera.clipFromView, glm::scale(glm::dmat4(1), glm::dvec3(1, -1, 1))); },
     Answer::Warning,
     {"lights[0].direction", "mirrored"}},
    {"depth that is cleared", kSun, [](auto& rig) { fillDepth(rig, 0); }, Answer::Pixels, {"lights[0].shadow", "sky"}},
    {"depth that is cleared to the near value",
     kSun,
     [](auto& rig) { fillDepth(rig, 1); },
     Answer::Pixels,
     {"Frame::depth", "near plane"}},
    {"depth that another camera saw",
     kSun,
     [](auto& rig) { frameOf(rig).camera.viewFromWorld = lookAt({0, 2, 0}, {1, 2, -1}); },
     Answer::Pixels,
     {"lights[0].shadow"}},
    // A sun.
    {"the direction to the sun",
     kSun,
     [](auto& rig) {
       for (double& x : lightOf(rig).direction)
         x = -x;
     },
     Answer::Warning,
     {"lights[0].direction", "points it to the sun"}},
    {"the sun of another hour",
     kSun,
     [](auto& rig) { lightOf(rig).direction = {0.6, -0.6, 1}; },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld is a view along", "lights[0].direction"}},
    {"a lamp's view for a sun",
     kSun,
     [](auto& rig) { lightOf(rig).shadow.views = shadowViews(shaftLight(kSpot)); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld is a perspective view", "orthographic"}},
    {"a sun's shadow matrix by rows",
     kSun,
     [](auto& rig) { forViews(rig, transpose); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld", "it is transposed"}},
    {"a sun's shadow matrix, inverted",
     kSun,
     [](auto& rig) { forViews(rig, invert); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld", "it is the inverse, worldFromClip"}},
    {"a sun's shadow matrix for texture coordinates",
     kSun,
     [](auto& rig) { forViews(rig, [](Mat4& m) { multiply(m, kBias); }); },
     Answer::Pixels,
     {"lights[0].shadow", "it would agree if clipFromWorld is a matrix for texture coordinates"}},
    {"a sun's shadow matrix for texture coordinates, of depth as it is",
     kSun,
     [](auto& rig) {
       forViews(rig, [](Mat4& m) {
         multiply(m, glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.5, 0)), glm::dvec3(0.5, 0.5, 1)));
       });
     },
     Answer::Pixels,
     {"lights[0].shadow", "it would agree if clipFromWorld is a matrix for texture coordinates"}},
    {"a sun's shadow matrix scaled to an atlas's tile",
     kSun,
     [](auto& rig) { forViews(rig, [](Mat4& m) { multiply(m, kTile); }); },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"the coarsest cascade first",
     kSun,
     [](auto& rig) { std::swap(lightOf(rig).shadow.views[0], lightOf(rig).shadow.views[1]); },
     Answer::Warning,
     {"lights[0].shadow.views[1].clipFromWorld", "never looked at"}},
    {"one layer for two cascades",
     kSun,
     [](auto& rig) { lightOf(rig).shadow.views[1].layer = 0; },
     Answer::Warning,
     {"lights[0].shadow.views[1].layer is 0", "that of views[0]"}},
    {"layers of other cascades",
     kSun,
     [](auto& rig) {
       for (ShadowView& view : lightOf(rig).shadow.views)
         view.layer = 1 - view.layer;
     },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"a shadow map that nothing was drawn into",
     kSun,
     [](auto& rig) { fillMap(rig, 1); },
     Answer::Pixels,
     {"lights[0].shadow", "where the map has none"}},
    {"a shadow map that is all 0", kSun, [](auto& rig) { fillMap(rig, 0); }, Answer::Pixels, {"lights[0].shadow"}},
    {"a shadow map's clip depth",
     kSun,
     [](auto& rig) { lightOf(rig).shadow.clipDepth = ClipDepth::ZeroToOne; },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"shadow matrices of another place of the camera",
     kSun,
     [](auto& rig) {
       forViews(rig, [](Mat4& m) { m = toMat4(of(m) * glm::translate(glm::dmat4(1), glm::dvec3(2, 0, 1))); });
     },
     Answer::Pixels,
     {"lights[0].shadow"}},
    // Lamps.
    {"a spot's place below its node, not in the world",
     kSpot,
     [](auto& rig) { lightOf(rig).position = {0, 0, 0}; },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld is a view from (-0.6, 6.4, -3.5)", "lights[0].position"}},
    {"a spot's shadow matrix by rows",
     kSpot,
     [](auto& rig) { forViews(rig, transpose); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld", "it is transposed"}},
    {"a spot's shadow matrix, inverted",
     kSpot,
     [](auto& rig) { forViews(rig, invert); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld", "it is the inverse"}},
    {"an orthographic view for a spot",
     kSpot,
     [](auto& rig) { lightOf(rig).shadow.views = shadowViews(shaftLight(kSun)); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld is an orthographic view", "perspective"}},
    {"the direction to a spot",
     kSpot,
     [](auto& rig) {
       for (double& x : lightOf(rig).direction)
         x = -x;
     },
     Answer::Error,
     {"lights[0].direction", "outside of lights[0].shadow.views[0]"}},
    {"a cone's whole angle",
     kSpot,
     [](auto& rig) { lightOf(rig).outerConeAngle = 1.5; },
     Answer::Warning,
     {"lights[0].outerConeAngle is 1.5", "half angle"}},
    {"a cone in degrees",
     kSpot,
     [](auto& rig) { lightOf(rig).outerConeAngle = 45; },
     Answer::Error,
     {"lights[0].outerConeAngle is 45"}},
    {"a spot's shadow matrix for texture coordinates",
     kSpot,
     [](auto& rig) { forViews(rig, [](Mat4& m) { multiply(m, kBias); }); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld", "(0.5, 0.5)"}},
    {"a spot's map upside down",
     kSpot,
     [](auto& rig) { forViews(rig, [](Mat4& m) { multiply(m, glm::scale(glm::dmat4(1), glm::dvec3(1, -1, 1))); }); },
     Answer::Warning,
     {"lights[0].shadow.views[0].clipFromWorld is mirrored"}},
    {"a range in other units",
     kSpot,
     [](auto& rig) { lightOf(rig).range = 0.06; },
     Answer::Warning,
     {"lights[0].range is 0.06", "near plane"}},
    {"one view of a point light",
     kLamp,
     [](auto& rig) { lightOf(rig).shadow.views.resize(1); },
     Answer::Warning,
     {"lights[0].shadow.views is 1 long", "all sides"}},
    {"a point light that has moved on",
     kLamp,
     [](auto& rig) { lightOf(rig).position[1] += 0.5; },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld is a view from", "lights[0].position"}},
    {"a cube's faces in another order",
     kLamp,
     [](auto& rig) {
       for (ShadowView& view : lightOf(rig).shadow.views)
         view.layer = 5 - view.layer;
     },
     Answer::Pixels,
     {"lights[0].shadow"}},
    // The rest.
    {"views without a map",
     kSun,
     [](auto& rig) { lightOf(rig).shadow.texture = 0; },
     Answer::Warning,
     {"lights[0].shadow.texture is 0"}},
    {"the scene depth as a shadow map",
     kSpot,
     [](auto& rig) {
       lightOf(rig).shadow.array = false;
       lightOf(rig).shadow.texture = frameOf(rig).depth.texture;
     },
     Answer::Error,
     {"lights[0].shadow.texture is texture", "scene depth"}},
    {"a light that is black",
     kSun,
     [](auto& rig) { lightOf(rig).colour = {0, 0, 0}; },
     Answer::Warning,
     {"lights", "black"}},
    {"a medium that only absorbs",
     kSun,
     [](auto& rig) { scaleMedium(rig, 0); },
     Answer::Warning,
     {"medium.constituents", "no light is added"}},
    {"a medium per millimetre",
     kSun,
     [](auto& rig) { scaleMedium(rig, 1e4F); },
     Answer::Warning,
     {"medium is so thick"}},
    {"a medium per light year",
     kSun,
     [](auto& rig) { scaleMedium(rig, 1e-9F); },
     Answer::Warning,
     {"medium is so thin"}},
    {"a sky at the eye",
     kSun,
     [](auto& rig) { frameOf(rig).medium.farDistance = 0.01; },
     Answer::Warning,
     {"medium.farDistance is 0.01", "near plane"}},
};

} // namespace

const std::vector<Mistake>& mistakes() { return kMistakes; }

ShaftRig rightRig(LightKind kind) {
  ShaftRig rig;
  rig.look(lookAt({0.5, 2, 1}, {-0.4, 1.6, -4}));
  Light light = shaftLight(kind);
  light.shadow.views = shadowViews(light, 2);
  rig.addLight(light);
  frameOf(rig).settings.technique = Technique::Epipolar;
  return rig;
}

} // namespace tests
