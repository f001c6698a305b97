// The process's peak memory, as the kernel counts it. On a software rasteriser it holds the GL textures, too.
#pragma once

#include <cstdint>

namespace bench {

/// Bytes since the last reset, or since the start where the kernel lets nobody reset it; 0 if not known.
std::uint64_t peakMemory();
void resetPeakMemory();

} // namespace bench
