// What a frame draws anew of what is kept, decided from keys and versions alone.
#pragma once

#include "reuse/Kept.h"

namespace tyndall {

enum class Redraw { Nothing, Part, All };

struct LightRedraw {
  std::size_t index = 0; ///< of the light in the frame
  LightKey key;
  MapContent maps;
  Redraw redraw = Redraw::All;
  bool comparesEnds = false, comparesRows = false;
  bool mixesEnds = false; ///< those of other jitters stay where they may
};

struct RedrawPlan {
  FrameKey key;
  Redraw picture = Redraw::All; ///< Part: what the lights' say
  std::vector<LightRedraw> lights;
  bool mayReuse = false; ///< there is a frame to compare with
};

/// True if a part of a picture can be drawn: by slices only, and against its mean inscatter (spreadThreshold) not even
/// then.
bool drawsInParts(const Frame& frame);

RedrawPlan planRedraw(const KeptEye& eye, FrameKey key, const Frame& frame);

} // namespace tyndall
