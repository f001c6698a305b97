// As many steps as the ray crosses shadow texels along the axis that it moves faster on.
Light texelSteppedLight(Ray ray, float end) {
#if SHADOW_VIEWS == 1
  ViewLine line = viewLine(0, ray);
  float from = 0.0, to = min(end, visibleEnd);
  clipToSides(line, from, to);
  vec4 a = line.origin + from * line.slope, b = line.origin + max(from, to) * line.slope;
  vec2 extent = abs(b.xy / b.w - a.xy / a.w);
  return steppedLight(ray, end, clamp(int(ceil(max(extent.x, extent.y))), 1, 20000), 0.5);
#else
  return steppedLight(ray, end, 1, 0.5);
#endif
}
