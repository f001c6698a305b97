#include "reuse/LookupWrites.h"

#include <algorithm>

namespace tyndall {

std::uint64_t LookupWrites::lastOf(gl::Uint texture) const {
  const auto found = std::find_if(writes_.begin(), writes_.end(), [&](const Write& w) { return w.texture == texture; });
  return found == writes_.end() ? 0 : found->number;
}

std::uint64_t LookupWrites::lastOf(const Lookup& lookup) const {
  return std::max(lookup.inscatter ? lastOf(lookup.inscatter) : 0,
                  lookup.transmittance ? lastOf(lookup.transmittance) : 0);
}

std::uint64_t LookupWrites::write(const Lookup& lookup) {
  constexpr std::size_t kRemembered = 32;
  ++count_;
  for (const gl::Uint texture : {lookup.inscatter, lookup.transmittance}) {
    writes_.erase(std::remove_if(writes_.begin(), writes_.end(), [&](const Write& w) { return w.texture == texture; }),
                  writes_.end());
    if (texture != 0) writes_.push_back({texture, count_});
  }
  if (writes_.size() > kRemembered) writes_.erase(writes_.begin(), writes_.end() - kRemembered);
  return count_;
}

} // namespace tyndall
