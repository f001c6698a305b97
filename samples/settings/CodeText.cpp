#include "CodeText.h"
#include "Tables.h"

#include <cmath>
#include <fmt/format.h>

namespace settings {

namespace {

std::string numberCode(double number, bool isFloat) {
  if (std::isinf(number))
    return (number < 0 ? "-" : "") +
           std::string(isFloat ? "std::numeric_limits<float>::infinity()" : "tyndall::kInfinity");
  std::string text = textOf(number, isFloat);
  if (!isFloat) return text;
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "F";
}

std::string valueCode(const Row& row, const Value& value) {
  if (row.type == Type::Switch) return value[0] != 0 ? "true" : "false";
  if (row.type == Type::Choice)
    for (const Choice& choice : row.choices)
      if (choice.value == value[0]) return "tyndall::" + row.enumeration + "::" + choice.enumerator;
  if (value.count == 1) return numberCode(value[0], row.isFloat);
  return fmt::format("{{{}, {}, {}}}", numberCode(value[0], row.isFloat), numberCode(value[1], row.isFloat),
                     numberCode(value[2], row.isFloat));
}

void addMatrix(std::string& code, const std::string& field, const tyndall::Mat4& matrix) {
  if (matrix == tyndall::kIdentity) return;
  code += "  " + field + " = {";
  for (std::size_t i = 0; i < matrix.size(); ++i)
    code += (i == 0 ? "" : i % 4 == 0 ? ",\n      " : ", ") + numberCode(matrix[i], false);
  code += "};\n";
}

/// Lines for what differs from `before`.
template <typename Owner>
void addFields(std::string& code, const std::string& object, const Table<Owner>& table, const Owner& now,
               const Owner& before = {}) {
  for (const Setting<Owner>& row : table.rows)
    if (row.get(now) != row.get(before))
      code += fmt::format("  {}.{} = {};\n", object, row.field, valueCode(row, row.get(now)));
}

void addCamera(std::string& code, const tyndall::Camera& camera) {
  addMatrix(code, "frame.camera.viewFromWorld", camera.viewFromWorld);
  addMatrix(code, "frame.camera.clipFromView", camera.clipFromView);
  if (camera.clipDepth == tyndall::ClipDepth::ZeroToOne)
    code += "  frame.camera.clipDepth = tyndall::ClipDepth::ZeroToOne;\n";
  if (camera.jitter[0] != 0 || camera.jitter[1] != 0)
    code += fmt::format("  frame.camera.jitter = {{{}, {}}};\n", camera.jitter[0], camera.jitter[1]);
}

void addShadow(std::string& code, const tyndall::Light& light, std::size_t index) {
  if (light.shadow.texture == 0) return;
  code += fmt::format("  light.shadow.texture = textures.shadows[{}];\n", index);
  if (light.shadow.array) code += "  light.shadow.array = true;\n";
  if (light.shadow.clipDepth == tyndall::ClipDepth::ZeroToOne)
    code += "  light.shadow.clipDepth = tyndall::ClipDepth::ZeroToOne;\n";
  if (!light.shadow.views.empty()) code += fmt::format("  light.shadow.views.resize({});\n", light.shadow.views.size());
  for (std::size_t i = 0; i < light.shadow.views.size(); ++i) {
    const std::string view = fmt::format("light.shadow.views[{}]", i);
    addMatrix(code, view + ".clipFromWorld", light.shadow.views[i].clipFromWorld);
    if (light.shadow.views[i].layer != 0) code += fmt::format("  {}.layer = {};\n", view, light.shadow.views[i].layer);
  }
  if (light.glass.colour == 0) return;
  code += fmt::format("  light.glass.colour = textures.glassColours[{}];\n", index);
  code += fmt::format("  light.glass.depth = textures.glassDepths[{}];\n", index);
}

std::string lightCode(const tyndall::Light& light, std::size_t index) {
  std::string code = fmt::format("tyndall::Light chosenLight{}([[maybe_unused]] const Textures& textures) {{\n", index);
  code += "  tyndall::Light light;\n";
  Table<StateLight> table = lightTable();
  table.rows.erase(table.rows.begin(), table.rows.begin() + 2); // on and follows, which are not the effect's
  addFields(code, "light", table, StateLight{true, -1, light});
  addShadow(code, light, index);
  return code + "  return light;\n}\n\n";
}

void addMedium(std::string& code, const tyndall::Medium& medium) {
  addFields(code, "frame.medium", mediumTable(), medium);
  if (!medium.layers.empty()) code += fmt::format("  frame.medium.layers.resize({});\n", medium.layers.size());
  for (std::size_t i = 0; i < medium.layers.size(); ++i)
    addFields(code, fmt::format("frame.medium.layers[{}]", i), layerTable(), medium.layers[i]);
  if (medium.constituents.empty()) return;
  code += fmt::format("  frame.medium.constituents.resize({});\n", medium.constituents.size());
  for (std::size_t i = 0; i < medium.constituents.size(); ++i)
    addFields(code, fmt::format("frame.medium.constituents[{}]", i), constituentTable(), medium.constituents[i]);
}

std::string frameCode(const tyndall::Frame& frame) {
  std::string code = "tyndall::Frame chosenFrame(const Textures& textures) {\n  tyndall::Frame frame;\n";
  code += fmt::format("  frame.viewport.width = {};\n  frame.viewport.height = {};\n", frame.viewport.width,
                      frame.viewport.height);
  code += "  frame.colour = textures.colour;\n  frame.depth.texture = textures.depth;\n";
  if (frame.depth.multisampled) code += "  frame.depth.multisampled = true;\n";
  addCamera(code, frame.camera);
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    code += fmt::format("  frame.lights.push_back(chosenLight{}(textures));\n", i);
  addMedium(code, frame.medium);
  addFields(code, "frame.ambient", ambientTable(), frame.ambient);
  const tyndall::EyeCurves &curves = frame.eyeCurves, clear; // what the curves hold is the engine's
  const auto scatteredBy = [](const tyndall::EyeCurves& eye) { return StateFog{{eye.albedo, eye.phase, eye.g}, {}}; };
  addFields(code, "frame.eyeCurves", fogTable(), scatteredBy(curves), scatteredBy(clear));
  if (curves.dimsBackground) code += "  frame.eyeCurves.dimsBackground = true;\n";
  addFields(code, "frame.settings", settingsTable(), frame.settings);
  addFields(code, "frame.reuse", reuseTable(), frame.reuse);
  return code + "  return frame;\n}\n";
}

constexpr const char* kHead =
    R"(// What Tyndall's viewer showed. Matrices are those of its picture: an engine has its own in every frame.
#include <limits>
#include <tyndall/tyndall.h>
#include <vector>

namespace {

/// The engine's, by their names in OpenGL; of maps one for each light.
struct Textures {
  std::uint32_t colour = 0, depth = 0;
  std::vector<std::uint32_t> shadows, glassColours, glassDepths;
};

)";

} // namespace

std::string codeOf(const tyndall::Frame& frame, const tyndall::Tuning& tuning) {
  std::string code = kHead;
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    code += lightCode(frame.lights[i], i);
  code += "} // namespace\n\n/// For Config::tuning.\ntyndall::Tuning chosenTuning();\n";
  code += "tyndall::Frame chosenFrame(const Textures& textures);\n\n";
  code += "tyndall::Tuning chosenTuning() {\n  tyndall::Tuning tuning;\n";
  addFields(code, "tuning", tuningTable(), tuning);
  return code + "  return tuning;\n}\n\n" + frameCode(frame);
}

} // namespace settings
