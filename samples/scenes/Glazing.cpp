#include "Glazing.h"

#include "Random.h"
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace scenes {
namespace {

constexpr double kLeadWidth = 0.028;
constexpr double kLeadDepth = 0.02;
/// How far the panes reach into the stone, metres.
constexpr double kRebate = 0.02;

struct Box {
  glm::dvec2 low;
  glm::dvec2 high;
};

Box boundsOf(const Outline& outline) {
  Box box{outline[0], outline[0]};
  for (const glm::dvec2& p : outline) {
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  }
  return box;
}

int one(const std::vector<int>& materials, int x, int y, int seed) {
  return materials[static_cast<std::size_t>(hashOf(x, y, seed) * static_cast<double>(materials.size()))];
}

/// The pane of a column (0..3) and a row: a border of two alternating colours round a field of medallions.
int paneColour(const Glass& glass, int column, int row, int seed) {
  const bool redField = seed % 2 == 0;
  const std::vector<int>& field = redField ? glass.reds : glass.blues;
  const std::vector<int>& border = redField ? glass.blues : glass.reds;
  if (column == 0 || column == 3) return one(row % 2 == 0 ? border : glass.golds, 0, row % 2, seed);
  const int beat = row % 4;
  if (beat == 0) return one(glass.golds, column, row, seed);
  if (beat == 2) return one(border, column, row, seed);
  return hashOf(column, row, seed) < 0.25 ? one(glass.greens, column, row, seed + 1) : one(field, column, row, seed);
}

/// A lead line along x = at (axis 0) or y = at (axis 1), cut to the outline.
void leadLine(MeshBuilder& mesh, const Outline& outline, int axis, double at, double z) {
  std::vector<double> cuts;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2& a = outline[i];
    const glm::dvec2& b = outline[(i + 1) % outline.size()];
    if ((a[axis] < at) == (b[axis] < at)) continue;
    cuts.push_back(a[1 - axis] + (b[1 - axis] - a[1 - axis]) * (at - a[axis]) / (b[axis] - a[axis]));
  }
  if (cuts.size() != 2) return;
  glm::dvec3 from(0, 0, z);
  from[axis] = at;
  glm::dvec3 to = from;
  from[1 - axis] = cuts[0];
  to[1 - axis] = cuts[1];
  mesh.bar({from, to}, {0, 0, 1}, kLeadWidth, kLeadDepth);
}

} // namespace

Glass addGlass(Scene& scene) {
  const auto pane = [&](const char* name, const glm::dvec3& colour) {
    return scene.add({name, colour, glm::dvec3(0), true, true});
  };
  Glass glass;
  glass.reds = {pane("ruby glass", {0.80, 0.02, 0.03}), pane("rose glass", {0.85, 0.10, 0.22})};
  glass.blues = {pane("cobalt glass", {0.02, 0.06, 0.80}), pane("azure glass", {0.05, 0.30, 0.85}),
                 pane("violet glass", {0.30, 0.04, 0.62})};
  glass.golds = {pane("gold glass", {0.95, 0.55, 0.05}), pane("amber glass", {0.90, 0.30, 0.02})};
  glass.greens = {pane("emerald glass", {0.03, 0.55, 0.10}), pane("turquoise glass", {0.05, 0.60, 0.50})};
  glass.lead = scene.add({"lead", {0.03, 0.03, 0.035}});
  return glass;
}

void glazeLancet(MeshBuilder& mesh, const Glass& glass, const Outline& outline, double z, int seed) {
  const Box box = boundsOf(outline);
  const glm::dvec2 centre = 0.5 * (box.low + box.high);
  const glm::dvec2 half = 0.5 * (box.high - box.low);
  Outline sheet;
  for (const glm::dvec2& p : outline)
    sheet.push_back(centre + (p - centre) * (1.0 + kRebate / half));
  const int rows = std::max(4, static_cast<int>(std::lround(2 * half.y / 0.36)));
  const double columns[5] = {-2, -0.66, 0, 0.66, 2};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < rows; ++row) {
      const double low = row == 0 ? box.low.y - 1 : box.low.y + 2 * half.y * row / rows;
      const double high = row + 1 == rows ? box.high.y + 1 : box.low.y + 2 * half.y * (row + 1) / rows;
      Outline pane = clip(clip(sheet, {0, 1}, high), {0, -1}, -low);
      pane = clip(clip(pane, {1, 0}, centre.x + columns[column + 1] * half.x), {-1, 0},
                  -(centre.x + columns[column] * half.x));
      if (pane.size() < 3) continue;
      mesh.material(paneColour(glass, column, row, seed)).polygon(atDepth(pane, z));
    }
  mesh.material(glass.lead);
  for (int column = 1; column < 4; ++column)
    leadLine(mesh, outline, 0, centre.x + columns[column] * half.x, z);
  for (int row = 1; row < rows; ++row)
    leadLine(mesh, outline, 1, box.low.y + 2 * half.y * row / rows, z);
  mesh.bar(atDepth(outline, z), {0, 0, 1}, 2 * kLeadWidth, kLeadDepth, true);
}

void glazeRose(MeshBuilder& mesh, const Glass& glass, const glm::dvec2& centre, double radius, int petals, double z) {
  constexpr int kArcs = 4; // straight edges a petal
  const double radii[5] = {0.17 * radius, 0.4 * radius, 0.62 * radius, 0.76 * radius, radius + kRebate};
  const int steps = petals * kArcs;
  const auto at = [&](double r, int step) {
    const double angle = glm::two_pi<double>() * (step % steps) / steps;
    return glm::dvec3(centre + r * glm::dvec2(std::cos(angle), std::sin(angle)), z);
  };
  for (int step = 0; step < steps; ++step) {
    const int petal = (step + kArcs / 2) / kArcs % petals;
    const int half = step / (kArcs / 2);
    mesh.material(one(glass.golds, petal % 2, 0, 3))
        .polygon({glm::dvec3(centre, z), at(radii[0], step), at(radii[0], step + 1)});
    const int colours[4] = {
        petal % 2 == 0 ? glass.reds[0] : glass.blues[1], petal % 2 == 0 ? glass.blues[0] : glass.reds[0],
        half % 2 == 0 ? glass.golds[0] : glass.greens[1], half % 4 < 2 ? glass.blues[0] : glass.reds[1]};
    for (int ring = 0; ring < 4; ++ring)
      mesh.material(colours[ring])
          .quad(at(radii[ring], step), at(radii[ring + 1], step), at(radii[ring + 1], step + 1),
                at(radii[ring], step + 1));
  }
  mesh.material(glass.lead);
  for (int ring = 0; ring < 5; ++ring) {
    std::vector<glm::dvec3> circle;
    circle.reserve(static_cast<std::size_t>(steps));
    for (int step = 0; step < steps; ++step)
      circle.push_back(at(std::min(radii[ring], radius), step));
    mesh.bar(circle, {0, 0, 1}, (ring == 4 ? 2 : 1) * kLeadWidth, kLeadDepth, true);
  }
  for (int half = 0; half < 2 * petals; ++half)
    mesh.bar({at(half % 2 == 0 ? radii[2] : radii[0], half * kArcs / 2), at(radius, half * kArcs / 2)}, {0, 0, 1},
             kLeadWidth, kLeadDepth);
}

} // namespace scenes
