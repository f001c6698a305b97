// Colours of the debug views, and the bar along the bottom of the picture that shows their scale.

// From 0 to 1: black, blue, red, yellow, white.
vec3 heat(float t) {
  const vec3 kStops[5] = vec3[5](vec3(0.0), vec3(0.1, 0.1, 0.8), vec3(0.8, 0.05, 0.1), vec3(1.0, 0.8, 0.0), vec3(1.0));
  float at = 4.0 * clamp(t, 0.0, 1.0);
  int low = min(int(at), 3);
  return mix(kStops[low], kStops[low + 1], at - float(low));
}

// From -1 to 1: blue, grey, red.
vec3 signedColour(float t) {
  return mix(vec3(0.5), t < 0.0 ? vec3(0.0, 0.1, 1.0) : vec3(1.0, 0.1, 0.0), clamp(abs(t), 0.0, 1.0));
}

const float kOffBar = -1.0, kTick = -2.0;

// Position on the bar, from 0 to 1, or kTick between its parts and around it, or kOffBar. Small pictures have none.
float barPosition(vec2 p, vec2 size, int parts) {
  if (min(size.x, size.y) < 64.0) return kOffBar;
  vec2 low = floor(size * vec2(0.1, 0.04)), high = floor(size * vec2(0.9, 0.07)) + 2.0;
  if (any(lessThan(p, low - 1.0)) || any(greaterThan(p, high + 1.0))) return kOffBar;
  float t = (p.x - low.x) / (high.x - low.x), part = t * float(parts);
  bool onTick = abs(part - round(part)) * (high.x - low.x) < 0.75 * float(parts);
  return onTick || any(lessThan(p, low)) || any(greaterThan(p, high)) ? kTick : t;
}
