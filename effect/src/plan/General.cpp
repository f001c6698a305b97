#include "plan/General.h"

#include "plan/LightVariant.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace tyndall {

namespace {

// Definitions by name; one that is not there is 0, and stays away.
class Values {
public:
  explicit Values(gl::Definitions& definitions) : definitions_(definitions) {}
  int operator[](std::string_view name) const {
    const auto found = find(name);
    return found == definitions_.end() ? 0 : found->second;
  }
  void set(std::string_view name, int value) {
    if (const auto found = find(name); found != definitions_.end()) found->second = value;
  }

private:
  gl::Definitions::iterator find(std::string_view name) const {
    return std::find_if(definitions_.begin(), definitions_.end(), [&](const auto& d) { return d.first == name; });
  }
  gl::Definitions& definitions_;
};

bool isOneOf(std::string_view fragment, std::initializer_list<std::string_view> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view name) { return fragment == "passes/" + std::string(name) + ".frag"; });
}

// Maps are read texel by texel, or where rows leave it open; else rows hold all.
bool readsMaps(std::string_view fragment, const Values& values) {
  if (values["SHADOW_VIEWS"] == 0) return false;
  if (isOneOf(fragment, {"exact", "fixup", "rowDepths", "tintGroups"})) return true;
  return values["FILTER_BILINEAR"] != 0 || values["GLASS"] != 0;
}

// Two or three of filter, glass and smoke together.
bool isMixture(const Values& values) { return values["FILTER_BILINEAR"] + values["GLASS"] + values["CURVES"] > 1; }

// But a sun through glass and grey smoke is what one renders: its rays are marched by programs of their own.
bool isOfSunbeams(std::string_view fragment, const Values& values) {
  return values["LIGHT_KIND"] == 0 && values["FILTER_BILINEAR"] == 0 && values["MONOCHROME"] != 0 &&
         values["HEIGHT"] == 0 && isOneOf(fragment, {"march", "marchExtra"});
}

// Where the medium's layers are looked at: where light is integrated, and what is left of the picture behind.
bool seesLayers(std::string_view fragment, const Values& values) {
  return isOneOf(fragment, {"ambient", "exact", "fixup", "lookupAmbient", "lookupLight", "lookupTransmittance", "march",
                            "marchExtra", "pixelTree", "transmittance", "unwarp", "unwarpEdges"}) &&
         values["LOW_RANK"] == 0 && values["SHARES"] == 0;
}

// Where what smoke and hair leave of light on its way to the eye is looked at: where light is integrated, and where it
// is decided for which samples.
bool seesEyeCurves(std::string_view fragment, const Values& values) {
  return isOneOf(fragment, {"ambient", "exact", "lookupAmbient", "lookupLight", "lookupTransmittance", "march",
                            "marchExtra", "marks", "transmittance"}) &&
         values["SHARES"] == 0;
}

// One layer has programs of its own where most is marched: by the nearest texels, without glass and smoke.
bool hasProgramsForOneLayer(std::string_view fragment, const Values& values) {
  if (values["EYE_CURVES"] != 0) return false;
  if (isOneOf(fragment, {"ambient", "lookupAmbient"})) return values["HEIGHT"] == kOnlyLayer; // in closed form
  return isOneOf(fragment, {"exact", "fixup", "march", "marchExtra"}) && values["FILTER_BILINEAR"] == 0 &&
         values["GLASS"] == 0 && values["CURVES"] == 0 && values["SHADOW_VIEWS"] != 0;
}

// Look-ups through the filter, glass or smoke.
bool isSeldomLookup(std::string_view fragment, const Values& values) {
  return isOneOf(fragment, {"lookupLight"}) && values["FILTER_BILINEAR"] + values["GLASS"] + values["CURVES"] > 0;
}

// Lights without a map, what smoke before the eye dims, a medium with layers, low rank, the debug view of visits,
// pixels marched between slices or where shares of the light do not tell, such look-ups, and mixtures.
bool isSeldom(std::string_view fragment, const Values& values) {
  if (!isOneOf(fragment, {"exact", "fixup", "lookupLight", "march", "marchExtra", "pixelTree"}))
    return values["ROW_HASHES"] != 0;
  if (values["SHADOW_VIEWS"] == 0) return true;
  return isOneOf(fragment, {"fixup"}) || values["EYE_CURVES"] != 0 || values["HEIGHT"] == kAnyLayers ||
         values["LOW_RANK"] != 0 || values["COUNT_VISITS"] != 0 || values["SHARES"] != 0 ||
         isSeldomLookup(fragment, values) || (isMixture(values) && !isOfSunbeams(fragment, values));
}

// One view of an array may be the first of several: always where that costs little or is seldom asked for. A point
// light's only view, which is seldom alone, is a spot's with an open cone.
bool takesSeveral(std::string_view fragment, const Values& values) {
  return values["LIGHT_KIND"] == 1 || isSeldom(fragment, values) ||
         isOneOf(fragment, {"exact", "rowDepths", "tintGroups"});
}

// A texture without layers where that is seldom: the light's maps are copied into an array (plan/MapCopies.cpp).
bool isSeldomAtlas(std::string_view fragment, const Values& values) {
  if (values["SHADOW_ARRAY"] != 0) return false;
  if (values["EYE_CURVES"] != 0) return true;
  if (values["SHADOW_VIEWS"] != 2) return false;
  return isMixture(values) || values["HEIGHT"] != kNoLayers || values["LOW_RANK"] != 0 || values["COUNT_VISITS"] != 0 ||
         values["TINT_SUMS"] != 0 || isOneOf(fragment, {"fixup", "tintGroups"});
}

