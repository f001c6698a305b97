// Edges: the pixels whose samples show more than one surface. Discards the others. Reads the plain depth as sceneDepth. Adds nothing to
// inscatter (image size): it is the stencil that is marked.
uniform sampler2D sceneDepth;
layout(location = 0) out vec4 outInscatter;

void main() {
  if (texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).g == 0.0) discard;
  outInscatter = vec4(0.0);
}
