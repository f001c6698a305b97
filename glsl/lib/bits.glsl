// Masks of 16 samples, bit j for sample j of its segment. Bit 0, the regular march sample, is always set.

int popcount(int m) {
  m = m - ((m >> 1) & 0x5555);
  m = (m & 0x3333) + ((m >> 2) & 0x3333);
  m = (m + (m >> 4)) & 0x0f0f;
  return (m + (m >> 8)) & 0x1f;
}

// Index of the highest and of the lowest bit set; GLSL 3.30 has no findMSB. A float's exponent is its logarithm.
int highestBit(int m) { return (floatBitsToInt(float(m)) >> 23) - 127; }
int lowestBit(int m) { return highestBit(m & -m); }
