// Curve cells: where smoke and hair begin and end along each slice's row in the map of their curves, cell by cell along the row's
// main axis, and what passes behind them (lib/curves.glsl). Reads the slice table and curves. Writes curveCells: cells x rows,
// RGBA32F: first depth, last depth, transmittance behind it.
#define CURVES_ALONE
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/rows.glsl"

struct ViewSegment {
  int view;
  vec3 p0, p1;
};

#include "lib/curveNodes.glsl"
#include "lib/curves.glsl"

layout(location = 0) out vec4 outEnds;

void main() {
  int cell = int(gl_FragCoord.x), view = viewOfRow(int(gl_FragCoord.y));
  vec4 row = rowLine(view, sliceOfRow(int(gl_FragCoord.y)));
  vec2 scale = float(curvesSize) / vec2(shadowViews[view].size), origin = row.xy * scale, step = row.zw * scale;
  bool alongX = isAlongX(row), mirrored = (alongX ? step.x : step.y) < 0.0;
  if (!alongX) {
    origin = origin.yx;
    step = step.yx;
  }
  float main = mirrored ? float(curvesSize) - float(cell) - 0.5 : float(cell) + 0.5;
  float across = origin.y + step.y * (step.x != 0.0 ? (main - origin.x) / step.x : 0.0);
  outEnds = vec4(cellEnds(alongX, mirrored, view, cell, clamp(across, 0.0, float(curvesSize))), 0.0);
}
