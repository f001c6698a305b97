#version 430 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// AVSM empty: curves through which all light passes, in all layers, whatever the number of their nodes. Writes curves.
layout(rgba32ui, binding = 0) writeonly uniform uimage2DArray curveImage;
layout(local_size_x = 8, local_size_y = 8) in;

uniform int clearWord;

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID), size = imageSize(curveImage);
  if (any(greaterThanEqual(texel.xy, size.xy))) return;
  for (int layer = texel.z; layer < size.z; layer += int(gl_NumWorkGroups.z)) imageStore(curveImage, ivec3(texel.xy, layer), uvec4(clearWord));
}
