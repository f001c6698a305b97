#include "CheckFrame.h"

#include "DebugViews.h"
#include "FieldText.h"
#include "optics/Blocks.h"
#include "optics/Matrices.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace tyndall {

namespace {

template <typename Vector>
bool isFinite(const Vector& v) {
  for (const auto x : v)
    if (!std::isfinite(x)) return false;
  return true;
}

template <typename Vector>
bool isNonNegative(const Vector& v) {
  for (const auto x : v)
    if (!(std::isfinite(x) && x >= 0)) return false;
  return true;
}

bool isZero(const Vec3& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

Status checkMatrix(const std::string& field, const Mat4& matrix) {
  if (!isFinite(matrix)) return invalid(field, "not finite", "every element must be a finite number");
  if (!optics::isInvertible(optics::toGlm(matrix))) return invalid(field, "singular", "the matrix must be invertible");
  return {};
}

Status checkClipDepth(const std::string& field, ClipDepth clipDepth) {
  if (clipDepth == ClipDepth::NegativeOneToOne || clipDepth == ClipDepth::ZeroToOne) return {};
  return invalid(field, std::to_string(static_cast<int>(clipDepth)), "must be one of the enumerators");
}

constexpr double kMostJitter = 16; // pixels, as the header says

Status checkCamera(const Camera& camera) {
  if (Status s = checkMatrix("camera.viewFromWorld", camera.viewFromWorld); !s) return s;
  const Mat4& view = camera.viewFromWorld;
  constexpr double kRounding = 1e-5; // of a matrix that a general inverse made, in float
  if (std::abs(view[3]) + std::abs(view[7]) + std::abs(view[11]) > kRounding || std::abs(view[15] - 1) > kRounding)
    return invalid("camera.viewFromWorld", "not affine", "its last row must be (0, 0, 0, 1)");
  if (Status s = checkClipDepth("camera.clipDepth", camera.clipDepth); !s) return s;
  const auto [x, y] = camera.jitter;
  if (!(std::abs(x) <= kMostJitter && std::abs(y) <= kMostJitter))
    return invalid("camera.jitter", "(" + text(x) + ", " + text(y) + ")",
                   "must be finite and at most 16 pixels, either way");
  return checkMatrix("camera.clipFromView", camera.clipFromView);
}

std::string nameOf(DepthEncoding encoding) {
  constexpr const char* kNames[] = {"Window", "Axial", "Radial", "Logarithmic"};
  return kNames[static_cast<int>(encoding)];
}

Status checkDepthScale(const std::string& field, DepthEncoding encoding, const DepthScale& scale) {
  const DepthScale none;
  const bool isSet = scale.unit != none.unit || scale.offset != none.offset || scale.constant != none.constant ||
                     scale.farDistance != none.farDistance;
  switch (encoding) {
  case DepthEncoding::Window:
    return isSet ? invalid(field + "scale", "set", "encoding Window has none") : Status{};
  case DepthEncoding::Logarithmic:
    if (!(scale.constant > 0 && std::isfinite(scale.constant)))
      return invalid(field + "scale.constant", text(scale.constant), "must be finite and > 0");
    if (!(scale.farDistance > 0 && std::isfinite(scale.farDistance)))
      return invalid(field + "scale.farDistance", text(scale.farDistance), "must be finite and > 0");
    return {};
  default:
    if (scale.unit == 0 || !std::isfinite(scale.unit))
      return invalid(field + "scale.unit", text(scale.unit), "must be finite and not 0");
    if (!std::isfinite(scale.offset)) return invalid(field + "scale.offset", text(scale.offset), "must be finite");
    return {};
  }
}

Status checkSceneDepth(const Frame& frame) {
  const SceneDepth& depth = frame.depth;
  const DepthEncoding encoding = depth.encoding;
  if (depth.layer < -1)
    return invalid("depth.layer", std::to_string(depth.layer), "must be a layer, or -1 for a texture without");
  const Rectangle& r = depth.rectangle;
  const bool isGiven = r.x != 0 || r.y != 0 || r.width != 0 || r.height != 0;
  if (isGiven && (r.x < 0 || r.y < 0 || r.width < 1 || r.height < 1))
    return invalid("depth.rectangle", textOf(r), "must be at least 1 x 1 at (0, 0) or beyond, or all 0");
  if (encoding < DepthEncoding::Window || encoding > DepthEncoding::Logarithmic)
    return invalid("depth.encoding", std::to_string(static_cast<int>(encoding)), "must be one of the enumerators");
  if ((encoding == DepthEncoding::Radial || encoding == DepthEncoding::Logarithmic) &&
      optics::isOrthographic(optics::toGlm(frame.camera.clipFromView)))
    return invalid("depth.encoding", nameOf(encoding), "needs a perspective camera");
  return checkDepthScale("depth.", encoding, depth.scale);
}

Status checkViewport(const Frame& frame) {
  const Rectangle& viewport = frame.viewport;
  if (viewport.x < 0) return invalid("viewport.x", std::to_string(viewport.x), "must be >= 0");
  if (viewport.y < 0) return invalid("viewport.y", std::to_string(viewport.y), "must be >= 0");
  if (viewport.width < 1 || viewport.width > kMaxImageSize)
    return invalid("viewport.width", std::to_string(viewport.width), "must be 1 to 16384");
  if (viewport.height < 1 || viewport.height > kMaxImageSize)
    return invalid("viewport.height", std::to_string(viewport.height), "must be 1 to 16384");
  for (const auto& [field, layer] :
       {std::pair{"colourLayer", frame.colourLayer}, std::pair{"output.layer", frame.output.layer}})
    if (layer < -1) return invalid(field, std::to_string(layer), "must be a layer, or -1 for a texture without");
  return {};
}

Status checkMedium(const Medium& medium) {
  if (medium.constituents.size() > kMaxConstituents)
    return invalid("medium.constituents", std::to_string(medium.constituents.size()) + " long",
                   "at most 4 are allowed");
  for (std::size_t i = 0; i < medium.constituents.size(); ++i) {
    const Constituent& c = medium.constituents[i];
    const std::string field = "medium.constituents[" + std::to_string(i) + "].";
    if (!isNonNegative(c.scattering))
      return invalid(field + "scattering", textOf(c.scattering), "must be finite and >= 0");
    if (c.phase < Phase::Isotropic || c.phase > Phase::CornetteShanks)
      return invalid(field + "phase", std::to_string(static_cast<int>(c.phase)), "must be one of the enumerators");
    if (!(c.g > -1 && c.g < 1)) return invalid(field + "g", text(c.g), "must lie between -1 and 1, both excluded");
  }
  if (!isNonNegative(medium.absorption))
    return invalid("medium.absorption", textOf(medium.absorption), "must be finite and >= 0");
  if (!(medium.farDistance > 0)) return invalid("medium.farDistance", text(medium.farDistance), "must be > 0");
  return {};
}

bool overlap(const Rectangle& a, const Rectangle& b) {
  const auto meet = [](std::int64_t p, std::int64_t pSize, std::int64_t q, std::int64_t qSize) {
    return p < q + qSize && q < p + pSize;
  };
  const bool whole = optics::isWholeLayer(a) || optics::isWholeLayer(b);
  return whole || (meet(a.x, a.width, b.x, b.width) && meet(a.y, a.height, b.y, b.height));
}

// Views without rectangles may show one layer.
Status checkRectangles(const std::string& light, const ShadowMap& shadow) {
  for (std::size_t i = 0; i < shadow.views.size(); ++i) {
    const Rectangle& r = shadow.views[i].rectangle;
    const std::string field = light + "shadow.views[" + std::to_string(i) + "].rectangle";
    const bool whole = optics::isWholeLayer(r);
    if (!whole && (r.x < 0 || r.y < 0 || r.width < 1 || r.height < 1))
      return invalid(field, textOf(r), "must begin at 0 or later and hold a texel; all 0 for the whole layer");
    for (std::size_t k = 0; k < i; ++k) {
      const ShadowView& other = shadow.views[k];
      if (other.layer == shadow.views[i].layer && !(whole && optics::isWholeLayer(other.rectangle)) &&
          overlap(r, other.rectangle))
        return invalid(field, textOf(r), "overlaps that of views[" + std::to_string(k) + "]");
    }
  }
  return {};
}

Status checkCube(const std::string& light, LightKind kind, const ShadowMap& shadow) {
  const CubeMap& cube = shadow.cube;
  const std::string field = light + "shadow.cube.";
  if (kind != LightKind::Point) return invalid(field + "enabled", "true", "only a point light has a cube map");
  if (!shadow.views.empty())
    return invalid(light + "shadow.views", std::to_string(shadow.views.size()) + " long",
                   "must be empty: a cube map's views are its faces");
  if (cube.index < 0 || (!shadow.array && cube.index != 0))
    return invalid(field + "index", std::to_string(cube.index),
                   shadow.array ? "must be >= 0" : "must be 0 for a GL_TEXTURE_CUBE_MAP");
  if (!(cube.nearDistance > 0 && std::isfinite(cube.nearDistance)))
    return invalid(field + "nearDistance", text(cube.nearDistance), "must be finite and > 0");
  if (!(cube.farDistance > cube.nearDistance))
    return invalid(field + "farDistance", text(cube.farDistance), "must be > nearDistance");
  return {};
}

Status checkScale(const std::string& field, const ShadowMap& shadow) {
  const DepthScale& scale = shadow.scale;
  if (shadow.encoding == DepthEncoding::Window && (scale.unit != 1 || scale.offset != 0))
    return scale.unit != 1 ? invalid(field + "unit", text(scale.unit), "must be 1 where the encoding is Window")
                           : invalid(field + "offset", text(scale.offset), "must be 0 where the encoding is Window");
  if (!std::isfinite(scale.unit) || scale.unit == 0)
    return invalid(field + "unit", text(scale.unit), "must be finite and not 0");
  if (!std::isfinite(scale.offset)) return invalid(field + "offset", text(scale.offset), "must be finite");
  if (scale.constant != 1)
    return invalid(field + "constant", text(scale.constant), "must be 1 where the encoding is not Logarithmic");
  if (scale.farDistance != 0)
    return invalid(field + "farDistance", text(scale.farDistance), "must be 0 where the encoding is not Logarithmic");
  return {};
}

Status checkEncoding(const std::string& light, LightKind kind, const ShadowMap& shadow) {
  const std::string field = light + "shadow.encoding";
  if (shadow.encoding < DepthEncoding::Window || shadow.encoding > DepthEncoding::Logarithmic)
    return invalid(field, std::to_string(static_cast<int>(shadow.encoding)), "must be one of the enumerators");
  if (shadow.encoding == DepthEncoding::Logarithmic)
    return invalid(field, "Logarithmic", "a shadow map's must be Window, Axial or Radial");
  if (shadow.encoding == DepthEncoding::Radial && kind == LightKind::Directional)
    return invalid(field, "Radial", "a directional light has no place to be distant from");
  for (std::size_t i = 0; i < shadow.views.size(); ++i)
    if (shadow.encoding == DepthEncoding::Radial &&
        optics::isOrthographic(optics::toGlm(shadow.views[i].clipFromWorld)))
      return invalid(field, "Radial", "views[" + std::to_string(i) + "] is orthographic");
  return checkScale(light + "shadow.scale.", shadow);
}

Status checkViews(const std::string& light, LightKind kind, const ShadowMap& shadow) {
  const std::size_t count = shadow.views.size();
  const char* rule = kind == LightKind::Directional ? "a directional light has 1 to 4 (cascades)"
                     : kind == LightKind::Spot      ? "a spot light has 1"
                                                    : "a point light has 1 to 6 (cube faces)";
  const std::size_t most = kind == LightKind::Directional ? 4 : kind == LightKind::Spot ? 1 : 6;
  if (count < 1 || count > most) return invalid(light + "shadow.views", std::to_string(count) + " long", rule);
  const bool anyWhole = std::any_of(shadow.views.begin(), shadow.views.end(),
                                    [](const ShadowView& view) { return optics::isWholeLayer(view.rectangle); });
  if (count > 1 && !shadow.array && anyWhole)
    return invalid(light + "shadow.array", "false", "several views need a GL_TEXTURE_2D_ARRAY, or a rectangle each");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string field = light + "shadow.views[" + std::to_string(i) + "].";
    if (Status s = checkMatrix(field + "clipFromWorld", shadow.views[i].clipFromWorld); !s) return s;
    if (shadow.views[i].layer < 0 || (!shadow.array && shadow.views[i].layer != 0))
      return invalid(field + "layer", std::to_string(shadow.views[i].layer),
                     shadow.array ? "must be >= 0" : "must be 0 for a GL_TEXTURE_2D");
  }
  return checkRectangles(light, shadow);
}

Status checkShadow(const std::string& light, LightKind kind, const ShadowMap& shadow) {
  if (Status s = shadow.cube.enabled ? checkCube(light, kind, shadow) : checkViews(light, kind, shadow); !s) return s;
  if (Status s = checkClipDepth(light + "shadow.clipDepth", shadow.clipDepth); !s) return s;
  return checkEncoding(light, kind, shadow);
}

Status checkBoundary(const std::string& field, const Light& light) {
  const MediumBoundary& boundary = light.boundary;
  if (!boundary.enabled) return {};
  if (light.kind != LightKind::Directional)
    return invalid(field + "boundary.enabled", "true", "only a directional light may have a boundary");
  if (!isFinite(boundary.point)) return invalid(field + "boundary.point", textOf(boundary.point), "must be finite");
  if (!isFinite(boundary.normal) || isZero(boundary.normal))
    return invalid(field + "boundary.normal", textOf(boundary.normal), "must be finite and not 0");
  const glm::dvec3 n = glm::normalize(optics::toGlm(boundary.normal)),
                   d = glm::normalize(optics::toGlm(light.direction));
  if (std::abs(glm::dot(n, d)) < 1e-6) // the path to the plane would be endless
    return invalid(field + "boundary.normal", textOf(boundary.normal),
                   "the light must not travel parallel to the plane");
  return {};
}

Status checkFade(const std::string& field, const Light& light) {
  if (!(light.cascadeFade >= 0 && light.cascadeFade <= 0.5))
    return invalid(field + "cascadeFade", text(light.cascadeFade), "must be 0 to 0.5");
  if (light.cascadeFade > 0 && light.kind != LightKind::Directional)
    return invalid(field + "cascadeFade", text(light.cascadeFade), "only a directional light has cascades");
  return {};
}

Status checkSpot(const std::string& field, const Light& light) {
  if (!(light.outerConeAngle > 0 && light.outerConeAngle <= 1.5707963267948968))
    return invalid(field + "outerConeAngle", text(light.outerConeAngle), "must be > 0 and <= pi/2");
  if (!(light.innerConeAngle >= 0 && light.innerConeAngle <= light.outerConeAngle))
    return invalid(field + "innerConeAngle", text(light.innerConeAngle), "must be >= 0 and <= outerConeAngle");
  return {};
}

Status checkCurves(const std::string& field, const Light& light) {
  const AvsmCurves& curves = light.curves;
  if (curves.texture == 0) return {};
  if (light.shadow.texture == 0)
    return invalid(field + "shadow.texture", "0", "curves need a shadow map, whose views they share");
  if (curves.nodes < 4 || curves.nodes > 16 || curves.nodes % 4 != 0)
    return invalid(field + "curves.nodes", std::to_string(curves.nodes), "must be 4, 8, 12 or 16");
  if (light.shadow.cube.enabled && !std::isfinite(light.shadow.cube.farDistance))
    return invalid(field + "shadow.cube.farDistance", text(light.shadow.cube.farDistance),
                   "curves need one that is not at infinity");
  for (std::size_t i = 0; i < light.shadow.views.size(); ++i)
    if (!optics::linearDepth(light, static_cast<int>(i)).exists)
      return invalid(field + "shadow.views[" + std::to_string(i) + "].clipFromWorld", "without a far plane",
                     "curves need one that is not at infinity");
  return {};
}

Status checkLight(const std::string& field, const Light& light) {
  if (light.kind < LightKind::Directional || light.kind > LightKind::Spot)
    return invalid(field + "kind", std::to_string(static_cast<int>(light.kind)), "must be one of the enumerators");
  if (!isNonNegative(light.colour)) return invalid(field + "colour", textOf(light.colour), "must be finite and >= 0");
  if (light.kind != LightKind::Point && (!isFinite(light.direction) || isZero(light.direction)))
    return invalid(field + "direction", textOf(light.direction), "must be finite and not 0");
  if (light.kind != LightKind::Directional) {
    if (!isFinite(light.position)) return invalid(field + "position", textOf(light.position), "must be finite");
    if (!(light.range > 0)) return invalid(field + "range", text(light.range), "must be > 0");
  }
  if (light.kind == LightKind::Spot)
    if (Status s = checkSpot(field, light); !s) return s;
  if (Status s = checkBoundary(field, light); !s) return s;
  if (Status s = checkFade(field, light); !s) return s;
  if (light.shadow.texture != 0)
    if (Status s = checkShadow(field, light.kind, light.shadow); !s) return s;
  if ((light.glass.colour != 0) != (light.glass.depth != 0))
    return invalid(field + (light.glass.colour ? "glass.depth" : "glass.colour"), "0",
                   "a glass map needs both its colour and its depth");
  if (light.glass.colour != 0 && light.shadow.texture == 0)
    return invalid(field + "shadow.texture", "0", "a glass map needs a shadow map, whose views it shares");
  return checkCurves(field, light);
}

Status checkView(const Frame& frame) {
  const DebugView view = frame.settings.debugView;
  const Technique technique = frame.settings.technique;
  const DebugViewRow* row = rowOf(view);
  if (!row)
    return invalid("settings.debugView", std::to_string(static_cast<int>(view)), "must be one of the enumerators");
  if (view != DebugView::Composite && frame.colour == 0)
    return invalid("settings.debugView", row->name, "needs Frame::colour, which the view replaces");
  if (row->shown == Shown::Picture) return {};
  if (technique == Technique::Exact)
    return invalid("settings.debugView", row->name, "needs slices: technique Tree, LowRank or Epipolar");
  if (row->shown == Shown::Samples && technique != Technique::Epipolar)
    return invalid("settings.debugView", row->name, "needs samples: technique Epipolar");
  return {};
}

Status checkSettings(const Settings& settings) {
  const auto enumerator = [](const char* field, int value) {
    return invalid(field, std::to_string(value), "must be one of the enumerators");
  };
  if (settings.technique < Technique::Exact || settings.technique > Technique::LowRank)
    return enumerator("settings.technique", static_cast<int>(settings.technique));
  if (settings.shadowFilter != ShadowFilter::Nearest && settings.shadowFilter != ShadowFilter::Bilinear)
    return enumerator("settings.shadowFilter", static_cast<int>(settings.shadowFilter));
  if (settings.slices < 1 || settings.slices > 8192)
    return invalid("settings.slices", std::to_string(settings.slices), "must be 1 to 8192");
  if (settings.samples < 64 || settings.samples > 8192 || settings.samples % 64 != 0)
    return invalid("settings.samples", std::to_string(settings.samples), "must be a multiple of 64 from 64 to 8192");
  if (settings.rowStep < 1 || settings.rowStep > 8)
    return invalid("settings.rowStep", std::to_string(settings.rowStep), "must be 1 to 8");
  if (!(settings.breakThreshold > 0 && std::isfinite(settings.breakThreshold)))
    return invalid("settings.breakThreshold", text(settings.breakThreshold), "must be finite and > 0");
  if (!(settings.bendThreshold > 0))
    return invalid("settings.bendThreshold", text(settings.bendThreshold), "must be > 0");
  if (!(settings.leastWeight >= 0 && settings.leastWeight <= 1))
    return invalid("settings.leastWeight", text(settings.leastWeight), "must be 0 to 1");
  if (!(settings.averageThreshold >= 0 && settings.averageThreshold <= 1))
    return invalid("settings.averageThreshold", text(settings.averageThreshold), "must be 0 to 1");
  if (!(settings.spreadThreshold > 0))
    return invalid("settings.spreadThreshold", text(settings.spreadThreshold), "must be > 0");
  if (settings.sampleBudget != 0 && settings.sampleBudget < 4096)
    return invalid("settings.sampleBudget", std::to_string(settings.sampleBudget), "must be 0 or at least 4096");
  if (settings.lowRankTerms < 1 || settings.lowRankTerms > 8)
    return invalid("settings.lowRankTerms", std::to_string(settings.lowRankTerms), "must be 1 to 8");
  return {};
}

Status checkMesh(const std::string& field, const MeshVertices& mesh) {
  if (mesh.buffer == 0) return {};
  if (mesh.stride < 12) return invalid(field + "stride", std::to_string(mesh.stride), "must be at least 12");
  if (mesh.count < 1 || mesh.count > 1U << 24)
    return invalid(field + "count", std::to_string(mesh.count), "must be 1 to 16777216");
  return {};
}

Status checkReuse(const Frame& frame) {
  const Reuse& reuse = frame.reuse;
  if (reuse.changes < Changes::Unknown || reuse.changes > Changes::Objects)
    return invalid("reuse.changes", std::to_string(static_cast<int>(reuse.changes)), "must be one of the enumerators");
  if (!(reuse.fullShare >= 0 && reuse.fullShare <= 1))
    return invalid("reuse.fullShare", text(reuse.fullShare), "must be 0 to 1");
  if (reuse.refreshFrames < 0 || reuse.refreshFrames > 65536)
    return invalid("reuse.refreshFrames", std::to_string(reuse.refreshFrames), "must be 0 to 65536");
  if (reuse.changes != Changes::Objects && !frame.objects.empty())
    return invalid("objects", std::to_string(frame.objects.size()) + " long",
                   "only reuse.changes Objects looks at them");
  for (std::size_t i = 0; i < frame.objects.size(); ++i) {
    const std::string field = "objects[" + std::to_string(i) + "].";
    const MovingObject& object = frame.objects[i];
    for (const auto& [name, matrix] : {std::pair{"worldFromObject", &object.worldFromObject},
                                       std::pair{"lastWorldFromObject", &object.lastWorldFromObject}}) {
      if (Status s = checkMatrix(field + name, *matrix); !s) return s;
      const Mat4& m = *matrix;
      if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
        return invalid(field + name, "not affine", "its last row must be (0, 0, 0, 1)");
    }
    if (Status s = checkMesh(field + "mesh.", object.mesh); !s) return s;
  }
  return {};
}

} // namespace

Status checkValues(const Frame& frame) {
  if (Status s = checkViewport(frame); !s) return s;
  if (frame.colour == 0 && frame.output.inscatter == 0 && frame.output.transmittance == 0)
    return invalid("colour", "0", "may only be left out if output names a texture to write");
  if (Status s = checkCamera(frame.camera); !s) return s;
  if (Status s = checkSceneDepth(frame); !s) return s;
  if (frame.lights.size() > kMaxLights)
    return invalid("lights", std::to_string(frame.lights.size()) + " long", "at most 16 are allowed");
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    if (Status s = checkLight("lights[" + std::to_string(i) + "].", frame.lights[i]); !s) return s;
  if (Status s = checkMedium(frame.medium); !s) return s;
  if (Status s = checkSettings(frame.settings); !s) return s;
  if (Status s = checkReuse(frame); !s) return s;
  return checkView(frame);
}

} // namespace tyndall
