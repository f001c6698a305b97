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
  const char* name;
  Shown shown;
};

inline constexpr DebugViewRow kDebugViews[] = {
    {DebugView::Composite, "Composite", Shown::Picture},
    {DebugView::Slices, "Slices", Shown::Slices},
    {DebugView::Samples, "Samples", Shown::Samples},
    {DebugView::Breaks, "Breaks", Shown::Samples},
    {DebugView::MarchSamples, "MarchSamples", Shown::Samples},
    {DebugView::FixupPixels, "FixupPixels", Shown::Samples},
    {DebugView::NodeVisits, "NodeVisits", Shown::Slices},
    {DebugView::Inscatter, "Inscatter", Shown::Picture},
    {DebugView::Transmittance, "Transmittance", Shown::Picture},
    {DebugView::Difference, "Difference", Shown::Picture},
    {DebugView::Redrawn, "Redrawn", Shown::Picture},
};

/// Null for what is none of the enumerators.
inline const DebugViewRow* rowOf(DebugView view) {
  const auto found = std::find_if(std::begin(kDebugViews), std::end(kDebugViews),
                                  [view](const DebugViewRow& row) { return row.view == view; });
  return found == std::end(kDebugViews) ? nullptr : found;
}

} // namespace tyndall
