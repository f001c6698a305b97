// Red: the pixels that the stencil, or tiles, let through. The mask of the fix-up, debug views. Writes unserved or debugView: image size.
layout(location = 0) out vec4 outColour;

void main() { outColour = vec4(1.0, 0.0, 0.0, 1.0); }
