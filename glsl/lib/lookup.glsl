// Look-up of light along camera rays (Frame::lookup): its layers, from the eye on, and where light is added up for them: in one texture of
// LOOKUP_COLUMNS layers side by side, of each what comes between the layer before and it.

float lookupDistance(int layer) { return layer < 0 ? 0.0 : lookupNear * exp2(lookupGrowth * float(layer)); }

// Where a texel of a layer looks, jittered as the picture is.
vec2 lookupPosition(vec2 texel) { return unjittered(texel * vec2(frameSize) / vec2(lookupSize)); }

ivec2 lookupTile(int layer) { return lookupSize * ivec2(layer % LOOKUP_COLUMNS, layer / LOOKUP_COLUMNS); }

// Of the fragment's texel there: the ray and its part. Empty beyond the last layer.
struct LookupPart {
  vec2 position;
  float from, to;
};

LookupPart lookupPart() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), tile = pixel / lookupSize;
  int layer = tile.x + LOOKUP_COLUMNS * tile.y;
  bool isOne = layer < lookupDepths;
  vec2 position = lookupPosition(gl_FragCoord.xy - vec2(tile * lookupSize));
  return LookupPart(position, isOne ? lookupDistance(layer - 1) : 0.0, isOne ? lookupDistance(layer) : 0.0);
}
