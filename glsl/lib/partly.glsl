// One program draws a target whole and, for temporal reuse, in parts: vertices 0 to 2 are a triangle that covers the viewport, those from
// 3 on, six an instance, a part's two triangles. Fragment shaders that leave out more see which of the two is drawn.

vec4 wholeTarget(int vertex) { return vec4(vec2((vertex & 1) * 4 - 1, (vertex & 2) * 2 - 1), 0.0, 1.0); }

// Right, top: which corner of a rectangle one of six vertices is.
bvec2 cornerOf(int vertex) { return bvec2(vertex == 1 || vertex == 2 || vertex == 4, vertex == 2 || vertex == 4 || vertex == 5); }
