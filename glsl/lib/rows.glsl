// Rows: the lines of the shadow map along which the rays of a slice run, one of each slice in each shadow view.
// SHADOW_VIEWS: 1, or 2 for several. Needs lib/slices.glsl.
//
// Row textures hold the rows of a draw's shadow views above one another, one a slice each. At y:
#if SHADOW_VIEWS == 2
// Floats divide faster than integers, and exactly where they are halfway between the results' ends.
int drawnViewOfRow(int y) { return int((float(y) + 0.5) / float(sliceCount)); }
int viewOfRow(int y) { return firstView + drawnViewOfRow(y); }
int sliceOfRow(int y) { return y - sliceCount * drawnViewOfRow(y); }
int rowOf(int view, int slice) { return (view - firstView) * sliceCount + slice; }
#else
int viewOfRow(int y) { return 0; }
int sliceOfRow(int y) { return y; }
int rowOf(int view, int slice) { return slice; }
#endif

// Origin and step of a slice's row in a view's map.
vec4 rowLine(int view, int slice) { return texelFetch(sliceTable, ivec2(slice, 2 + 2 * view), 0); }

// Its main axis.
bool isAlongX(vec4 row) { return abs(row.z) >= abs(row.w); }

// Last texel of the row.
int rowLast(int view, int slice) { return max(int(texelFetch(sliceTable, ivec2(slice, 3 + 2 * view), 0).x), 1) - 1; }

// Its texels up to the end of its last node of 16.
int rowTexels(int view, int slice) { return (rowLast(view, slice) | 15) + 1; }
