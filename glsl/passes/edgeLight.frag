// Edge light: what the edges of a multisampled depth have come to. Reads edgeInscatter, edgeTransmittance (image size). Writes inscatter
// and transmittance.
uniform sampler2D edgeInscatter;
uniform sampler2D edgeTransmittance;
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  outInscatter = vec4(texelFetch(edgeInscatter, pixel, 0).rgb, 0.0);
  outTransmittance = vec4(texelFetch(edgeTransmittance, pixel, 0).rgb, 1.0);
}
