// Fits a light's shadow views to the scene.
#pragma once

#include <glm/glm.hpp>
#include <scene/Projection.h>
#include <scene/Scene.h>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace host {

struct ShadowOptions {
  bool reversedDepth = false;
  tyndall::ClipDepth clipDepth = tyndall::ClipDepth::NegativeOneToOne;
  int cascades = 1;     ///< 1 to 4, of a directional light
  int steadyTexels = 0; ///< texels per side of a directional light's maps that stay in place; 0: they follow the camera
  bool cubeFaces = false; ///< of point lights: turned as GL's cube maps have them
  double seconds = 0;     ///< the time of the pose, for smoke whose source moves
};

/// Fills light.shadow.views (matrices; layers 0, 1, ...) and light.shadow.clipDepth, and nothing else of the light.
///
/// Casters are triangles, glass too, and boxes around smoke, fog and strands.
///
/// Directional: a box along the light that holds all casters, turned about the light's direction for the
/// smallest area. Sideways it is cut to what a camera ray can reach of the casters' shadows, so every point of a camera
/// ray outside it is lit. Cascades divide the view depth up to the scene's end; each takes in all casters towards the
/// light. With steadyTexels texels stay where they are in the world while the camera turns and moves, and its
/// projection stays: boxes keep their size and their turn about the light, and move by whole texels of a lattice from
/// the world's origin. Each cascade but the last then holds a ball around its part of the view, the last one all
/// casters; the view depth is divided up to the length of the casters' bounds. So they are coarser. Spot: one pyramid
/// around the cone. Point: six pyramids of 90 degrees. Their depth range is that of the casters inside.
///
/// Where nothing can block the light there are no views: then the light needs no shadow map.
/// Returns what could not be fitted, a line each.
std::vector<std::string> fitShadowViews(tyndall::Light& light, const Scene& scene,
                                        const std::vector<glm::dmat4>& worldFromNode, const tyndall::Camera& camera,
                                        const ShadowOptions& options = {});

} // namespace host
