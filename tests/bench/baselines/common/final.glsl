// The last pass of a technique: as the two sources of dual-source blending (COMPOSITE 1), or into two targets.

#if COMPOSITE
layout(location = 0, index = 0) out vec4 outInscatter;
layout(location = 0, index = 1) out vec4 outTransmittance;
#else
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
#endif

void writeFinal(vec3 inscatter, float end) {
  outInscatter = vec4(min(inscatter, vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(exp(-extinction * end), 1.0);
}
