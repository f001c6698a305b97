#include "EffectState.h"
#include "passes/Changes.h"
#include "passes/Epipolar.h"

// Temporal reuse (Frame::reuse; Lin et al. 2013). A view's picture, inscatter and transmittance, and its lights'
// epipolar textures are kept from frame to frame:
//
//   for each light:   depth, maps --> [changes], of the slices that objects reach or of all --> changed segments and
//   slices
//                     --> the passes of Epipolar.cpp, up to [interpolate], over those
//   for each light:   changed segments, scene depth, last depth --> [tiles] --> changed tiles
//   for each light:   epipolar inscatter --> [unwarp], fix-up, over those tiles --> inscatter, transmittance
//   inscatter, transmittance --> [composite] --> colour
//
// A frame in which nothing has changed has the last step only; one in which everything has is drawn in full, and after
// some of those nothing is kept for a while.
namespace tyndall {

namespace {

const gl::Variant kCopy = {"passes/copyTexels.frag", {}}, kCopyRadiance = {"passes/copyTexels.frag", {{"CAPPED", 1}}};

} // namespace

Status Effect::State::renderReusing(const Frame& frame, const FrameTextures& textures, bool& rests) {
  ViewHistory& view = histories.of(frame.reuse.view);
  rests = view.rests();
  if (rests) {
    recorder.skip("reuse", "the last frames had too little in common");
    return {};
  }
  Destination kept;
  const auto ask = [&] {
    kept.inscatter = view.targets.get(Target::Inscatter, frame.width, frame.height);
    kept.transmittance = view.targets.get(Target::Transmittance, frame.width, frame.height);
  };
  ask();
  kept.composite = frame.colour != 0;
  if (!kept.inscatter || !kept.transmittance)
    return {StatusCode::OutOfMemory, "GL could not allocate the textures of Frame::reuse"};
  if (kept.composite)
    if (Status s = prepareColour(frame); !s) return s;
  kept.ceiling = kLargestFloat / static_cast<float>(std::max<std::size_t>(frame.lights.size(), 1));
  const blocks::FrameBlock block = beginDraws(frame, textures, kept);
  const std::vector<DrawnLight> lights = lightsToDraw(frame, textures, true, false);
  FrameKey key{block, frame.settings, {}, {}};
  for (const DrawnLight& light : lights) {
    key.drawn.push_back(light.index);
    key.lights.push_back(
        {light.block, light.settings, textures.shadows[light.index], light.variant, frame.lights[light.index].curves});
  }
  Redraw picture = view.plan(key, frame);
  const bool all = picture == Redraw::All;
  if (all) { // what it does not ask for is given up when it is done
    view.targets.endFrame();
    ask();
  }
  Status status = redraw(frame, textures, lights, picture, kept);
  view.finish(frame, static_cast<bool>(status));
  if (all) view.targets.endFrame();
  view.targets.hold();
  redrawnShare = -1;
  lastView = frame.reuse.view;
  if (status) status = copyToOutput(frame, kept.inscatter, frame.output.inscatter);
  if (status) status = copyToOutput(frame, kept.transmittance, frame.output.transmittance);
  if (!status || !kept.composite) return status;
  if (!hasView(frame)) return composite(frame, kept);
  if (Status s = showRedrawn(frame, picture); !s) return s;
  return drawView(frame, textures, kept);
}

Status Effect::State::redraw(const Frame& frame, const FrameTextures& textures, const std::vector<DrawnLight>& lights,
                             Redraw& picture, const Destination& destination) {
  if (picture == Redraw::Nothing) {
    recorder.skip("lights", "nothing has changed: the last frame's picture is shown");
    return {};
  }
  ViewHistory& view = histories.of(frame.reuse.view);
  const bool inParts = drawsInParts(frame) && !lights.empty();
  if (inParts) {
    if (Status s = redrawSlices(frame, textures, lights, picture, destination); !s) return s;
  } else {
    if (Status s = drawLights(frame, textures, destination); !s) return s;
  }
  return picture == Redraw::All && inParts ? keepDepth(frame, view, 0) : Status{};
}

Status Effect::State::redrawSlices(const Frame& frame, const FrameTextures& textures,
                                   const std::vector<DrawnLight>& lights, Redraw& picture,
                                   const Destination& destination) {
  using namespace passes;
  ViewHistory& view = histories.of(frame.reuse.view);
  Frame lit = frame;
  const auto forEachLight = [&](const auto& step) {
    for (const DrawnLight& light : lights) {
      lit.settings = light.settings;
      upload(1, &light.block, sizeof light.block);
      SliceInputs in = sliceInputs(lit, light, textures, destination, &light == &lights.front());
      in.history = &view.light(light.index);
      if (Status s = step(in); !s) return s;
    }
    return Status{};
  };
  const int frames = view.frames;
  Status prepared = forEachLight([&](SliceInputs& in) {
    if (in.history->redraw == Redraw::All) picture = Redraw::All;
    return epipolar::prepare(passContext(), targets, recorder, scratch, in, frames);
  });
  if (!prepared) return prepared;
  for (const DrawnLight& light : lights) // one may have turned out not to be kept
    if (view.light(light.index).redraw == Redraw::All) picture = Redraw::All;
  gl::Uint tiles = 0;
  if (picture == Redraw::Part)
    if (Status s = findTiles(frame, lights, view, tiles); !s) return s;
  return forEachLight([&](SliceInputs& in) {
    in.tiles = tiles;
    return epipolar::finish(passContext(), targets, recorder, scratch, in);
  });
}

Status Effect::State::findTiles(const Frame& frame, const std::vector<DrawnLight>& lights, ViewHistory& view,
                                gl::Uint& tiles) {
  using namespace passes;
  const bool comparesDepth = view.light(lights.front().index).comparesEnds;
  const int width = changes::kTilesAcross, height = changes::tileLines(frame.width, frame.height);
  tiles = targets.get(Target::ChangedTiles, width, height);
  if (!tiles) return {StatusCode::OutOfMemory, "GL could not allocate the textures of Frame::reuse"};
  if (Status s = attach(frame, tiles, 0); !s) return s;
  gl.Viewport(0, 0, width, height);
  constexpr std::array<gl::Float, 4> kNone = {0, 0, 0, 0};
  gl.ClearBufferfv(gl::COLOR, 0, kNone.data());
  bindTexture(passContext(), gl::Unit::SceneDepth, gl::TEXTURE_2D, frame.depth.texture);
  if (comparesDepth)
    bindTexture(passContext(), gl::Unit::LastDepth, gl::TEXTURE_2D,
                view.targets.get(Target::LastDepth, frame.width, frame.height));
  for (const DrawnLight& light : lights) {
    const LightHistory& history = view.light(light.index);
    if (history.redraw == Redraw::Nothing) continue;
    upload(2, &history.geometry.block, sizeof history.geometry.block);
    const auto bind = [&](gl::Unit unit, gl::Uint texture) {
      bindTexture(passContext(), unit, gl::TEXTURE_2D, texture);
    };
    bind(gl::Unit::ChangedSlices, history.changedSlices);
    bind(gl::Unit::ChangedSegments, history.changedSegments);
    bind(gl::Unit::SampleEnds, history.sampleEnds);
    bind(gl::Unit::SliceTable, history.geometry.table);
    const bool some = history.movedSlices != 0;
    if (some) bind(gl::Unit::MovedSlices, history.movedSlices);
    const bool compares = comparesDepth && &light == &lights.front();
    if (!recorder.run(light.name + " tiles",
                      [&] { return changes::findTiles(passContext(), light.variant, compares, some); }))
      return shaderError();
  }
  return comparesDepth ? keepDepth(frame, view, tiles) : Status{};
}

Status Effect::State::keepDepth(const Frame& frame, ViewHistory& view, gl::Uint tiles) {
  const gl::Uint last = view.targets.get(Target::LastDepth, frame.width, frame.height);
  if (!last) return {StatusCode::OutOfMemory, "GL could not allocate the textures of Frame::reuse"};
  if (Status s = attach(frame, last, 0); !s) return s;
  passes::bindTexture(passContext(), gl::Unit::ViewImage, gl::TEXTURE_2D, frame.depth.texture);
  setBlend(passContext(), passes::Blend::Replace);
  view.keepsDepth = recorder.run("keep depth", [&] { return drawTiles(frame, kCopy, tiles); });
  return view.keepsDepth ? Status{} : shaderError();
}

// A full-screen pass over tiles, or over all without them.
bool Effect::State::drawTiles(const Frame& frame, const gl::Variant& variant, gl::Uint tiles) {
  if (!tiles) return passes::drawFullScreen(passContext(), variant.fragment, variant.definitions);
  passes::bindTexture(passContext(), gl::Unit::ChangedTiles, gl::TEXTURE_2D, tiles);
  return passes::changes::drawTiles(passContext(), variant, frame.width, frame.height);
}

Status Effect::State::copyToOutput(const Frame& frame, gl::Uint from, gl::Uint output) {
  if (output == 0) return {};
  if (Status s = attach(frame, output, 0); !s) return s;
  passes::bindTexture(passContext(), gl::Unit::ViewImage, gl::TEXTURE_2D, from);
  setBlend(passContext(), passes::Blend::Replace);
  return recorder.run("output", [&] { return drawTiles(frame, kCopyRadiance, 0); }) ? Status{} : shaderError();
}

} // namespace tyndall
