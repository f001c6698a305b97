// The debug views, one row each: no other place relies on the enumerators' order.
#pragma once

#include <algorithm>
#include <iterator>
#include <tyndall/tyndall.h>

namespace tyndall {

/// What a view shows, and so what a frame must have.
enum class Shown {
  Picture, ///< or its parts: any technique has them
  Slices,  ///< of the first light that is drawn, into Resource::DebugView
  Samples, ///< of those slices, likewise: technique Epipolar only
};

struct DebugViewRow {
  DebugView view;
  Shown shown;
  const char* name;
};

inline constexpr DebugViewRow kDebugViews[] = {
    {DebugView::Composite, Shown::Picture, "Composite"},
    {DebugView::Slices, Shown::Slices, "Slices"},
    {DebugView::Samples, Shown::Samples, "Samples"},
    {DebugView::Breaks, Shown::Samples, "Breaks"},
    {DebugView::MarchSamples, Shown::Samples, "MarchSamples"},
    {DebugView::FixupPixels, Shown::Samples, "FixupPixels"},
    {DebugView::NodeVisits, Shown::Slices, "NodeVisits"},
    {DebugView::Inscatter, Shown::Picture, "Inscatter"},
    {DebugView::Transmittance, Shown::Picture, "Transmittance"},
    {DebugView::Difference, Shown::Picture, "Difference"},
    {DebugView::Redrawn, Shown::Picture, "Redrawn"},
    {DebugView::Inputs, Shown::Picture, "Inputs"},
};

/// Null for what is none of the enumerators.
inline const DebugViewRow* rowOf(DebugView view) {
  const auto found = std::find_if(std::begin(kDebugViews), std::end(kDebugViews),
                                  [view](const DebugViewRow& row) { return row.view == view; });
  return found == std::end(kDebugViews) ? nullptr : found;
}

} // namespace tyndall
