// FLIP, the perceived difference of two displayed pictures that are flipped between: P. Andersson, J. Nilsson,
// T. Akenine-Moeller, M. Oskarsson, K. Astroem and M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020.
#pragma once

#include <cstdint>
#include <vector>

namespace regress {

/// Of the paper: a display of 0.7 m and 3840 pixels, seen from 0.7 m.
inline constexpr double kPixelsPerDegree = 67.02064327658225;

/// The difference of each pixel, 0 to 1. Both pictures are 8-bit sRGB of width x height pixels.
std::vector<float> flip(const std::vector<std::uint8_t>& wanted, const std::vector<std::uint8_t>& got, int width,
                        int height, double pixelsPerDegree = kPixelsPerDegree);

/// Its mean, the figure that tolerances are for.
double meanOf(const std::vector<float>& values);

} // namespace regress
