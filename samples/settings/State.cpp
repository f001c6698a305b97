#include "State.h"
#include "Tables.h"

#include <algorithm>
#include <fmt/format.h>

namespace settings {

std::string contradictionIn(const tyndall::Medium& medium) {
  const auto layers = static_cast<int>(medium.layers.size());
  if (medium.absorptionLayer >= layers)
    return fmt::format("absorptionLayer: {} must be one of its {} layers, or -1", medium.absorptionLayer, layers);
  for (std::size_t i = 0; i < medium.constituents.size(); ++i)
    if (medium.constituents[i].layer >= layers)
      return fmt::format("constituents[{}].layer: {} must be one of its {} layers, or -1", i,
                         medium.constituents[i].layer, layers);
  return {};
}

std::string contradictionIn(const State& state) {
  using tyndall::DebugView;
  using tyndall::Technique;
  if (state.lookAt && state.lookAt->eye == state.lookAt->target) return "camera.target: must differ from camera.eye";
  for (std::size_t i = 0; i < state.path.size(); ++i) {
    const LookAt& view = state.path[i].view;
    if (view.eye == view.target) return fmt::format("path[{}].target: must differ from its eye", i);
    if (i > 0 && state.path[i].seconds < state.path[i - 1].seconds)
      return fmt::format("path[{}].seconds: {} must not be before the point before it", i, state.path[i].seconds);
  }
  if (std::max(renderedWidth(state), renderedHeight(state)) > tyndall::kMaxImageSize)
    return fmt::format("picture.supersample: {} makes more than {} pixels a side", state.supersample,
                       tyndall::kMaxImageSize);
  for (std::size_t i = 0; state.lights && i < state.lights->size(); ++i) {
    const tyndall::Light& light = (*state.lights)[i].light;
    if (light.innerConeAngle > light.outerConeAngle)
      return fmt::format("lights[{}].innerConeAngle: {} must not exceed outerConeAngle, {}", i, light.innerConeAngle,
                         light.outerConeAngle);
  }
  const std::string inMedium = state.medium ? contradictionIn(*state.medium) : "";
  if (!inMedium.empty()) return "medium." + inMedium;
  return {};
}

namespace {

/// The first field that breaks its rule.
template <typename Owner>
std::string breachIn(const std::string& where, const Table<Owner>& table, const Owner& owner) {
  for (const Setting<Owner>& row : table.rows)
    if (const std::string breach = breachOf(row, row.get(owner)); !breach.empty())
      return fmt::format("{}.{}: {} {}", where, row.field, textOf(row, row.get(owner)), breach);
  return {};
}

std::string breachIn(const tyndall::Medium& medium) {
  std::string breach = breachIn("medium", mediumTable(), medium);
  for (std::size_t i = 0; i < medium.constituents.size() && breach.empty(); ++i)
    breach = breachIn(fmt::format("medium.constituents[{}]", i), constituentTable(), medium.constituents[i]);
  for (std::size_t i = 0; i < medium.layers.size() && breach.empty(); ++i)
    breach = breachIn(fmt::format("medium.layers[{}]", i), layerTable(), medium.layers[i]);
  return breach;
}

std::string breachIn(const State& state) {
  std::string breach;
  visitTables(state, [&](const char* name, const auto& part, const auto& table) {
    if (breach.empty()) breach = breachIn(name, table, part);
  });
  if (breach.empty() && state.lookAt) breach = breachIn("camera", lookAtTable(), *state.lookAt);
  if (breach.empty() && state.medium) breach = breachIn(*state.medium);
  if (breach.empty() && state.ambient) breach = breachIn("ambient", ambientTable(), *state.ambient);
  if (breach.empty() && state.fog) breach = breachIn("fog", fogTable(), *state.fog);
  for (std::size_t i = 0; state.fog && i < state.fog->banks.size() && breach.empty(); ++i)
    breach = breachIn(fmt::format("fog.banks[{}]", i), fogBankTable(), state.fog->banks[i]);
  for (std::size_t i = 0; state.lights && i < state.lights->size() && breach.empty(); ++i)
    breach = breachIn(fmt::format("lights[{}]", i), lightTable(), (*state.lights)[i]);
  if (breach.empty() && state.compared)
    breach = breachIn("compared.settings", settingsTable(), state.compared->settings);
  for (std::size_t i = 0; i < state.path.size() && breach.empty(); ++i)
    breach = breachIn(fmt::format("path[{}]", i), pathTable(), state.path[i]);
  return breach;
}

} // namespace

std::string problemIn(const State& state) {
  const std::string breach = breachIn(state);
  return breach.empty() ? contradictionIn(state) : breach;
}

std::vector<StateLight> placed(std::vector<StateLight> lights, const std::vector<tyndall::Light>& scene) {
  for (StateLight& light : lights) {
    if (light.follows < 0 || static_cast<std::size_t>(light.follows) >= scene.size()) continue;
    const tyndall::Light& followed = scene[static_cast<std::size_t>(light.follows)];
    light.light.position = followed.position;
    light.light.direction = followed.direction;
  }
  return lights;
}

std::vector<tyndall::Light> lightsOf(const std::vector<StateLight>& lights, const std::vector<tyndall::Light>& scene) {
  std::vector<tyndall::Light> shining;
  for (const StateLight& one : placed(lights, scene)) {
    if (!one.on) continue;
    shining.push_back(one.light);
    if (one.light.kind == tyndall::LightKind::Directional) continue; // which alone has these
    shining.back().cascadeFade = 0;
    shining.back().boundary.enabled = false;
  }
  return shining;
}

std::vector<StateLight> following(const std::vector<tyndall::Light>& scene) {
  std::vector<StateLight> lights;
  for (const tyndall::Light& light : scene) {
    lights.push_back({true, static_cast<int>(lights.size()), light});
    lights.back().light.shadow = {};
    lights.back().light.glass = {};
    lights.back().light.curves = {};
  }
  return lights;
}

} // namespace settings
