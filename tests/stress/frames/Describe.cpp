// A random frame in words.
#include "Case.h"

#include <algorithm>
#include <fmt/format.h>

using namespace tyndall;

namespace stress {

namespace {

std::string textOf(const glm::dvec3& v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z); }
std::string textOf(const Rgb& v) { return textOf(glm::dvec3(v[0], v[1], v[2])); }

std::string textOf(const Light& light, const LightMaps& maps, const EyeFrame& eye) {
  constexpr const char* kKinds[] = {"sun", "point", "spot"};
  const glm::dvec3 fromEye = (reference::toVec3(light.position) - eye.position) * eye.axes;
  const glm::dvec3 direction = glm::normalize(reference::toVec3(light.direction)) * eye.axes;
  std::string text = fmt::format("{}: in view space at {}, towards {}, colour {}, range {:g}, cone {:g} to {:g}",
                                 kKinds[static_cast<int>(light.kind)], textOf(fromEye), textOf(direction),
                                 textOf(light.colour), light.range, light.innerConeAngle, light.outerConeAngle);
  text += fmt::format("{}{}\n", light.litOutsideViews ? "" : ", dark outside its views",
                      light.boundary.enabled ? ", boundary" : "");
  text += fmt::format("  map {} x {} x {}, layout {}, format {:#x}{}{}, clip depth {}, fade {:g}\n", maps.image.width,
                      maps.image.height, maps.image.layers, static_cast<int>(maps.layout), maps.format,
                      maps.isCompared ? ", compared" : "", maps.image.glassDepth.empty() ? "" : ", glass",
                      static_cast<int>(light.shadow.clipDepth), light.cascadeFade);
  return text;
}

} // namespace

std::string describe(const Case& made) {
  const Frame& frame = made.frame;
  const EyeFrame eye(frame.camera);
  const tests::DepthConvention& lens = made.lens.convention;
  std::string text =
      fmt::format("seed {}: {} x {} at ({}, {}); {}{}{}, size {:g}, shift ({:g}, {:g}), near {:g}, far {:g}; world "
                  "scale {:g}, eye {}\n",
                  made.seed, frame.viewport.width, frame.viewport.height, frame.viewport.x, frame.viewport.y,
                  lens.orthographic ? "orthographic" : "perspective", lens.reversed ? ", reversed" : "",
                  lens.infinite ? ", infinite" : "", made.lens.size, made.lens.shift.x, made.lens.shift.y, lens.near,
                  lens.far, made.worldScale, textOf(eye.position));
  const auto [low, high] = std::minmax_element(made.distances.begin(), made.distances.end());
  text += fmt::format("distances {:g} to {:g}; depth form {}; filter {}\n", *low, *high,
                      static_cast<int>(made.depthForm), static_cast<int>(frame.settings.shadowFilter));
  for (const Constituent& c : frame.medium.constituents)
    text += fmt::format("scattering {}, phase {}, g {:g}, layer {}\n", textOf(c.scattering), static_cast<int>(c.phase),
                        c.g, c.layer);
  for (const HeightLayer& layer : frame.medium.layers)
    text += fmt::format("layer of height {:g}, scale {:g}, ground {:g}; up {:g} {:g} {:g}; absorption's {}\n",
                        layer.height, layer.scale, layer.ground, frame.medium.up[0], frame.medium.up[1],
                        frame.medium.up[2], frame.medium.absorptionLayer);
  text += fmt::format("look-up {} x {} x {} from {:g} to {:g}\n", made.lookup.x, made.lookup.y, made.lookup.z,
                      made.lookupNear, made.lookupFar);
  text += fmt::format("before the eye {} x {} curves from {:g} to {:g}\n", made.eyeCurves.size, made.eyeCurves.size,
                      frame.eyeCurves.nearDistance, frame.eyeCurves.farDistance);
  text += fmt::format("of which {} is scattered, phase {}, g {:g}{}\n", textOf(frame.eyeCurves.albedo),
                      static_cast<int>(frame.eyeCurves.phase), frame.eyeCurves.g,
                      frame.eyeCurves.dimsBackground ? "; they dim the background" : "");
  text += fmt::format("ambient {}", textOf(frame.ambient.radiance));
  for (const Rgb& harmonic : frame.ambient.harmonics)
    text += " " + textOf(harmonic);
  text += "\n";
  text += fmt::format("absorption {}, far distance {:g}\n", textOf(frame.medium.absorption), frame.medium.farDistance);
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    text += textOf(frame.lights[i], made.maps[i], eye);
  return text + fmt::format("relation: {}\n", nameOf(made.relation));
}

} // namespace stress
