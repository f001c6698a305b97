// What a pass of light writes: inscatter and transmittance as the two sources of dual-source blending, of which the second
// counts only where it is blended by; in a context without it (ONE_SOURCE) inscatter alone.

#ifdef ONE_SOURCE
layout(location = 0) out vec4 outInscatter;
vec4 outTransmittance;
#else
layout(location = 0, index = 0) out vec4 outInscatter;
layout(location = 0, index = 1) out vec4 outTransmittance;
#endif
