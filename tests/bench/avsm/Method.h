// A way to keep how much light passes, texel by texel of a map: built of captured lists, then looked up.
#pragma once

#include "ComputeProgram.h"

#include <cstdint>
#include <tyndall/avsm.h>

namespace avsmbench {

class Method {
public:
  Method() = default;
  virtual ~Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;

  /// Into which its segments are captured.
  virtual tyndall::Avsm& lists() = 0;

  /// Of the lists that are bound as begin() of lists() leaves them, captured but not resolved.
  virtual void build() = 0;

  /// Shaders that know transmittanceAt(texel, depth) and, if filters(), transmittanceIn(place, depth). They may read
  /// `mapSize`, a uniform.
  virtual std::vector<std::string> lookUpFiles() const = 0;
  virtual Defines lookUpDefines() const { return {}; }
  /// Binds what they read: texture unit 0, storage buffers 3 and 4.
  virtual void bindForLookUp() const = 0;

  /// Whether it filters itself: its own function, or the texture unit where what it keeps may be averaged.
  virtual bool filters() const { return false; }

  /// Kept for look-ups.
  virtual std::uint64_t bytes() const = 0;
  /// Whether it can be built only when all is captured; else by blending while the scene is drawn, without lists.
  virtual bool needsLists() const { return false; }
};

} // namespace avsmbench
