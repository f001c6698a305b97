// What a method keeps of texels at depths. Follows a method's look-up, which knows transmittanceAt(texel, depth). Reads queries (texel as
// y * size + x, and depth as bits of a float). Writes results.
layout(local_size_x = 256) in;
layout(std430, binding = 6) readonly buffer Queries { uvec2 queries[]; };
layout(std430, binding = 7) writeonly buffer Results { float results[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(queries.length())) return;
  uvec2 query = queries[i];
  results[i] = transmittanceAt(ivec2(query.x % uint(mapSize), query.x / uint(mapSize)), uintBitsToFloat(query.y));
}
