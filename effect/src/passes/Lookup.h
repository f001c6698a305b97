// Frame::lookup: light up to a set of distances, for what is drawn after the effect (glsl/passes/lookup*.frag).
//
//   each light's slice table and rows, ambient light --> [look-up] --> lookup steps: light between two layers
//   lookup steps --> [look-up] --> the engine's layers, LOOKUP_LAYERS at once
//
#pragma once

#include "CheckFrame.h"
#include "plan/LightPlanner.h"

namespace tyndall::passes::lookup {

/// Of a planner whose extent has the look-up's size: nothing is in it yet.
void begin(PassPlanner& planner);

/// Adds a light that has been drawn. rowsAtHand: its rows are, for spans of light.
void addLight(LightPlanner& light, bool rowsAtHand);

/// From all that was added to the engine's textures.
void finish(const PassPlanner& planner, const Lookup& engines, const FrameTextures::Lookup& formats);

} // namespace tyndall::passes::lookup
