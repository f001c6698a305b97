// The medium: constituents with their phase functions, and how far one sees; light of the surroundings; fog.
#include "Panels.h"
#include "Widgets.h"

#include <cmath>
#include <viewer/core/Optics.h>

namespace viewer {

namespace {

constexpr float kPi = 3.14159265F;

/// Light comes from the left: forward is to the right. Radii by the logarithm over four powers of ten.
void drawPhase(const tyndall::Constituent& constituent) {
  constexpr float kDecades = 4;
  constexpr int kPoints = 96;
  const float width = ImGui::GetContentRegionAvail().x, height = 84;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 middle(corner.x + 0.5F * width, corner.y + 0.5F * height);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const double most = std::max(phaseOf(constituent, 1), phaseOf(constituent, -1));
  for (int ring = 1; ring <= 4; ++ring)
    list.AddCircle(middle, 0.5F * height * static_cast<float>(ring) / 4, IM_COL32(90, 90, 100, 255), 48);
  std::vector<ImVec2> points;
  for (int i = 0; i < kPoints; ++i) {
    const float theta = 2 * kPi * static_cast<float>(i) / kPoints;
    const auto share = static_cast<float>(std::log10(phaseOf(constituent, std::cos(theta)) / most));
    const float radius = 0.5F * height * std::max(0.0F, 1 + share / kDecades);
    points.emplace_back(middle.x + radius * std::cos(theta), middle.y - radius * std::sin(theta));
  }
  list.AddPolyline(points.data(), kPoints, IM_COL32(255, 210, 120, 255), ImDrawFlags_Closed, 1.5F);
  list.AddText(ImVec2(corner.x, middle.y - 0.5F * ImGui::GetFontSize()), IM_COL32(160, 160, 170, 255), "light ->");
  ImGui::Dummy(ImVec2(width, height));
  tooltip("The phase function by the angle to the light's direction: forward is to the right; rings are factors of 10");
}

std::string drawVisibility(tyndall::Medium& medium) {
  double visibility = visibilityOf(medium);
  const double low = 0.1, high = 1e6;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("visibility");
  ImGui::SameLine(0.42F * ImGui::GetContentRegionAvail().x);
  ImGui::SetNextItemWidth(-1);
  if (!std::isfinite(visibility)) {
    ImGui::TextDisabled("unlimited: clear air");
    return {};
  }
  const bool isChanged = ImGui::SliderScalar("##visibility", ImGuiDataType_Double, &visibility, &low, &high, "%.4g m",
                                             ImGuiSliderFlags_Logarithmic);
  tooltip(
      "where 2 % of the contrast is left, in world units, where the density of layers is 1; scales all coefficients");
  if (!isChanged) return {};
  medium = withVisibility(medium, visibility);
  return "visibility";
}

std::string drawConstituents(tyndall::Medium& medium) {
  std::string edited;
  for (std::size_t i = 0; i < medium.constituents.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::Separator();
    ImGui::Text("constituents[%d]", static_cast<int>(i));
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize("remove").x - 8);
    const bool isRemoved = ImGui::SmallButton("remove");
    tyndall::Constituent& constituent = medium.constituents[i];
    std::vector<std::string> hidden;
    if (medium.layers.empty()) hidden.emplace_back("layer");
    const bool hasG =
        constituent.phase == tyndall::Phase::HenyeyGreenstein || constituent.phase == tyndall::Phase::CornetteShanks;
    std::string field;
    if (!hasG) hidden.emplace_back("g");
    if (editRows(settings::constituentTable(), constituent, tyndall::Constituent(), field, hidden))
      edited = "constituents[" + std::to_string(i) + "]." + field;
    drawPhase(constituent);
    ImGui::PopID();
    if (!isRemoved) continue;
    medium.constituents.erase(medium.constituents.begin() + static_cast<std::ptrdiff_t>(i));
    return "remove";
  }
  return edited;
}

// What followed it is the same everywhere then.
void removeLayer(tyndall::Medium& medium, int removed) {
  medium.layers.erase(medium.layers.begin() + removed);
  const auto renumber = [&](int& layer) { layer = layer == removed ? -1 : layer > removed ? layer - 1 : layer; };
  renumber(medium.absorptionLayer);
  for (tyndall::Constituent& constituent : medium.constituents)
    renumber(constituent.layer);
}

std::string drawLayers(tyndall::Medium& medium) {
  std::string edited;
  for (std::size_t i = 0; i < medium.layers.size(); ++i) {
    ImGui::PushID(static_cast<int>(100 + i));
    ImGui::Separator();
    ImGui::Text("layers[%d]", static_cast<int>(i));
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize("remove").x - 8);
    const bool isRemoved = ImGui::SmallButton("remove");
    std::string field;
    if (editRows(settings::layerTable(), medium.layers[i], tyndall::HeightLayer(), field))
      edited = "layers[" + std::to_string(i) + "]." + field;
    ImGui::PopID();
    if (!isRemoved) continue;
    removeLayer(medium, static_cast<int>(i));
    return "remove";
  }
  return edited;
}

