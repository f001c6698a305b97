// Optical depth of a segment; of an opaque one what 8 bits tell from none.
float absorbance(float passed) { return -log(max(passed, 1e-3)); }
