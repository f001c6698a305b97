// Edge light: adds what unwarp found at the edges of a multisampled depth; discards pixels of which a sample is not served, so that their
// stencil stays for the fix-up. Reads edgeInscatter (image size; alpha 0: not served). Writes inscatter.
uniform sampler2D edgeInscatter;
layout(location = 0) out vec4 outInscatter;

void main() {
  vec4 light = texelFetch(edgeInscatter, ivec2(gl_FragCoord.xy), 0);
  if (light.a == 0.0) discard;
  outInscatter = vec4(light.rgb, 0.0);
}
