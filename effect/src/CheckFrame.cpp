#include "CheckFrame.h"

#include "CheckValues.h"
#include "DebugViews.h"
#include "optics/Blocks.h"
#include "optics/Matrices.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace tyndall {

namespace {

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

Status checkLayers(const Frame& frame) {
  for (const auto& [field, layer] :
       {std::pair{"colourLayer", frame.colourLayer}, std::pair{"output.layer", frame.output.layer}})
    if (layer < -1) return invalid(field, std::to_string(layer), "must be a layer, or -1 for a texture without");
  return {};
}

// A layer that coefficients follow: one of the medium's, or -1.
Status checkLayer(const Medium& medium, const std::string& field, int layer) {
  if (layer >= -1 && layer < static_cast<int>(medium.layers.size())) return {};
  return invalid(field, std::to_string(layer),
                 "must be -1 or one of the " + std::to_string(medium.layers.size()) + " of medium.layers, from 0 on");
}

Status checkLayers(const Medium& medium) {
  if (medium.layers.size() > kMaxHeightLayers)
    return invalid("medium.layers", std::to_string(medium.layers.size()) + " long", "at most 2 are allowed");
  for (std::size_t i = 0; i < medium.layers.size(); ++i) {
    const HeightLayer& layer = medium.layers[i];
    const std::string field = "medium.layers[" + std::to_string(i) + "].";
    if (!std::isfinite(layer.height)) return invalid(field + "height", text(layer.height), "must be finite");
    if (!(layer.scale > 0)) return invalid(field + "scale", text(layer.scale), "must be > 0, may be infinite");
    if (!(layer.ground < kInfinity))
      return invalid(field + "ground", text(layer.ground), "must be finite, or -infinity: there is none");
  }
  if (!medium.layers.empty() && (!isFinite(medium.up) || isZero(medium.up)))
    return invalid("medium.up", textOf(medium.up), "must be finite and not 0");
  return {};
}

Status checkPhase(const std::string& field, Phase phase, float g) {
  if (phase < Phase::Isotropic || phase > Phase::CornetteShanks)
    return invalid(field + "phase", std::to_string(static_cast<int>(phase)), "must be one of the enumerators");
  if (!(g > -1 && g < 1)) return invalid(field + "g", text(g), "must lie between -1 and 1, both excluded");
  return {};
}

Status checkMedium(const Medium& medium) {
  if (Status s = checkLayers(medium); !s) return s;
  if (medium.constituents.size() > kMaxConstituents)
    return invalid("medium.constituents", std::to_string(medium.constituents.size()) + " long",
                   "at most 4 are allowed");
  for (std::size_t i = 0; i < medium.constituents.size(); ++i) {
    const Constituent& c = medium.constituents[i];
    const std::string field = "medium.constituents[" + std::to_string(i) + "].";
    if (!isNonNegative(c.scattering))
      return invalid(field + "scattering", textOf(c.scattering), "must be finite and >= 0");
    if (Status s = checkPhase(field, c.phase, c.g); !s) return s;
    if (Status s = checkLayer(medium, field + "layer", c.layer); !s) return s;
  }
  if (Status s = checkLayer(medium, "medium.absorptionLayer", medium.absorptionLayer); !s) return s;
  if (!isNonNegative(medium.absorption))
    return invalid("medium.absorption", textOf(medium.absorption), "must be finite and >= 0");
  if (!(medium.farDistance > 0)) return invalid("medium.farDistance", text(medium.farDistance), "must be > 0");
  return {};
}

Status checkAmbient(const Ambient& ambient) {
  if (!isNonNegative(ambient.radiance))
    return invalid("ambient.radiance", textOf(ambient.radiance), "must be finite and >= 0");
  for (std::size_t i = 0; i < ambient.harmonics.size(); ++i)
    if (!isFinite(ambient.harmonics[i]))
      return invalid("ambient.harmonics[" + std::to_string(i) + "]", textOf(ambient.harmonics[i]), "must be finite");
  return {};
}

Status checkLookup(const Frame& frame) {
  const Lookup& lookup = frame.lookup;
  if (lookup.inscatter == 0 && lookup.transmittance == 0) return {};
  constexpr double kLeast = 1e-30, kMost = 1e30;              // float32 holds them,
  constexpr double kLeastRatio = 1 + 1e-4, kMostRatio = 1e12; // and what lies between
  if (!(lookup.nearDistance >= kLeast && lookup.nearDistance < kMost))
    return invalid("lookup.nearDistance", text(lookup.nearDistance), "must be finite and > 0, as a 32-bit float");
  const double ratio = lookup.farDistance / lookup.nearDistance;
  if (!(ratio >= kLeastRatio && ratio <= kMostRatio && lookup.farDistance <= kMost))
    return invalid("lookup.farDistance", text(lookup.farDistance),
                   "must be finite, > nearDistance and at most 1e12 times that");
  if (frame.settings.technique == Technique::Exact)
    return invalid("settings.technique", "Exact", "Frame::lookup needs slices: technique Tree, LowRank or Epipolar");
  return {};
}

Status checkEyeCurves(const Frame& frame) {
  const EyeCurves& eye = frame.eyeCurves;
  if (!isNonNegative(eye.albedo) || std::any_of(eye.albedo.begin(), eye.albedo.end(), [](float a) { return a > 1; }))
    return invalid("eyeCurves.albedo", textOf(eye.albedo), "must be 0 to 1");
  if (Status s = checkPhase("eyeCurves.", eye.phase, eye.g); !s) return s;
  if (eye.curves.texture == 0) return {};
  const auto& all = frame.medium.constituents;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto scatters = [&](const Constituent& constituent) { return constituent.scattering[c] > 0; };
    if (eye.albedo[c] > 0 && all.size() == kMaxConstituents && std::none_of(all.begin(), all.end(), scatters))
      return invalid("eyeCurves.albedo", textOf(eye.albedo),
                     "a medium of four constituents must scatter in each channel in which this does");
  }
  if (Status s = checkNodes("eyeCurves.curves.nodes", eye.curves); !s) return s;
  return checkEyePlanes(frame.camera, eye.nearDistance, eye.farDistance);
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
  if (!(settings.errorTarget >= 0 && settings.errorTarget <= 1))
    return invalid("settings.errorTarget", text(settings.errorTarget), "must be 0 to 1");
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
  if (Status s = checkViewport(frame.viewport); !s) return s;
  if (Status s = checkLayers(frame); !s) return s;
  if (frame.colour == 0 && frame.output.inscatter == 0 && frame.output.transmittance == 0)
    return invalid("colour", "0", "may only be left out if output names a texture to write");
  if (Status s = checkCamera(frame.camera); !s) return s;
  if (Status s = checkSceneDepth(frame); !s) return s;
  if (frame.lights.size() > kMaxLights)
    return invalid("lights", std::to_string(frame.lights.size()) + " long", "at most 16 are allowed");
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    if (Status s = checkLight("lights[" + std::to_string(i) + "].", frame.lights[i]); !s) return s;
  if (Status s = checkMedium(frame.medium); !s) return s;
  if (Status s = checkAmbient(frame.ambient); !s) return s;
  if (Status s = checkEyeCurves(frame); !s) return s;
  if (Status s = checkSettings(frame.settings); !s) return s;
  if (Status s = checkLookup(frame); !s) return s;
  if (Status s = checkReuse(frame); !s) return s;
  if (Status s = checkView(frame); !s) return s;
  return checkRange(frame);
}

} // namespace tyndall
