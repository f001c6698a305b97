// Ours.
#include "public/avsmLookup.glsl"

layout(binding = 0) uniform usampler2DArray curves;

float transmittanceAt(ivec2 texel, float depth) { return tyndallTransmittance(curves, ivec3(texel, 0), depth); }
float transmittanceIn(vec2 place, float depth) { return tyndallTransmittanceBilinear(curves, place, 0, depth); }
