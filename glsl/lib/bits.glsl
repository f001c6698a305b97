// Masks of 16 samples, bit j for sample j of its segment; four of them make a chunk of 64. Bit 0 of each, the regular
// march sample, is always set and marched by itself; the marked samples between are packed, two to a texel.

// As textures hold them: 16-bit normalised integers.
ivec4 masksOf(vec4 stored) { return ivec4(stored * 65535.0 + 0.5); }
vec4 storedMasks(ivec4 masks) { return vec4(masks) / 65535.0; }

int popcount(int m) {
  m = m - ((m >> 1) & 0x5555);
  m = (m & 0x3333) + ((m >> 2) & 0x3333);
  m = (m + (m >> 4)) & 0x0f0f;
  return (m + (m >> 8)) & 0x1f;
}

// Index of the highest and of the lowest bit set; GLSL 3.30 has no findMSB. A float's exponent is its logarithm.
int highestBit(int m) { return (floatBitsToInt(float(m)) >> 23) - 127; }
int lowestBit(int m) { return highestBit(m & -m); }

// Marked samples between the regular ones of a chunk, and before a sample of it.
int extraSamples(ivec4 masks) {
  return popcount(masks.x & ~1) + popcount(masks.y & ~1) + popcount(masks.z & ~1) + popcount(masks.w & ~1);
}
int extraRank(ivec4 masks, int index) {
  ivec4 before = clamp(ivec4(index) - ivec4(0, 16, 32, 48), ivec4(0), ivec4(16));
  return extraSamples(masks & ((ivec4(1) << before) - 1));
}

// Place of the bit of a mask of 16 before which `rank` others are set.
int bitOfRank(int mask, int rank) {
  int place = 0;
  for (int width = 8; width > 0; width /= 2) {
    int low = (mask >> place) & ((1 << width) - 1), count = popcount(low);
    if (rank >= count) {
      rank -= count;
      place += width;
    }
  }
  return place;
}

// The inverse of extraRank, for ranks that there are.
int extraSample(ivec4 masks, int rank) {
  int s = 0;
  for (int i = 0; i < 3; ++i) {
    int count = popcount(masks[i] & ~1);
    if (s == i && rank >= count) {
      rank -= count;
      s = i + 1;
    }
  }
  int mask = s < 2 ? (s == 0 ? masks.x : masks.y) : (s == 2 ? masks.z : masks.w);
  return 16 * s + bitOfRank(mask & ~1, rank);
}
