// The light of a span of a segment whose visibility is that of a line, with the view's share of it and what smoke and hair let through
// (DESIGN 1). Included by shadow.glsl.

// The same times the view's share there.
void addShared(Airlight light, ViewSegment segment, float s0, float s1, Visibility mean, Visibility moment, inout Light sum) {
#if FADES
  // Visibility and share as lines a + b t on [-1, 1]; the mean of t squared is a third.
  float scale = (segment.share.y - segment.share.x) / max(segment.s1 - segment.s0, 1e-30);
  float middle = segment.share.x + scale * (0.5 * (s0 + s1) - segment.s0), slope = 0.5 * scale * (s1 - s0);
  Visibility inShare = mean * middle + moment * slope;
  moment = moment * middle + mean * (slope / 3.0);
  mean = inShare;
#endif
  addSeen(light, s0, s1, mean, moment, sum);
}

// The line parameter at a distance along the camera ray: the inverse of distanceAt.
float parameterAt(ViewSegment segment, float s) {
  float f = (s - segment.s0) / max(segment.s1 - segment.s0, 1e-30);
  return f >= 1.0 ? 1.0 : f / (segment.weight * (1.0 - f) + f);
}

#if CURVES
#include "lib/curves.glsl"
#endif

// The same from line parameter u0 to u1 of a segment, behind the smoke and hair that dim the light.
void addSpan(Airlight light, ViewSegment segment, float u0, float u1, Visibility mean, Visibility moment, inout Light sum) {
#if CURVES
  addCurved(light, segment, u0, u1, mean, moment, sum);
#else
  addShared(light, segment, distanceAt(segment, u0), distanceAt(segment, u1), mean, moment, sum);
#endif
}
