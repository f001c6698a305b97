// Look-up of the light that the effect adds before a point, and of what the medium leaves of what is behind (Frame::lookup,
// tyndall/tyndall.h), for what is drawn after the effect: particles, panes, leaves. Include it in any shader of #version 330 or later, or 320 es
// with precision highp for float and sampler2DArray. The frame has both textures. A surface of radiance C and opacity a becomes
//   TyndallShafts shafts = tyndallShafts(gl_FragCoord.xy, length(pointInView));
//   colour = vec4(C * shafts.transmittance + shafts.inscatter, a);
// where it is blended over the picture by a, since that has its shafts already. Premultiplied, C a instead of C, shafts.inscatter takes a, too; what
// is added (sparks) leaves it out.

uniform sampler2DArray tyndallInscatter;     // Lookup::inscatter and
uniform sampler2DArray tyndallTransmittance; // Lookup::transmittance, both GL_LINEAR, without mipmaps, clamped to their edges
uniform vec4 tyndallViewport;                // Frame::viewport: x, y, width, height
uniform vec2 tyndallDistances;               // Lookup::nearDistance and farDistance

struct TyndallShafts {
  vec3 inscatter, transmittance;
};

// windowPosition: as gl_FragCoord.xy. away: from the eye, world units; orthographic, from the near plane. Between two layers light grows
// by a line; nearer than the first from nothing on; what is farther than the last has the last's.
TyndallShafts tyndallShafts(vec2 windowPosition, float away) {
  vec2 place = (windowPosition - tyndallViewport.xy) / tyndallViewport.zw;
  float last = float(textureSize(tyndallInscatter, 0).z - 1);
  float growth = log2(tyndallDistances.y / tyndallDistances.x) / last, near = tyndallDistances.x;
  float low = clamp(floor(log2(max(away, near) / near) / growth), 0.0, last - 1.0);
  float begin = near * exp2(growth * low), end = near * exp2(growth * (low + 1.0));
  vec3 inscatter = textureLod(tyndallInscatter, vec3(place, low), 0.0).rgb, transmittance = textureLod(tyndallTransmittance, vec3(place, low), 0.0).rgb;
  if (away <= near) {
    float share = clamp(away / near, 0.0, 1.0);
    return TyndallShafts(share * inscatter, mix(vec3(1.0), transmittance, share));
  }
  float share = clamp((away - begin) / (end - begin), 0.0, 1.0);
  return TyndallShafts(mix(inscatter, textureLod(tyndallInscatter, vec3(place, low + 1.0), 0.0).rgb, share),
                       mix(transmittance, textureLod(tyndallTransmittance, vec3(place, low + 1.0), 0.0).rgb, share));
}
