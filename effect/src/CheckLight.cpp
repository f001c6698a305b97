#include "CheckValues.h"
#include "optics/Blocks.h"

#include <algorithm>
#include <cstdint>

namespace tyndall {

namespace {

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
                                                    : "a point light has 1 to 6, or shadow.cube.enabled";
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
  const glm::dvec3 n = optics::directionOf(optics::toGlm(boundary.normal)),
                   d = optics::directionOf(optics::toGlm(light.direction));
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
  if (light.curves.texture == 0) return {};
  if (light.shadow.texture == 0)
    return invalid(field + "shadow.texture", "0", "curves need a shadow map, whose views they share");
  if (Status s = checkNodes(field + "curves.nodes", light.curves); !s) return s;
  if (light.shadow.cube.enabled && !std::isfinite(light.shadow.cube.farDistance))
    return invalid(field + "shadow.cube.farDistance", text(light.shadow.cube.farDistance),
                   "curves need one that is not at infinity");
  for (std::size_t i = 0; i < light.shadow.views.size(); ++i)
    if (!optics::linearDepth(light, static_cast<int>(i)).exists)
      return invalid(field + "shadow.views[" + std::to_string(i) + "].clipFromWorld", "without a far plane",
                     "curves need one that is not at infinity");
  return {};
}

} // namespace

Status checkLight(const std::string& field, const Light& light) {
  if (light.kind < LightKind::Directional || light.kind > LightKind::Spot)
    return invalid(field + "kind", std::to_string(static_cast<int>(light.kind)), "must be one of the enumerators");
  if (!isNonNegative(light.colour)) return invalid(field + "colour", textOf(light.colour), "must be finite and >= 0");
  if (!(light.scatteringScale >= 0 && std::isfinite(light.scatteringScale)))
    return invalid(field + "scatteringScale", text(light.scatteringScale), "must be finite and >= 0");
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

} // namespace tyndall
