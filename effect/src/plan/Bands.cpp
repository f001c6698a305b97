#include "plan/Bands.h"

#include "Rounding.h"

#include <algorithm>

namespace tyndall {

namespace {

// Nanoseconds that a slow GPU, all of it, takes for a step of one ray. They are a tenth of what llvmpipe takes on two
// cores (tests/bench/README.md), or twice what a processor's graphics of 2012 does: an Intel HD 4000 visits every texel
// along the rays of 1024 x 768 pixels in 185 ms (Yusov 2013). What a GPU of any size gains over that is not counted on.
constexpr double kFragment = 3; // what any pass does once
constexpr double kSample = 1;   // a look at another of a pixel's depths
constexpr double kStep = 0.25;  // a texel of the map, or a node of a row's tree

// How much longer a step takes in other variants.
constexpr double kLamp = 1.5, kColoured = 1.2, kGlass = 1.5, kCurves = 3, kEyeCurves = 2, kFog = 2, kBilinear = 4;
constexpr double kLayers[] = {1, 1.2, 2, 4}; // of a medium that thins out with height, by LightVariant::layers

// Nodes and groups of texels that a ray looks at in a view, whatever its row's length: more than in any scene of ours
// (DebugView::NodeVisits).
constexpr double kTreeSteps = 512;

// Panels of a ray through layers (glsl/lib/heightSteps.glsl) or pieces of one before the eye (glsl/lib/eyeCurves.glsl),
// more than most take, in steps.
constexpr double kOpenSteps = 32;

// Rasterisers shade squares of pixels together: bands are as high and wide as some of these, if they may be.
constexpr int kBlock = 4;

double stepsOf(const PassRow& row, const RayPaths& paths, const LightVariant& light, double samples) {
  const double across = static_cast<double>(paths.map.width) + paths.map.height; // cells that a line may cross
  const double texels = paths.rowTexels, nodes = texels * 4 / 3;
  switch (row.walk) {
  case RayWalk::AllTexels:
    return paths.views * across;
  case RayWalk::OwnLine:
    return paths.drawnViews * across;
  case RayWalk::Row:
    return paths.drawnViews * (paths.tree ? std::min(nodes, kTreeSteps) : texels);
  case RayWalk::Open: // of each sample
    return samples * ((light.layers == kNoLayers || light.layers == kOnlyLayer) && !light.eyeCurves ? 1 : kOpenSteps);
  default:
    return 0;
  }
}

bool readsSamples(const PassRow& row) {
  return std::any_of(row.reads.begin(), row.reads.end(),
                     [](const Read& read) { return read.resource == Resource::SceneDepthSamples; });
}

double stepNanoseconds(const LightVariant& light) {
  return kStep * (light.lightKind == 0 ? 1 : kLamp) * (light.monochrome ? 1 : kColoured) * (light.glass ? kGlass : 1) *
         (light.curves ? kCurves : 1) * (light.eyeCurves ? kEyeCurves : 1) * (light.fog ? kFog : 1) *
         (light.bilinear ? kBilinear : 1) * kLayers[light.layers];
}

// The length of even parts of a line that are at most so long: whole blocks, if that leaves any.
int evenPart(int length, double most) {
  if (most >= length) return length;
  const int longest = std::max(static_cast<int>(most), 1);
  const int block = longest >= kBlock ? kBlock : 1;
  return roundedUp(unitsFor(length, unitsFor(length, longest / block * block)), block);
}

} // namespace

double nanosecondsPerFragment(const PassRow& row, const LightVariant& light, const RayPaths& paths) {
  const double samples = readsSamples(row) ? paths.depthSamples : 1;
  return kFragment + kSample * samples * (samples - 1) + // each is compared with the others
         row.raysPerFragment * stepsOf(row, paths, light, samples) * stepNanoseconds(light);
}

Bands bandsOf(const Size& target, double nanoseconds, double milliseconds) {
  if (!(milliseconds > 0)) return {};
  const auto takes = [&](const Size& size) { return 1e-6 * nanoseconds * size.width * size.height; };
  const double fragments = milliseconds / (1e-6 * nanoseconds);
  Size size = target;
  if (takes(target) > milliseconds) {
    size.height = std::min(target.height, fragments < kBlock * kBlock ? 1 : kBlock);
    if (fragments >= static_cast<double>(target.width) * size.height)
      size.height = evenPart(target.height, fragments / target.width);
    else
      size.width = evenPart(target.width, fragments / size.height);
  }
  return {size, takes(size)};
}

} // namespace tyndall
