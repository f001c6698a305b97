// The table of tunings: which renderer has which row, what is asked for wins, and what is refused.
#include "Tuning.h"

#include "support/Catch.h"

#include <cmath>
#include <limits>

using namespace tyndall;

namespace {

bool isSettled(const Tuning& tuning) {
  return tuning.reuse != Masking::Auto && tuning.fixup != Masking::Auto && tuning.compositing != Compositing::Auto &&
         tuning.bandMilliseconds >= 0;
}

} // namespace

TEST_CASE("tuning: software renderers have a row, all others are GPUs") {
  for (const char* renderer :
       {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Software Rasterizer", "SWR (LLVM 10.0.0, 256 bits)",
        "Google SwiftShader", "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader)",
        "Apple Software Renderer", "D3D12 (Microsoft Basic Render Driver)", "GDI Generic",
        "ANGLE (Microsoft, Microsoft Basic Render Driver Direct3D11 vs_5_0 ps_5_0)", "WARP Rasterizer",
        "zink Vulkan 1.3(llvmpipe (LLVM 17.0.6, 256 bits) (MESA_LLVMPIPE))", "virgl (LLVMPIPE (LLVM 15.0.7))"}) {
    INFO(renderer);
    const Tuning tuning = tuningFor({}, renderer, 1);
    CHECK(isSettled(tuning));
    CHECK(tuning.reuse == Masking::Tiles);
    CHECK(tuning.bandMilliseconds == 0);
  }
  for (const char* renderer : {"NVIDIA GeForce RTX 3080/PCIe/SSE2", "NVIDIA H100 80GB HBM3/PCIe/SSE2", "Apple M2",
                               "Mesa Intel(R) Xe Graphics (TGL GT2)", "AMD Radeon RX 6800 (radeonsi, navi21)", ""}) {
    INFO(renderer);
    const Tuning tuning = tuningFor({}, renderer, 1);
    CHECK(isSettled(tuning));
    CHECK(tuning.reuse == Masking::Stencil);
    CHECK(tuning.fixup == Masking::Stencil);
    CHECK(tuning.compositing == Compositing::DualSource);
    CHECK(tuning.bandMilliseconds > 0);
    CHECK(tuning.bandMilliseconds < 500);
  }
}

TEST_CASE("tuning: what is asked for is not the table's") {
  for (const char* renderer : {"llvmpipe", "NVIDIA"}) {
    for (const Masking masking : {Masking::Stencil, Masking::Tiles}) {
      CHECK(tuningFor({masking}, renderer, 1).reuse == masking);
      CHECK(tuningFor({Masking::Auto, masking}, renderer, 1).fixup == masking);
    }
    for (const double milliseconds : {0., 20.})
      CHECK(tuningFor({{}, {}, {}, milliseconds}, renderer, 1).bandMilliseconds == milliseconds);
    CHECK(tuningFor({{}, {}, Compositing::Copy}, renderer, 8).compositing == Compositing::Copy);
  }
}

TEST_CASE("tuning: without dual-source blending the colour is copied, whatever is asked for") {
  for (const Compositing asked : {Compositing::Auto, Compositing::DualSource, Compositing::Copy})
    CHECK(tuningFor({{}, {}, asked}, "NVIDIA", 0).compositing == Compositing::Copy);
}

TEST_CASE("tuning: what it may not be is refused by name") {
  const auto messageOf = [](const Tuning& tuning) {
    const Status status = checkTuning(tuning);
    CHECK(status.code == StatusCode::InvalidConfig);
    return status.message;
  };
  CHECK(checkTuning({}).code == StatusCode::Ok);
  CHECK(checkTuning({Masking::Tiles, Masking::Tiles, Compositing::Copy, 10000}).code == StatusCode::Ok);
  CHECK(messageOf({static_cast<Masking>(3)}) == "Config::tuning.reuse is 3: must be one of the enumerators");
  CHECK(messageOf({Masking::Auto, static_cast<Masking>(-1)}) ==
        "Config::tuning.fixup is -1: must be one of the enumerators");
  CHECK(messageOf({{}, {}, static_cast<Compositing>(3)}) ==
        "Config::tuning.compositing is 3: must be one of the enumerators");
  const std::string rule = ": must be finite and at most 10000";
  CHECK(messageOf({{}, {}, {}, 10001}) == "Config::tuning.bandMilliseconds is 10001" + rule);
  CHECK(messageOf({{}, {}, {}, -std::numeric_limits<double>::infinity()}) ==
        "Config::tuning.bandMilliseconds is -inf" + rule);
  CHECK(messageOf({{}, {}, {}, std::nan("")}) == "Config::tuning.bandMilliseconds is nan" + rule);
}
