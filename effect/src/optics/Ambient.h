// Light of the surroundings (Frame::ambient), scattered by the medium's phase functions.
#pragma once

#include "SharedBlocks.h"

#include <array>
#include <glm/glm.hpp>
#include <tyndall/tyndall.h>

namespace tyndall::optics {

/// False if no light comes from the surroundings.
bool isLit(const Ambient& ambient);

/// By how much a phase function scales harmonics of degree 0, 1 and 2: the means of Legendre's polynomials of the
/// cosine over it (Funk and Hecke's theorem; those of Cornette and Shanks by the recurrence of the polynomials).
std::array<double, 3> phaseMoments(const Constituent& constituent);

/// occlusionSize: texels of Ambient::occlusion, 0 without.
blocks::AmbientBlock ambientBlock(const Frame& frame, const glm::ivec2& occlusionSize);

/// More than any pixel receives of it.
double brightestAmbient(const Frame& frame);

/// The least that the constituents which follow one layer, or none, scatter of it together in any direction and
/// channel, as a part of the most; below 0 where the harmonics make it so, else 0.
double leastAmbient(const Frame& frame);

} // namespace tyndall::optics