// The coefficients are for those who have a sky to take them from.
void drawAmbient(Viewer& viewer) {
  settings::State state = viewer.state();
  if (heading("Ambient light", !state.ambient)) {
    state.ambient.reset();
    return viewer.edit("reset ambient", state);
  }
  tyndall::Ambient ambient = state.ambient.value_or(viewer.sceneAmbient());
  const settings::Table<tyndall::Ambient>& table = settings::ambientTable();
  std::vector<std::string> harmonics;
  for (const auto& row : table.rows)
    if (row.field != "radiance") harmonics.push_back(row.field);
  std::string edited;
  editRows(table, ambient, tyndall::Ambient(), edited, harmonics);
  if (ImGui::TreeNode("by its side: spherical harmonics")) {
    editRows(table, ambient, tyndall::Ambient(), edited, {"radiance"});
    ImGui::TreePop();
  }
  if (edited.empty()) return;
  state.ambient = ambient;
  viewer.edit("ambient." + edited, state);
}

// Of a scene in which the effect lights banks of it, or smoke.
void drawFog(Viewer& viewer) {
  if (!viewer.lightsFog() && !viewer.state().fog) return;
  const settings::StateFog ofScene = viewer.fogOf(settings::State());
  settings::State state = viewer.state();
  if (heading("Fog", !state.fog)) {
    state.fog.reset();
    return viewer.edit("reset fog", state);
  }
  settings::StateFog fog = viewer.fogOf(state);
  const bool hasG = fog.scattering.phase == tyndall::Phase::HenyeyGreenstein ||
                    fog.scattering.phase == tyndall::Phase::CornetteShanks;
  std::string edited, field;
  if (editRows(settings::fogTable(), fog, ofScene, field,
               hasG ? std::vector<std::string>() : std::vector<std::string>{"g"}))
    edited = field;
  for (std::size_t i = 0; i < fog.banks.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::Separator();
    ImGui::Text("banks[%d]", static_cast<int>(i));
    const bool isEven = ofScene.banks[i].billows == glm::ivec3(0);
    if (editRows(settings::fogBankTable(), fog.banks[i], ofScene.banks[i], field,
                 isEven ? std::vector<std::string>{"clear", "seed"} : std::vector<std::string>()))
      edited = "banks[" + std::to_string(i) + "]." + field;
    ImGui::PopID();
  }
  if (edited.empty()) return;
  state.fog = fog;
  viewer.edit("fog." + edited, state);
}

void drawMedium(Viewer& viewer) {
  settings::State state = viewer.state();
  if (heading("Medium", !state.medium)) {
    state.medium.reset();
    return viewer.edit("reset medium", state);
  }
  tyndall::Medium medium = state.medium.value_or(viewer.sceneMedium());
  std::string edited = drawVisibility(medium), field;
  const std::vector<std::string> ofLayers = {"absorptionLayer", "up"};
  if (editRows(settings::mediumTable(), medium, tyndall::Medium(), field,
               medium.layers.empty() ? ofLayers : std::vector<std::string>()))
    edited = field;
  if (const std::string what = drawConstituents(medium); !what.empty()) edited = what;
  ImGui::BeginDisabled(medium.constituents.size() >= tyndall::kMaxConstituents);
  if (ImGui::SmallButton("add constituent")) {
    medium.constituents.push_back({{0.01F, 0.01F, 0.01F}, tyndall::Phase::Isotropic, 0});
    edited = "add";
  }
  ImGui::EndDisabled();
  if (const std::string what = drawLayers(medium); !what.empty()) edited = what;
  ImGui::BeginDisabled(medium.layers.size() >= tyndall::kMaxHeightLayers);
  ImGui::SameLine();
  if (ImGui::SmallButton("add layer")) {
    medium.layers.push_back({0, 10});
    edited = "add layer";
  }
  tooltip("a density that thins out with height: constituents and absorption follow it by its number");
  ImGui::EndDisabled();
  if (edited.empty()) return;
  state.medium = medium;
  viewer.edit("medium." + edited, state);
}

} // namespace

void drawMediumPanel(Session& session) {
  drawMedium(session.viewer);
  drawAmbient(session.viewer);
  drawFog(session.viewer);
}

} // namespace viewer
