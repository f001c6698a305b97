// A light that goes through the passes of slices and rows: its geometry, and which of its shadow views are at hand.
#pragma once

#include "CheckFrame.h"
#include "Rounding.h"
#include "SharedBlocks.h"
#include "optics/Slices.h"
#include "plan/PassPlanner.h"

#include <cstdint>

namespace tyndall {

/// A light that adds something, with the settings that it was dealt.
struct DrawnLight {
  std::size_t index = 0;
  std::string name;
  Settings settings;
  blocks::LightBlock block;
  std::vector<blocks::CopyBlock> copies; ///< of its maps, one a view; empty: passes read them as they are
  LightVariant variant;
};

/// What GL allows.
struct Limits {
  int textureSize = 0;      ///< texels per side
  int blockAlignment = 256; ///< bytes, of a uniform block in a buffer
};

class LightPlanner : public PassPlanner {
public:
  /// `frame` has the light's own settings.
  LightPlanner(const PassPlanner& planner, const Frame& frame, const DrawnLight& light, const FrameTextures& textures,
               const Limits& limits);

  /// Has the maps copied, if passes read copies of them, unless those that the light had last hold the same.
  void copyMaps(const Board* last = nullptr);
  /// Those that the light had last, which hold the same.
  void takeCopies(const Board& last);

  /// Slices of the light in the image and in its shadow map, on the CPU (Yusov 2013, "Generating epipolar lines"): the
  /// slice table or, where some of them may be left out, the table of all.
  void makeSlices(optics::SliceSampling sampling);
  void makeSlices() { makeSlices(optics::samplingOf(frame.settings)); }

  /// Has a texture of ours filled by the CPU.
  void upload(Resource resource, std::vector<glm::vec4> texels);

  /// Shadow views of the light; 0 without a shadow map.
  int views() const { return shadowViews_; }
  /// Draws that march it: as few as row textures of bounded size allow, and at least one, which brings the light that
  /// is outside all views.
  int draws() const { return views() > 0 ? unitsFor(views(), viewsPerDraw) : 1; }
  void selectDraw(int draw);
  int segments() const { return extent.slices * extent.samples / kSegmentSamples; }

  const Frame frame;
  const Light& light;
  optics::SliceTable geometry; ///< on the CPU
  blocks::EpipolarBlock block{};
  int viewsPerDraw = 1;             ///< shadow views whose rows are at hand together
  std::uint64_t regularSamples = 0; ///< march samples that every slice has, over all slices

  /// Temporal reuse: where textures are kept, and on which of two sides this frame makes what it compares.
  Targets* keptTargets = nullptr;
  int endsSide = 0, rowsSide = 0;

protected:
  Targets& holderOf(Lifetime lifetime) override;
  int sideOf(Lifetime lifetime) const override;

private:
  void readCopies();
  void chooseRow(int longestRow, int rowStep);
  int chooseViewsPerDraw() const;

  const Limits& limits_;
  std::vector<blocks::CopyBlock> copies_;
  int source_ = 0; // SOURCE of the copies
  int shadowViews_ = 0;
  Size layerSize_; // of the shadow map
  Size mapSize_;   // of the largest view
};

} // namespace tyndall
