#include "optics/MapCopy.h"

#include "optics/Matrices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::optics {

namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

Mat4 fromGlm(const dmat4& m) {
  Mat4 copy{};
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      copy[static_cast<std::size_t>(4 * c + r)] = m[c][r];
  return copy;
}

// Which way the face's columns and rows of texels run (OpenGL 4.6, table 8.19), and the view's back.
constexpr int kFaces = 6;
dmat4 faceFromLight(int face) {
  static const std::array<std::array<dvec3, 3>, kFaces> kAxes = {{{{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}},
                                                                  {{{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}}},
                                                                  {{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                                                  {{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}},
                                                                  {{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}},
                                                                  {{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}}};
  const std::array<dvec3, 3>& axes = kAxes[static_cast<std::size_t>(face)];
  return glm::transpose(dmat4(dvec4(axes[0], 0), dvec4(axes[1], 0), dvec4(-axes[2], 0), dvec4(0, 0, 0, 1)));
}

// 90 degrees wide. Clip z / w is window depth, or what GL makes that of.
dmat4 faceProjection(const CubeMap& cube, ClipDepth clipDepth) {
  const double near = cube.nearDistance, far = cube.farDistance;
  // Window depth a + b / d at distance d.
  const bool endless = !std::isfinite(far);
  double a = endless ? 1 : far / (far - near), b = endless ? -near : -far * near / (far - near);
  if (cube.reversedDepth) {
    a = 1 - a;
    b = -b;
  }
  if (clipDepth == ClipDepth::NegativeOneToOne) {
    a = 2 * a - 1;
    b = 2 * b;
  }
  dmat4 m(0);
  m[0][0] = m[1][1] = 1;
  m[2][2] = -a;
  m[3][2] = b;
  m[2][3] = -1;
  return m;
}

// Depth of a perspective view along its rays: derived where the light is the origin, so that clip w is 0 there. With N
// the inverse, the homogeneous point of clip (x, y, z, 1) is N (x, y, z, 1); its xyz does not depend on z, and is the
// ray's direction. Along the axis n that is c = 1 / |row 3| everywhere, so that the distance along it is d = c / w, and
// z follows from w = N0w x + N1w y + N2w z + N3w.
void setPerspective(const dmat4& depthClipFromWorld, bool reversed, blocks::CopyBlock& block, double& far) {
  const dmat4 clip = glm::translate(depthClipFromWorld, eyeOf(depthClipFromWorld)), n = glm::inverse(clip);
  const dvec3 row(glm::transpose(clip)[3]), axis = glm::normalize(row);
  const double c = 1 / glm::length(row);
  const dvec3 other = std::abs(axis.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
  const std::array<int, 3> columns = {3, 0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 direction(n[columns[i]]);
    block.copiedRay[i] = glm::vec4(glm::dvec4(glm::dot(u, direction), glm::dot(v, direction), i == 0 ? c : 0, 0) / c);
  }
  block.copiedDepth = glm::vec4(dvec4(-n[3].w, -n[0].w, -n[1].w, c) / n[2].w);
  const double nearWeight = n[3].w + (reversed ? n[2].w : 0), farWeight = n[3].w + (reversed ? 0 : n[2].w);
  far = farWeight > 1e-12 * nearWeight ? c / farWeight : kInfinity;
}

void setOrthographic(const dmat4& depthClipFromWorld, bool reversed, blocks::CopyBlock& block, double& far) {
  const dmat4 rows = glm::transpose(depthClipFromWorld);
  far = std::abs(rows[3].w) / glm::length(dvec3(rows[2]));
  block.copiedRay[0] = glm::vec4(0, 0, 1, 0);
  block.copiedDepth = glm::vec4(reversed ? 1 : 0, 0, 0, static_cast<float>((reversed ? -1 : 1) / far));
  block.copiedIsOrthographic = 1;
}

} // namespace

std::vector<ShadowView> cubeViews(const Light& light) {
  const CubeMap& cube = light.shadow.cube;
  const dmat4 projection = faceProjection(cube, light.shadow.clipDepth);
  std::vector<ShadowView> views;
  for (int face = 0; face < kFaces; ++face) {
    ShadowView view;
    view.clipFromWorld = fromGlm(projection * glm::translate(faceFromLight(face), -toGlm(light.position)));
    view.layer = kFaces * cube.index + face;
    views.push_back(view);
  }
  return views;
}

blocks::CopyBlock copyBlock(const Light& light, int view, const Rectangle& texels, double rounding) {
  const ShadowMap& map = light.shadow;
  const ShadowView& shown = map.views[static_cast<std::size_t>(view)];
  const dmat4 depthClipFromWorld = depthFromClip(map.clipDepth) * toGlm(shown.clipFromWorld);
  const bool reversed = isReversedView(light, view);
  blocks::CopyBlock block{};
  double far = 0;
  (isOrthographic(depthClipFromWorld) ? setOrthographic : setPerspective)(depthClipFromWorld, reversed, block, far);
  block.copiedUnit = static_cast<float>(map.scale.unit);
  block.copiedOffset = static_cast<float>(map.scale.offset);
  block.copiedFar = static_cast<float>(std::min(far, 3e38));
  block.copiedRounding =
      static_cast<float>(std::isfinite(far) ? rounding * std::max(far, std::abs(map.scale.offset)) : 0);
  block.copiedFarDepth = reversed ? 0.0F : 1.0F;
  block.copiedEncoding = static_cast<int>(map.encoding);
  block.copiedOrigin = {texels.x, texels.y};
  block.copiedSize = {texels.width, texels.height};
  block.copiedLayer = shown.layer;
  return block;
}

} // namespace tyndall::optics
