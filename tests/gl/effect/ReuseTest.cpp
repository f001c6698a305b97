// Temporal reuse (Frame::reuse): whatever moves, a reused frame is the frame in full.
#include "ReuseRig.h"

#include <algorithm>
#include <gl/ReadBack.h>

using namespace tyndall;
using namespace tests::reuse;

namespace {

constexpr ShadowFilter kNearest = ShadowFilter::Nearest, kBilinear = ShadowFilter::Bilinear;

struct Case {
  Light light;
  bool glass;
  ShadowFilter filter;
  int cascades;
};

// Frames of a box that tumbles, reused and in full; what moved is told in a frame as the ways say, one after the other.
void checkReused(const Case& item, int map, int frames, const std::vector<Changes>& ways, int slices = 0) {
  CAPTURE(static_cast<int>(item.light.kind), item.glass, static_cast<int>(item.filter), item.cascades, slices);
  tests::ShaftRig rig(96, 64);
  Light light = item.light;
  if (item.cascades > 1) light.shadow.views = tests::shadowViews(light, item.cascades);
  rig.addLight(light, map, item.glass);
  rig.scene.frame.settings.shadowFilter = item.filter;
  if (slices > 0) rig.scene.frame.settings.slices = slices;
  begin(rig, ways[0]);
  int parts = 0;
  for (int frame = 0; frame < frames; ++frame) {
    rig.scene.frame.reuse.changes = ways[static_cast<std::size_t>(frame) % ways.size()];
    CAPTURE(frame, static_cast<int>(rig.scene.frame.reuse.changes));
    moveTo(rig, frame);
    const Picture picture = reused(rig);
    checkSame(picture, full(rig));
    if (picture.share > 0 && picture.share < 1) ++parts;
  }
  CHECK(parts == frames - 1);
}

} // namespace

TEST_CASE("reused frames are the frames in full, by every light, filter and way to tell what moved", "[sweep]") {
  for (const Case& item :
       {Case{sun(), false, kNearest, 1}, Case{sun(), true, kNearest, 1}, Case{sun(), true, kBilinear, 1},
        Case{sun(), false, kBilinear, 3}, Case{spot(), false, kNearest, 1}, Case{spot(), true, kBilinear, 1},
        Case{point(), false, kNearest, 1}})
    for (const Changes changes : {Changes::Detect, Changes::Objects})
      checkReused(item, 128, 8, {changes});
}

// In maps of 1024 texels only those parts of rows are made that an object can have changed; 65 and 67 slices are not so
// many eights, so that rows of one view stand beside another's in a group; and what was compared of a part is followed
// by what was of all.
TEST_CASE("parts of rows in several views, by slices that are no eights, with what moved named and detected in turn",
          "[sweep]") {
  for (const Case& item :
       {Case{sun(), false, kNearest, 3}, Case{sun(), true, kBilinear, 1}, Case{sun(), false, kBilinear, 4},
        Case{point(), false, kNearest, 1}, Case{spot(), true, kNearest, 1}})
    for (const int slices : {65, 67})
      checkReused(item, 1024, 7, {Changes::Objects, Changes::Objects, Changes::Detect}, slices);
}

namespace {

// A slab with one face in a plane through the eye and the sun overhead: all of its edge is seen, and casts, in one
// slice.
glm::dmat4 radial(int frame) {
  const glm::dmat4 eye = glm::translate(glm::dmat4(1), glm::dvec3(0, 2, 0));
  const glm::dmat4 turned = glm::rotate(eye, 0.45 - 0.0137 * frame, glm::dvec3(0, 1, 0));
  return glm::scale(glm::translate(turned, glm::dvec3(0.2, 0.3, -4.5)), glm::dvec3(0.2, 0.5, 0.05));
}

Light sunOverhead() {
  Light light = sun();
  light.direction = {0, -1, 1e-3};
  const glm::dmat4 view = glm::lookAt(glm::dvec3(0, 30, 0), glm::dvec3(0, 0, 0.03), glm::dvec3(0, 0, 1));
  light.shadow.views = {{tests::toMat4(glm::ortho(-8.0, 8.0, -8.0, 8.0, 1.0, 60.0) * view), 0}};
  return light;
}

// What DebugView::Redrawn shows of the frame, which is drawn: true for red.
std::vector<bool> maskOf(tests::ShaftRig& rig, Effect& effect = tests::testEffect()) {
  Frame& frame = rig.scene.frame;
  const auto pixels = static_cast<std::size_t>(frame.viewport.width) * static_cast<std::size_t>(frame.viewport.height);
  const host::GlTexture colour = rig.scene.makeColour(GL_RGBA32F, std::vector<float>(4 * pixels, 0.25F));
  frame.settings.debugView = DebugView::Redrawn;
  rig.scene.render(effect);
  const std::vector<float> rgba = host::readColour(colour.name(), frame.viewport.width, frame.viewport.height);
  frame.settings.debugView = DebugView::Composite;
  frame.colour = 0;
  std::vector<bool> mask;
  for (std::size_t i = 0; i < pixels; ++i)
    mask.push_back(rgba[4 * i] > 0.5F);
  return mask;
}

// Without the pixels whose neighbourhood of some pixels is not all set.
std::vector<bool> shrunk(const std::vector<bool>& mask, int width, int height, int by) {
  std::vector<bool> result = mask;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int dx = -by; dx <= by; ++dx) {
        const int at = std::clamp(x + dx, 0, width - 1);
        if (!mask[static_cast<std::size_t>(y * width + at)]) result[static_cast<std::size_t>(y * width + x)] = false;
      }
  return result;
}

