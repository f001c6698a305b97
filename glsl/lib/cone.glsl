// A spot's cone along a camera ray: where the ray is inside, and the falloff there. Included by lamp.glsl.

// A ray in a cone's own coordinates, at t = s - foot: dot(axis, point - light) = axis.x + t axis.y and
// |cross(axis, point - light)|^2 = (along.x + t along.y)^2 + along.z^2, where nothing cancels.
struct ConeRay {
  vec2 axis;
  vec3 along;
  float axisDistance; // |det(light - eye, ray, axis)|
};

ConeRay coneRayOf(vec3 direction, vec3 footFromLight) {
  // Both crosses lie in the plane across the axis: in the direction of the second and across it.
  vec3 crossFoot = cross(lightDirection, footFromLight), crossSlope = cross(lightDirection, direction);
  float slope = length(crossSlope), axisDistance = dot(lightDirection, cross(crossFoot, crossSlope));
  vec3 along = vec3(length(crossFoot), 0.0, 0.0);
  if (slope > 0.0) {
    along.xy = vec2(dot(crossFoot, crossSlope) / slope, slope);
    // Next to parallel the second cross has a direction by rounding alone: whichever it is, the parts have to add up.
    along.z = slope < 1e-3 ? sqrt(max(dot(crossFoot, crossFoot) - along.x * along.x, 0.0)) : axisDistance / slope;
  }
  return ConeRay(vec2(dot(lightDirection, footFromLight), dot(lightDirection, direction)), along, axisDistance);
}

// The interval of t in which the ray is inside a cone (x: cosine >= 0, y: squared sine of its half angle):
// where b + t v >= c sqrt(t^2 + h^2). Squared, A t^2 + 2 b v t + C >= 0 with A = v^2 - c^2, C = b^2 - c^2 h^2 and
// b + t v >= 0; the convex cone meets the line in one interval, which the roots on the forward side bound. For narrow
// cones A, B and C come from the sines, in which nothing cancels; b^2 + h^2 A = h^2 sin^2 - axisDistance^2, where less cancels.
vec2 coneInterval(Airlight light, ConeRay ray, vec2 cosSinSquared) {
  const vec2 kNone = vec2(1.0, -1.0);
  const float kFar = 1e30;
  float b = ray.axis.x, v = ray.axis.y, c = cosSinSquared.x;
  if (c < 1e-4) { // a half-space: both nappes touch and the squared form has a double root; c < 0: a point light's open cone
    if (v == 0.0 || c < 0.0) return b > 0.0 || c < 0.0 ? vec2(-kFar, kFar) : kNone;
    return v > 0.0 ? vec2(-b / v, kFar) : vec2(-kFar, -b / v);
  }
  bool narrow = cosSinSquared.y < 0.5;
  float A = narrow ? cosSinSquared.y - ray.along.y * ray.along.y : v * v - c * c;
  float C = narrow ? cosSinSquared.y * light.height2 - (ray.along.x * ray.along.x + ray.along.z * ray.along.z)
                   : b * b - c * c * light.height2;
  // A ray through the lamp itself, as far as floats tell (the floors of airlightOf): its direction alone decides.
  if (light.height2 <= 1.01 * max(1e-13 * light.foot * light.foot, 1e-36)) return A < 0.0 ? kNone : v > 0.0 ? vec2(0.0, kFar) : vec2(-kFar, 0.0);
  float B = narrow ? -ray.along.x * ray.along.y : b * v;
  float discriminant = c * c * (cosSinSquared.y * light.height2 - ray.axisDistance * ray.axisDistance);
  if (!(discriminant > 0.0)) return kNone;
  // The stable pair of roots: q = -(B + sign(B) sqrt(D)), roots q / A and C / q.
  float q = -(B + (B < 0.0 ? -1.0 : 1.0) * sqrt(discriminant));
  float r0 = abs(A) > abs(q) * 1e-30 ? q / A : kFar * sign(q) * (A < 0.0 ? -1.0 : 1.0);
  float r1 = q != 0.0 ? C / q : 0.0;
  float low = min(r0, r1), high = max(r0, r1);
  // A >= 0: the ray's direction lies inside the double cone, each nappe is crossed once. Else both roots share a nappe.
  if (A >= 0.0) return v > 0.0 ? vec2(high, kFar) : vec2(-kFar, low);
  return b + 0.5 * (low + high) * v > 0.0 ? vec2(low, high) : kNone;
}

// Falloff of KHR_lights_punctual at t, r: ((cos - cos outer) / (cos inner - cos outer))^2 in [0, 1].
float coneFalloff(Airlight light, float t, float r) {
  if (falloffScale == 0.0) return 1.0; // a hard edge: the span ends at it
  vec2 edge = vec2(light.edge.x + t * light.edge.y, light.edge.z) / r;
  float difference = edge.x - outerCosine;
  if (outerSineSquared < 0.5) {
    float sineSquared = dot(edge, edge);
    difference = (outerSineSquared - sineSquared) / (sqrt(max(1.0 - sineSquared, 0.0)) + outerCosine);
  }
  float falloff = clamp(difference * falloffScale, 0.0, 1.0);
  return falloff * falloff;
}
