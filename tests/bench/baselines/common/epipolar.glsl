// Epipolar lines as columns of a table: entry xy and exit xy in pixels. They leave through the part of the image's
// border that faces away from the epipole, evenly spaced along it. Sample j of n lies at j / (n - 1) of the way.
uniform sampler2D lines;  // lines x 1
uniform vec4 lineEpipole; // homogeneous pixel position, w: sign of its w
uniform vec4 lineBorder;  // low x, low y, high x, high y: through the outermost pixel centres
uniform vec4 lineArc;     // where the lines begin, length per line, perimeter; w: 1 if they surround the epipole
uniform vec2 gridSize;    // lines, samples

vec2 sampleAt(vec4 ends, int index) { return mix(ends.xy, ends.zw, float(index) / float(int(gridSize.y) - 1)); }

// The line through a pixel position as a real number. Its direction there is sign(w) (w p - e.xy).
float lineCoordinate(vec2 p) {
  vec2 d = lineEpipole.w * (lineEpipole.z * p - lineEpipole.xy);
  vec2 corner = mix(lineBorder.xy, lineBorder.zw, greaterThan(d, vec2(0.0)));
  vec2 reach = mix(vec2(3e38), (corner - p) / d, notEqual(d, vec2(0.0)));
  vec2 size = lineBorder.zw - lineBorder.xy;
  vec2 exit = clamp(p + d * min(min(reach.x, reach.y), 3e37), lineBorder.xy, lineBorder.zw) - lineBorder.xy;
  float onSides = d.x > 0.0 ? size.x + exit.y : 2.0 * size.x + size.y + (size.y - exit.y);
  float onEnds = d.y > 0.0 ? size.x + size.y + (size.x - exit.x) : exit.x;
  float along = (reach.x < reach.y ? onSides : onEnds) - lineArc.x;
  return (along < 0.0 ? along + lineArc.z : along) / lineArc.y - 0.5;
}

ivec2 linesAround(float coordinate) {
  int low = int(floor(coordinate));
  if (lineArc.w != 0.0) return ivec2((low + int(gridSize.x)) % int(gridSize.x), (low + 1 + int(gridSize.x)) % int(gridSize.x));
  return clamp(ivec2(low, low + 1), ivec2(0), ivec2(int(gridSize.x) - 1));
}
