// Samples: the length of the camera ray at every sample of every slice, and which of them are marched because of depth
// breaks (Yusov 2013, "Sample classification"; glsl/passes/sampleEnds, marks).
#pragma once

#include "passes/SliceContext.h"

namespace tyndall::passes::samples {

struct Out {
  gl::Uint ends = 0;
  gl::Uint marks = 0;
};

/// The ends of all slices, or of those that have changed.
Status runEnds(SliceContext& context, Out& out);
/// Copies the ends of the slices that are drawn into `to`, which this makes the light's own.
Status copyEnds(SliceContext& context, gl::Uint from, Out& to);
Status runMarks(SliceContext& context, Out& out);

} // namespace tyndall::passes::samples
