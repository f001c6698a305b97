// What people use today instead of this effect: each on the same inputs, with the same physics and the same outputs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace bench {

class Baseline {
public:
  virtual ~Baseline() = default;

  /// Why it cannot render a frame; empty if it can.
  virtual std::string reasonAgainst(const tyndall::Frame& frame) const = 0;

  /// Writes Frame::output's textures if they are named, else blends into Frame::colour. Reads the frame as the effect
  /// does; the settings are ignored. Throws host::Error.
  virtual void render(const tyndall::Frame& frame) = 0;

  /// Passes of the last frame; with times only if they were asked for.
  virtual std::vector<tyndall::PassStatistics> passes() const = 0;
  virtual void timePasses(bool timed) = 0;

  /// GL memory held in textures and buffers.
  virtual std::uint64_t bytes() const = 0;
};

/// Steps per pixel at full resolution, jittered by interleaved gradient noise.
std::unique_ptr<Baseline> makeFixedSteps(int steps);

/// The same for a quarter of the pixels, with depth-aware blur and joint bilateral upsampling.
std::unique_ptr<Baseline> makeHalfResolution(int steps);

/// A camera-aligned volume, integrated front to back and looked up trilinearly.
std::unique_ptr<Baseline> makeFroxels(int width, int height, int depth);

/// Engelhardt and Dachsbacher 2010: samples on epipolar lines, each marched shadow texel by shadow texel, interpolated.
std::unique_ptr<Baseline> makeEpipolarMarch(int slices, int samples);

/// A min/max pyramid of the shadow map, walked by each pixel's ray in steps of whole nodes.
std::unique_ptr<Baseline> makePyramid();

/// Billeter et al. 2010: the shadow map as a mesh of cells x cells, whose faces add and subtract airlight.
std::unique_ptr<Baseline> makeLightVolumes(int cells);

/// Baran et al. 2010: on the CPU, per epipolar slice, only rays whose visibility changes from one texel to the next.
std::unique_ptr<Baseline> makeIncremental(int slices, int samples);

} // namespace bench
