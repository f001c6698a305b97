// Scenes of a few quads, built in code, whose pictures are known.
#pragma once

#include "scene/Projection.h"
#include "scene/Scene.h"

namespace tests {

/// One white opaque material (index 0) and nothing to draw.
host::Scene emptyScene();

int addMaterial(host::Scene& scene, const host::Material& material);

/// A parallelogram centre +- halfU +- halfV at a node of its own, uv from (0, 0) to (1, 1).
void addQuad(host::Scene& scene, const glm::dvec3& centre, const glm::vec3& halfU, const glm::vec3& halfV,
             int material = 0);

/// A square in the plane z = const, facing +z.
void addWall(host::Scene& scene, double z, float halfSide, int material = 0, const glm::dvec2& centre = {0, 0});

/// worldFromNode of nodes without parents.
std::vector<glm::dmat4> restPose(const host::Scene& scene);

/// At the world's origin, looking along -z.
tyndall::Camera cameraAtOrigin(const glm::dmat4& clipFromView, tyndall::ClipDepth clipDepth = {});

/// Sunlight along -z with one orthographic view: halfWidth to the sides, from z = nearZ down to farZ.
tyndall::Light sunAlongZ(double halfWidth, double nearZ, double farZ, const host::ClipConvention& convention = {});

/// A spot light at the world's origin along -z, with one view of 90 degrees.
tyndall::Light spotAtOrigin(double nearPlane, double farPlane, const host::ClipConvention& convention = {});

/// What the depth buffer holds for a distance along the view axis.
double depthAt(const glm::dmat4& clipFromView, tyndall::ClipDepth clipDepth, double distance);

/// Whether the context offers what a convention needs.
bool supports(const host::ClipConvention& convention);

/// All four conventions.
std::vector<host::ClipConvention> allConventions();
std::string nameOf(const host::ClipConvention& convention);

} // namespace tests
