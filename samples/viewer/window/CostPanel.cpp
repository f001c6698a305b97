// What the effect costs, and what it errs.
#include "Panels.h"
#include "Widgets.h"

#include <algorithm>
#include <cmath>

namespace viewer {

namespace {

ImU32 colourOf(std::size_t index) {
  float r = 0, g = 0, b = 0;
  ImGui::ColorConvertHSVtoRGB(std::fmod(0.61F * static_cast<float>(index), 1.0F), 0.55F, 0.9F, r, g, b);
  return ImGui::ColorConvertFloat4ToU32(ImVec4(r, g, b, 1));
}

struct Pass {
  std::string name;
  double milliseconds = 0;
  std::string skipped; ///< why; empty if it ran
};

/// By their names, as they come; of all lights together, if so.
std::vector<Pass> passesOf(const tyndall::Statistics& statistics, bool areTogether) {
  std::vector<Pass> passes;
  for (const tyndall::PassStatistics& pass : statistics.passes) {
    std::string name = pass.name;
    const std::size_t digit = name.rfind("light ", 0) == 0 ? name.find(' ', 6) : std::string::npos;
    if (areTogether && digit != std::string::npos) name = name.substr(digit + 1);
    const auto same = std::find_if(passes.begin(), passes.end(), [&](const Pass& other) { return other.name == name; });
    if (same == passes.end() || !areTogether) {
      passes.push_back({name, pass.milliseconds, pass.skipped});
      continue;
    }
    same->milliseconds += pass.milliseconds;
    if (pass.skipped.empty()) same->skipped.clear();
  }
  return passes;
}

/// One bar, as wide as the panel, of all passes; then a line each.
void drawPasses(const tyndall::Statistics& statistics, bool& isEachLight) {
  const std::vector<Pass> passes = passesOf(statistics, !isEachLight);
  double sum = 0;
  for (const Pass& pass : passes)
    sum += pass.milliseconds;
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFrameHeight();
  ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const auto part = static_cast<float>(sum > 0 ? width * passes[i].milliseconds / sum : 0);
    list.AddRectFilled(corner, ImVec2(corner.x + part, corner.y + height), colourOf(i));
    corner.x += part;
  }
  ImGui::Dummy(ImVec2(width, height));
  ImGui::Checkbox("passes of each light", &isEachLight);
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const Pass& pass = passes[i];
    if (!pass.skipped.empty()) {
      ImGui::TextDisabled("  %s: skipped", pass.name.c_str());
      tooltip(pass.name + " is skipped: " + pass.skipped);
      continue;
    }
    ImGui::PushStyleColor(ImGuiCol_Text, colourOf(i));
    ImGui::TextUnformatted("#");
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::TextUnformatted(pass.name.c_str());
    ImGui::SameLine(0.7F * width);
    ImGui::Text("%8.2f ms", pass.milliseconds);
  }
}

void drawErrors(const char* name, const Errors& errors) {
  ImGui::Text("%s rRMSE %.3g %%  p99 %.3g %%", name, 100 * errors.rRmse, 100 * errors.p99);
  tooltip("of the inscatter, against technique exact, over its mean");
}

void drawError(Viewer& viewer) {
  ImGui::Separator();
  ImGui::TextUnformatted("Error against Exact");
  ImGui::SameLine();
  ImGui::Checkbox("measure at rest", &viewer.measuresErrors);
  const ErrorMeter& meter = viewer.meter();
  if (meter.errors().empty()) return ImGui::TextDisabled("not known");
  ImGui::ProgressBar(static_cast<float>(meter.share()), ImVec2(-1, 0), meter.isComplete() ? "complete" : nullptr);
  drawErrors(viewer.second() ? "A" : "", meter.errors()[0]);
  if (viewer.second() && meter.errors().size() > 1) drawErrors("B", meter.errors()[1]);
}

void drawTimes(const FrameTimes& times) {
  ImGui::Separator();
  ImGui::Text("Frame times: median %.0f ms, 95 %% %.0f ms", static_cast<double>(times.quantile(0.5)),
              static_cast<double>(times.quantile(0.95)));
  if (times.times().empty()) return;
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size(ImGui::GetContentRegionAvail().x, 48);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, ImVec2(corner.x + size.x, corner.y + size.y), IM_COL32(40, 44, 52, 255));
  const float most = 1.2F * times.quantile(1), step = size.x / static_cast<float>(FrameTimes::kMost);
  for (std::size_t i = 0; i < times.times().size(); ++i) {
    const float left = corner.x + step * static_cast<float>(i), height = size.y * times.times()[i] / most;
    list.AddRectFilled(ImVec2(left, corner.y + size.y - height), ImVec2(left + step, corner.y + size.y),
                       times.hasCompiled(i) ? IM_COL32(240, 120, 60, 255) : IM_COL32(120, 180, 240, 255));
  }
  ImGui::Dummy(size);
  tooltip("each bar a frame while something moved; orange: the driver compiled shaders meanwhile");
}

} // namespace

void drawCostPanel(Session& session) {
  Viewer& viewer = session.viewer;
  if (!viewer.scene() || viewer.first().width() == 0) return ImGui::TextDisabled("no picture yet");
  double target = viewer.quality.target();
  const double low = 5, high = 500;
  ImGui::SetNextItemWidth(-1);
  if (ImGui::SliderScalar("##target", ImGuiDataType_Double, &target, &low, &high, "%.0f ms a frame while things move",
                          ImGuiSliderFlags_Logarithmic))
    viewer.quality.setTarget(std::clamp(target, low, high));
  const tyndall::Statistics& statistics = viewer.first().statistics();
  ImGui::Text("%dx%d, %s", viewer.first().width(), viewer.first().height(),
              viewer.isSettled() ? "at full quality" : "adapted");
  ImGui::Text("maps and surfaces %.1f ms, effect %.1f ms", viewer.sceneMilliseconds(), viewer.first().milliseconds());
  drawPasses(statistics, session.isEachLight);
  ImGui::TextWrapped("%.1f MiB, %llu samples marched, %llu fix-up pixels",
                     static_cast<double>(statistics.bytes) / (1 << 20),
                     static_cast<unsigned long long>(statistics.marchedSamples),
                     static_cast<unsigned long long>(statistics.fixupPixels));
  ImGui::Text("redrawn %.0f %%, %d programs", 100 * statistics.redrawnShare, statistics.compiledPrograms);
  drawError(viewer);
  drawTimes(viewer.frameTimes());
  for (const std::string& warning : statistics.warnings)
    ImGui::TextWrapped("warning: %s", warning.c_str());
  for (const std::string& note : viewer.notes())
    ImGui::TextWrapped("note: %s", note.c_str());
}

} // namespace viewer
