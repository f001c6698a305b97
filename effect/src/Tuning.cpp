// The tunings, one row each.
#include "Tuning.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <vector>

namespace tyndall {

namespace {

struct Row {
  std::vector<const char*> renderers; // parts of their names, in small letters; none: all others
  Tuning tuning;
};

constexpr double kNoLimit = 0;

const std::vector<Row>& rows() {
  using M = Masking;
  static const std::vector<Row> all = {
      // Software: a pixel that is masked costs little less than one that is drawn; nothing resets it.
      {{"llvmpipe", "softpipe", "swrast", "swr (", "software", "swiftshader", "microsoft basic render", "gdi generic",
        "warp"},
       {M::Tiles, M::Stencil, Compositing::DualSource, kNoLimit}},
      // A GPU, whose driver resets it after two seconds or more.
      {{}, {M::Stencil, M::Stencil, Compositing::DualSource, 100}},
  };
  return all;
}

bool isOf(const Row& row, const std::string& renderer) {
  std::string small = renderer;
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return row.renderers.empty() || std::any_of(row.renderers.begin(), row.renderers.end(),
                                              [&](const char* part) { return small.find(part) != std::string::npos; });
}

template <typename Enumerator>
Status checkChoice(const char* field, Enumerator value, Enumerator last) {
  if (value >= Enumerator::Auto && value <= last) return {};
  return {StatusCode::InvalidConfig, std::string("Config::tuning.") + field + " is " +
                                         std::to_string(static_cast<int>(value)) + ": must be one of the enumerators"};
}

} // namespace

Status checkTuning(const Tuning& tuning) {
  if (Status s = checkChoice("reuse", tuning.reuse, Masking::Tiles); !s) return s;
  if (Status s = checkChoice("fixup", tuning.fixup, Masking::Tiles); !s) return s;
  if (Status s = checkChoice("compositing", tuning.compositing, Compositing::Copy); !s) return s;
  if (std::isfinite(tuning.bandMilliseconds) && tuning.bandMilliseconds <= 10000) return {};
  char value[32];
  std::snprintf(value, sizeof value, "%g", tuning.bandMilliseconds);
  return {StatusCode::InvalidConfig,
          std::string("Config::tuning.bandMilliseconds is ") + value + ": must be finite and at most 10000"};
}

Tuning tuningFor(const Tuning& asked, const std::string& renderer, int dualSourceBuffers) {
  const Row& row = *std::find_if(rows().begin(), rows().end(), [&](const Row& r) { return isOf(r, renderer); });
  Tuning tuning = asked;
  if (asked.reuse == Masking::Auto) tuning.reuse = row.tuning.reuse;
  if (asked.fixup == Masking::Auto) tuning.fixup = row.tuning.fixup;
  if (asked.compositing == Compositing::Auto) tuning.compositing = row.tuning.compositing;
  if (dualSourceBuffers < 1) tuning.compositing = Compositing::Copy;
  if (asked.bandMilliseconds < 0) tuning.bandMilliseconds = row.tuning.bandMilliseconds;
  return tuning;
}

} // namespace tyndall
