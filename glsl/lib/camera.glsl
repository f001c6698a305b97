// Camera rays from the engine's depth (DESIGN: rule 1; the matrices are composed in double on the CPU).

struct Ray {
  vec3 origin;    // eye, or the point on the near plane of an orthographic camera
  vec3 direction; // unit
};

// Window positions are in pixels, as gl_FragCoord.xy would be without the jitter; where it has moved a pixel from:
vec2 unjittered(vec2 pixel) { return pixel - jitter; }

// The ray through a window position.
Ray cameraRay(vec2 windowPosition) {
  vec2 p = windowPosition - 0.5 * vec2(frameSize);
  vec3 across = p.x * farPoint[1].xyz + p.y * farPoint[2].xyz;
  if (isOrthographic != 0) return Ray(across, normalize(-nearStep.xyz)); // the near plane's middle is the origin
  return Ray(vec3(0.0), normalize(farPoint[0].xyz + across));
}

// Of an orthographic camera's volume, from its near plane on: what lies before a depth value. Small shares keep their digits.
float depthShare(float depth) { return (1.0 - depthOffset) - depthScale * depth; }

// Distance along that ray to the surface of a depth value; the sky's where depth is at its far value, -1 where it is NaN.
float rayEnd(vec2 windowPosition, float depth) {
  float t = depthOffset + depthScale * depth;
  if (!(t > 0.0)) return t <= 0.0 ? skyEnd : -1.0;
  if (isOrthographic != 0) return max(0.0, depthShare(depth)) * length(nearStep.xyz);
  vec2 p = windowPosition - 0.5 * vec2(frameSize);
  vec4 far = farPoint[0] + p.x * farPoint[1] + p.y * farPoint[2];
  return length(far.xyz) / (far.w + t * nearStep.w);
}
