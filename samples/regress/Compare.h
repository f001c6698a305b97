// How far a picture is from its reference.
#pragma once

#include "CaseList.h"
#include "HdrPicture.h"

#include <string>
#include <vector>

namespace regress {

/// As Tolerance explains them. Of a black reference differences are absolute. Pixels that are NaN or infinite in both
/// pictures alike do not count.
struct Difference {
  double rRmse = 0;
  double p99 = 0;
  double max = 0;
  double over = 0;
  double flip = 0;
  std::size_t notFinite = 0; ///< pixels with a NaN or an infinity in only one of the pictures
};

/// Both of the same size; `exposure` for the display that FLIP looks at.
Difference compare(const HdrPicture& wanted, const HdrPicture& got, double pixelTolerance,
                   const render::Options& options, float exposure);

/// One of the figures against its limit.
struct Judgement {
  std::string name; ///< for people
  double value;
  double limit;
  bool isRelative; ///< to be read in per cent
  bool isKept() const { return value <= limit; }
};
/// "1.25 %", "0.004" or "3"; "infinite".
std::string textOf(double value, bool isRelative);
std::vector<Judgement> judge(const Difference& difference, const Tolerance& tolerance);

/// By how much brighter (red) or darker (blue) each pixel is than the reference, grey where it is the same: 8-bit sRGB.
/// The colours are full at `range` times the mean of the reference.
std::vector<std::uint8_t> differenceColours(const HdrPicture& wanted, const HdrPicture& got, double range);

} // namespace regress
