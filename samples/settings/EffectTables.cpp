// How the effect works: Settings, Reuse, Tuning.
#include "Tables.h"

namespace settings {

using tyndall::DebugView;
using tyndall::Reuse;
using tyndall::Settings;
using tyndall::Tuning;

namespace {

template <typename Enum>
Choice named(const char* name, const char* enumerator, Enum value) {
  return {name, enumerator, static_cast<int>(value)};
}

std::vector<Choice> techniques() {
  using tyndall::Technique;
  return {named("exact", "Exact", Technique::Exact), named("tree", "Tree", Technique::Tree),
          named("epipolar", "Epipolar", Technique::Epipolar), named("lowrank", "LowRank", Technique::LowRank)};
}

std::vector<Choice> views() {
  return {named("composite", "Composite", DebugView::Composite),
          named("slices", "Slices", DebugView::Slices),
          named("samples", "Samples", DebugView::Samples),
          named("breaks", "Breaks", DebugView::Breaks),
          named("march-samples", "MarchSamples", DebugView::MarchSamples),
          named("fixup-pixels", "FixupPixels", DebugView::FixupPixels),
          named("node-visits", "NodeVisits", DebugView::NodeVisits),
          named("inscatter", "Inscatter", DebugView::Inscatter),
          named("transmittance", "Transmittance", DebugView::Transmittance),
          named("difference", "Difference", DebugView::Difference),
          named("redrawn", "Redrawn", DebugView::Redrawn),
          named("inputs", "Inputs", DebugView::Inputs)};
}

std::vector<Choice> filters() {
  using tyndall::ShadowFilter;
  return {named("nearest", "Nearest", ShadowFilter::Nearest), named("bilinear", "Bilinear", ShadowFilter::Bilinear)};
}

std::vector<Choice> maskings() {
  using tyndall::Masking;
  return {named("auto", "Auto", Masking::Auto), named("stencil", "Stencil", Masking::Stencil),
          named("tiles", "Tiles", Masking::Tiles)};
}

std::vector<Choice> compositings() {
  using tyndall::Compositing;
  return {named("auto", "Auto", Compositing::Auto), named("dual-source", "DualSource", Compositing::DualSource),
          named("copy", "Copy", Compositing::Copy)};
}

constexpr double kMostThreshold = 1e6;
constexpr double kMostSamples = 1 << 30;

std::vector<Setting<Settings>> qualityRows() {
  return {
      choice("technique", &Settings::technique, "Technique", techniques(), "how light is summed along rays")
          .withOption("--technique"),
      choice("debugView", &Settings::debugView, "DebugView", views(),
             "a debug view instead of the composite, see below")
          .withOption("--view"),
      choice("shadowFilter", &Settings::shadowFilter, "ShadowFilter", filters(), "of the shadow map")
          .withOption("--filter"),
      number("slices", &Settings::slices, from(1, 8192), "epipolar lines")
          .withOption("--slices")
          .withSlider(64, 4096, true),
      [] {
        Rule rule = from(64, 8192);
        rule.multipleOf = 64;
        return number("samples", &Settings::samples, rule, "samples of a slice, a multiple of 64")
            .withOption("--samples")
            .withSlider(64, 2048);
      }(),
      number("rowStep", &Settings::rowStep, from(1, 8), "shadow texels from one sample of a row to the next")
          .withOption("--row-step"),
      switchOf("minMaxTree", &Settings::minMaxTree, "skip along rows by their min/max tree").withOption("--tree"),
  };
}

std::vector<Setting<Settings>> thresholdRows() {
  return {
      number("breakThreshold", &Settings::breakThreshold, above(0, kMostThreshold),
             "change of distance that counts as a depth break")
          .withOption("--break-threshold")
          .withSlider(0.001, 1, true),
      number("bendThreshold", &Settings::bendThreshold, above(0, kMostThreshold),
             "bend of the inscatter that is marched more finely")
          .withOption("--bend-threshold")
          .withSlider(0.001, 1, true),
      number("leastWeight", &Settings::leastWeight, from(0, 1),
             "bilateral weight under which a pixel is marched by itself")
          .withOption("--least-weight")
          .withSlider(0.0001, 1, true),
      number("averageThreshold", &Settings::averageThreshold, from(0, 1),
             "optical depth of a stretch of a row that is taken by its average")
          .withOption("--average-threshold"),
      number("errorTarget", &Settings::errorTarget, from(0, 1),
             "error, as a part of the mean inscatter, for which slices are left out; 0: none is")
          .withOption("--error-target")
          .withSlider(0.001, 0.2, true),
      number("spreadThreshold", &Settings::spreadThreshold, also(tyndall::kInfinity, above(0, kMostThreshold)),
             "spread of the samples around a pixel over which it is marched by itself")
          .withOption("--spread-threshold")
          .withSlider(0.005, 1, true),
      number("lowRankTerms", &Settings::lowRankTerms, from(1, 8), "terms of technique lowrank")
          .withOption("--low-rank-terms"),
      number("sampleBudget", &Settings::sampleBudget, also(0, from(4096, kMostSamples)),
             "slices x samples of all lights together; 0: no limit")
          .withOption("--sample-budget", OptionForm::Value, "slices x samples of all lights together")
          .withSlider(4096, 1 << 23, true),
  };
}

} // namespace

const std::vector<Choice> kProfiles = {named("performance", "Performance", tyndall::Profile::Performance),
                                       named("balanced", "Balanced", tyndall::Profile::Balanced),
                                       named("high", "High", tyndall::Profile::High),
                                       named("reference", "Reference", tyndall::Profile::Reference)};

std::string nameOf(tyndall::Profile profile) { return kProfiles[static_cast<std::size_t>(profile)].name; }

std::string nameOf(tyndall::Technique technique) {
  Settings settings;
  settings.technique = technique;
  const Setting<Settings>& row = settingsTable()["technique"];
  return textOf(row, row.get(settings));
}

const Table<Settings>& settingsTable() {
  static const Table<Settings> table = [] {
    Table<Settings> made{"Settings", qualityRows()};
    for (const Setting<Settings>& row : thresholdRows())
      made.rows.push_back(row);
    return made;
  }();
  return table;
}

const Table<Reuse>& reuseTable() {
  static const Table<Reuse> table{
      "Reuse",
      {
          number("fullShare", &Reuse::fullShare, from(0, 1),
                 "share of the slices' segments over which frames of an animation are drawn in full")
              .withOption("--full-share"),
          number("refreshFrames", &Reuse::refreshFrames, from(0, 65536),
                 "redraw every slice of an animation once in so many frames; 0: never")
              .withOption("--refresh-frames")
              .withSlider(0, 240),
      }};
  return table;
}

const Table<Tuning>& tuningTable() {
  static const Table<Tuning> table{
      "Tuning",
      {
          choice("reuse", &Tuning::reuse, "Masking", maskings(), "what keeps a frame to the pixels that have changed")
              .withOption("--reuse-mask"),
          choice("fixup", &Tuning::fixup, "Masking", maskings(),
                 "what keeps the fix-up to the pixels that no sample serves")
              .withOption("--fixup-mask"),
          choice("compositing", &Tuning::compositing, "Compositing", compositings(),
                 "how light is blended into the colour")
              .withOption("--compositing"),
          number("bandMilliseconds", &Tuning::bandMilliseconds, also(-1, from(0, 10000)),
                 "milliseconds that a draw may take before it is drawn in bands; 0: any; -1: as suits the renderer")
              .withOption("--band-ms", OptionForm::Value,
                          "draw in bands what may take the GPU longer, at once, than so many milliseconds; 0: nothing "
                          "(default 100, of a software rasteriser 0)")
              .withSlider(0, 500)
              .in("ms"),
      }};
  return table;
}

} // namespace settings
