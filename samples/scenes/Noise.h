// Smooth value noise; additions and multiplications only, so the same bits everywhere.
#pragma once

#include <glm/glm.hpp>

namespace scenes {

/// In [-1, 1], features of size 1, quintic interpolation.
double noise(const glm::dvec2& point, int seed = 0);
double noise(const glm::dvec3& point);

/// Sum of `octaves` noises, each twice as fine and half as strong; about [-1, 1].
double fractal(const glm::dvec2& point, int octaves, int seed = 0);

/// Musgrave's ridged multifractal: sharp crests, rough heights and smooth valleys; about [0, 1].
double ridged(const glm::dvec2& point, int octaves, int seed = 0);

} // namespace scenes