bool isWithin(const std::vector<bool>& inner, const std::vector<bool>& outer) {
  for (std::size_t i = 0; i < inner.size(); ++i)
    if (inner[i] && !outer[i]) return false;
  return true;
}

std::unique_ptr<Effect> withMask(Masking masking) {
  return tests::newEffect({{}, PassTiming::Off, {}, StateMode::Restore, {masking}});
}

bool covers(const std::vector<bool>& mask, const reference::Image& a, const reference::Image& b) {
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if (a.at(x, y) != b.at(x, y) && !mask[static_cast<std::size_t>(y * a.width + x)]) return false;
  return true;
}

} // namespace

TEST_CASE("the mask holds every pixel that changes, and without a tile along its border it does not", "[sweep]") {
  for (const Changes changes : {Changes::Detect, Changes::Objects})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      CAPTURE(static_cast<int>(changes), static_cast<int>(filter));
      tests::ShaftRig rig(96, 64);
      rig.addLight(sunOverhead(), 512);
      rig.scene.frame.settings.shadowFilter = filter;
      rig.scene.frame.settings.technique = Technique::Epipolar;
      begin(rig, changes);
      const std::unique_ptr<Effect> byTiles = withMask(Masking::Tiles), byStencil = withMask(Masking::Stencil);
      reference::Image last;
      bool tight = false;
      std::ptrdiff_t inTiles = 0, inStencil = 0;
      for (int frame = 0; frame < 16; ++frame) {
        CAPTURE(frame);
        rig.setMoving({radial(frame)});
        ++rig.scene.frame.reuse.frame;
        rig.scene.frame.objects.clear();
        if (changes == Changes::Objects && frame > 0)
          rig.scene.frame.objects = {between(radial(frame - 1), radial(frame))};
        const std::vector<bool> mask = maskOf(rig, *byTiles), pixels = maskOf(rig, *byStencil);
        const reference::Image now = full(rig).inscatter;
        if (frame == 0) CHECK(std::count(mask.begin(), mask.end(), true) == 96 * 64);
        if (frame > 0) {
          CHECK(covers(mask, now, last));
          // It is made of tiles of 16 pixels.
          tight = tight || !covers(shrunk(mask, 96, 64, 17), now, last);
          CHECK(covers(pixels, now, last));
          CHECK(isWithin(pixels, mask));
          inTiles += std::count(mask.begin(), mask.end(), true);
          inStencil += std::count(pixels.begin(), pixels.end(), true);
        }
        last = now;
      }
      CHECK(tight);
      CAPTURE(inTiles, inStencil);
      CHECK(2 * inStencil < inTiles);
    }
}

TEST_CASE("a version belongs to its texture: another one with the same version is compared") {
  for (const char* which : {"depth", "shadow map", "glass"}) {
    CAPTURE(which);
    const auto rigAt = [&](int pose) {
      tests::ShaftRig rig(64, 48);
      rig.addLight(sun(), 64, true);
      rig.setMoving({glm::scale(tumbling(pose), glm::dvec3(3))});
      return rig;
    };
    tests::ShaftRig first = rigAt(0), second = rigAt(9); // both live: no name is given twice
    begin(first, Changes::Detect);
    Frame& frame = first.scene.frame;
    Light& light = frame.lights[0];
    const Light& other = second.scene.frame.lights[0];
    light.shadow.version = 7;
    frame.depth.version = 3;
    reused(first);
    CHECK(reused(first).share == 0); // the same textures and versions: nothing is drawn
    if (which == std::string("depth")) frame.depth.texture = second.scene.frame.depth.texture;
    if (which == std::string("shadow map")) light.shadow.texture = other.shadow.texture;
    if (which == std::string("glass")) {
      reference::ShadowImage darker = second.scene.shadow(0);
      for (float& tint : darker.glassColour)
        tint *= 0.5F;
      second.scene.setShadow(0, darker);
      light.glass = other.glass;
    }
    const Picture picture = reused(first);
    CHECK(picture.share > 0);
    checkSame(picture, full(first));
  }
}
