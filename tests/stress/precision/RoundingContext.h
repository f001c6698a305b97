// The test context behind a loader that widens the effect's own textures to 32-bit floats and rounds what is drawn into
// some of them, as if they had another format.
#pragma once

#include "Formats.h"

#include <map>
#include <string>
#include <tyndall/tyndall.h>

namespace precision {

/// A target as the effect makes it: its name in the table of targets, and GL's of the format that it asks for.
struct Target {
  std::string name, format;
  bool operator<(const Target& other) const { return name != other.name ? name < other.name : format < other.format; }
};

/// How a target is rounded. Even steps go over [0, 1] where it has them itself, else over what the texture holds of
/// each channel.
struct Rounding {
  Format format = Format::Float32;
  bool isBound = false;                     ///< even channels go down, odd ones up, as bounds of trees do
  Direction direction = Direction::Nearest; ///< of others
};

/// What a target was seen to hold, over all texels of all draws, but for stand-ins for infinity.
struct Seen {
  float least = 0, greatest = 0;
  bool isAny = false;
};

/// While it lives, effects made with its loader draw so. One at a time.
class RoundingContext {
public:
  RoundingContext();
  ~RoundingContext();
  RoundingContext(const RoundingContext&) = delete;
  RoundingContext& operator=(const RoundingContext&) = delete;

  tyndall::GlLoader loader() const;

  /// Targets that are not named stay in 32 bits.
  void round(const std::map<Target, Rounding>& targets);

  /// Of targets that were drawn into since the last call.
  std::map<Target, Seen> takeSeen();
  void watch(bool on); ///< whether that is looked at, which takes time
};

} // namespace precision
