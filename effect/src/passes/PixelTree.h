// Pixel tree: every pixel through its slice's tree, in as few draws as its rows allow (Chen 2011;
// glsl/passes/pixelTree).
#pragma once

#include "plan/LightPlanner.h"

namespace tyndall::passes::pixel_tree {

/// By Technique::Tree or LowRank. False if the rows that it leaves are not those of lit spans (rows::Walk).
bool plan(LightPlanner& light);

/// Adds what the walks look at to the debug view, instead of light to the destination.
void planVisits(LightPlanner& light);

} // namespace tyndall::passes::pixel_tree
