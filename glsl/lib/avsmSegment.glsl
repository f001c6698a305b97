// What of a segment is in the map; once in a shader that has both avsmCapture and avsmInsert.
#ifndef TYNDALL_SEGMENT
#define TYNDALL_SEGMENT

// Entry, exit and transmittance of what lies between the near and the far plane of a segment of an even medium, at the arguments of
// tyndallCapture(); false if it dims nothing there or is not a finite number. No value is a negative 0.
bool tyndallSegment(float entry, float exit, float transmittance, out vec3 segment) {
  segment = vec3(0.0, 0.0, 1.0);
  const float most = 1e37; // so that the difference of two is finite
  if (!(abs(entry) <= most) || !(abs(exit) <= most) || isnan(transmittance)) return false;
  float near = min(entry, exit), far = max(entry, exit), passed = transmittance > 0.0 ? min(transmittance, 1.0) : 0.0;
  if (near > 1.0) return false;
  if (far > 1.0) passed = near < 1.0 ? pow(passed, (1.0 - near) / (far - near)) : 1.0;
  segment = vec3(near > 0.0 ? near : 0.0, far > 0.0 ? min(far, 1.0) : 0.0, passed);
  return passed < 1.0;
}

#endif