void chooseMaps(std::string_view fragment, Values values) {
  if (values["SHADOW_VIEWS"] == 0) return;
  const bool several = values["SHADOW_VIEWS"] == 2 || takesSeveral(fragment, values);
  if (!readsMaps(fragment, values)) {
    values.set("SHADOW_ARRAY", 0);
    if (several) values.set("SHADOW_VIEWS", 2);
    return;
  }
  if (isSeldomAtlas(fragment, values)) values.set("SHADOW_ARRAY", 1);
  if (values["SHADOW_ARRAY"] != 0 && several) values.set("SHADOW_VIEWS", 2);
  if (values["SHADOW_ARRAY"] == 0 && values["SHADOW_VIEWS"] == 1 && values["LIGHT_KIND"] == 1)
    values.set("LIGHT_KIND", 2);
}

} // namespace

gl::Definitions general(const std::string& fragment, gl::Definitions definitions) {
  Values values(definitions);
  if (!seesEyeCurves(fragment, values)) values.set("EYE_CURVES", 0);
  if (values["EYE_CURVES"] == 0 || isOneOf(fragment, {"lookupTransmittance", "marks", "transmittance"}))
    values.set("FOG", 0);
  if (!seesLayers(fragment, values)) values.set("HEIGHT", kNoLayers);
  if (isOneOf(fragment, {"ambient", "lookupAmbient", "lookupTransmittance", "transmittance"}))
    values.set("MONOCHROME", 0);
  if (isSeldomLookup(fragment, values)) values.set("MONOCHROME", 0);
  if (values["HEIGHT"] == kOnlyLayer && values["LIGHT_KIND"] != 0) values.set("HEIGHT", kOneLayer);
  if (isOneOf(fragment, {"ambient", "lookupAmbient"})) // which no map blocks
    for (const char* name : {"SHADOW_VIEWS", "SHADOW_ARRAY", "FILTER_BILINEAR", "GLASS", "CURVES"})
      values.set(name, 0);
  if (values["HEIGHT"] != kNoLayers && !hasProgramsForOneLayer(fragment, values)) values.set("HEIGHT", kAnyLayers);
  if (values["HEIGHT"] == kAnyLayers && !isOneOf(fragment, {"unwarp", "unwarpEdges"})) values.set("MONOCHROME", 0);
  if (values["COUNT_VISITS"] != 0) { // which depend neither on colours nor on smoke
    values.set("MONOCHROME", 1);
    values.set("CURVES", 0);
  }
  // What maps and depth say of each other depends on neither filter nor glass; without a view nothing is looked up.
  if (isOneOf(fragment, {"checkInputs", "debugInputs"})) {
    values.set("FILTER_BILINEAR", 0);
    values.set("GLASS", 0);
  }
  // A point light is a spot with an open cone: to low rank, which has the cone in its factors, and where it is seldom.
  if (isSeldom(fragment, values) && values["LIGHT_KIND"] == 1) values.set("LIGHT_KIND", 2);
  if (isOneOf(fragment,
              {"exact", "fixup", "lookupLight", "march", "marchExtra", "pixelTree", "rowDepths", "tintGroups"}))
    chooseMaps(fragment, values);
  if (isMixture(values) && !isOfSunbeams(fragment, values)) values.set("MONOCHROME", 0);
  // Where light only changes its measure all lamps are alike.
  if (isOneOf(fragment,
              {"interpolate", "marks", "meanLight", "refine", "sliceErrors", "unwarp", "unwarpEdges", "tintGroups"}) &&
      values["LIGHT_KIND"] == 2)
    values.set("LIGHT_KIND", 1);
  // Epipolar textures hold one channel, or three.
  if (isOneOf(fragment, {"interpolate", "marks", "meanLight", "refine", "sliceErrors", "unwarp", "unwarpEdges"}) &&
      values["GLASS"] != 0) {
    values.set("GLASS", 0);
    values.set("MONOCHROME", 0);
  }
  if (isOneOf(fragment, {"marks"}) && values["LIGHT_KIND"] != 0)
    values.set("MONOCHROME", 0); // lamps' tell by ends alone
  if (values["MEAN_OF"] == 2)
    for (const char* name : {"LIGHT_KIND", "GLASS", "MONOCHROME"})
      values.set(name, 0);
  // Rows that hold splits, by the filter or by glass.
  if (isOneOf(fragment, {"pairTree", "changedParts"}) && values["GLASS"] != 0) {
    values.set("GLASS", 0);
    values.set("FILTER_BILINEAR", 1);
  }
  if (isOneOf(fragment, {"rowNodes"}) && values["GLASS"] != 0) values.set("FILTER_BILINEAR", 0);
  // Several views where one costs nothing more.
  if (isOneOf(fragment,
              {"pairTree", "changedParts", "changedSegments", "changedSlices", "curveCells", "rowNodes", "rowTree"}) &&
      values["SHADOW_VIEWS"] < 2)
    values.set("SHADOW_VIEWS", 2);
  // What is written is light, whatever epipolar textures hold: grey media save most where most is marched.
  if (isOneOf(fragment, {"fixup", "tintGroups"}) || (fragment == "passes/pixelTree.frag" && values["LOW_RANK"] != 0))
    values.set("MONOCHROME", 0);
  return definitions;
}

} // namespace tyndall
