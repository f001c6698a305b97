// Whether the textures of a look-up hold what an eye's last frame has written into them: other eyes, and frames that
// keep nothing, may write into the same.
#pragma once

#include "gl/Functions.h"

#include <cstdint>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

/// Which write of the textures of Frame::lookup was the last, of those that were written lately.
class LookupWrites {
public:
  /// 0: not known.
  std::uint64_t lastOf(const Lookup& lookup) const;
  /// They are written: returns which write that is.
  std::uint64_t write(const Lookup& lookup);

private:
  struct Write {
    gl::Uint texture = 0;
    std::uint64_t number = 0;
  };
  std::uint64_t lastOf(gl::Uint texture) const;
  std::vector<Write> writes_;
  std::uint64_t count_ = 0;
};

} // namespace tyndall
