#include "EffectState.h"
#include "passes/Changes.h"
#include "passes/Epipolar.h"

// Temporal reuse (Frame::reuse; Lin et al. 2013). A view's picture, inscatter and transmittance, and its lights'
// epipolar textures are kept from frame to frame:
//
//   for each light:   depth, maps --> [changes], of the slices that objects reach or of all --> changed segments and
//   slices
//                     --> the passes of Epipolar.cpp, up to [interpolate], over those
//   for each light:   changed segments, scene depth, last depth --> [mask] --> stencil
//   for each light:   epipolar inscatter --> [unwarp], fix-up, where the stencil is set --> inscatter, transmittance
//   inscatter, transmittance --> [composite] --> colour
//
// A frame in which nothing has changed has the last step only; one in which everything has is drawn in full, and after
// some of those nothing is kept for a while.
namespace tyndall {

Status Effect::State::renderReusing(const Frame& frame, const FrameTextures& textures, bool& rests) {
  ViewHistory& view = histories.of(frame.reuse.view);
  rests = view.rests();
  if (rests) {
    recorder.skip("reuse", "the last frames had too little in common");
    return {};
  }
  Destination kept;
  kept.inscatter = view.targets.get(Target::Inscatter, frame.width, frame.height);
  kept.transmittance = view.targets.get(Target::Transmittance, frame.width, frame.height);
  kept.composite = frame.colour != 0;
  if (!kept.inscatter || !kept.transmittance)
    return {StatusCode::OutOfMemory, "GL could not allocate the textures of Frame::reuse"};
  if (kept.composite)
    if (Status s = prepareColour(frame); !s) return s;
  const blocks::FrameBlock block = beginDraws(frame, textures);
  const std::vector<DrawnLight> lights = lightsToDraw(frame, textures, true, false);
  FrameKey key{block, frame.settings, {}, {}};
  for (const DrawnLight& light : lights) {
    key.drawn.push_back(light.index);
    key.lights.push_back({light.block, light.settings, textures.shadows[light.index], light.variant});
  }
  Redraw picture = view.plan(key, frame);
  Status status = redraw(frame, textures, lights, picture, kept);
  view.finish(frame, static_cast<bool>(status));
  if (picture == Redraw::All) view.targets.endFrame();
  redrawnShare = -1;
  lastView = frame.reuse.view;
  if (status) status = copyToOutputs(frame, kept);
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
  if (frame.settings.technique == Technique::Epipolar && !frame.depth.multisampled && !lights.empty()) {
    if (Status s = redrawSlices(frame, textures, lights, picture, destination); !s) return s;
  } else {
    if (Status s = drawLights(frame, textures, destination); !s) return s;
  }
  if (picture != Redraw::All || frame.settings.technique != Technique::Epipolar || frame.depth.multisampled) return {};
  return keepDepth(frame, view, false);
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
  std::uint64_t masked = 0;
  if (picture == Redraw::Part)
    if (Status s = maskChanges(frame, lights, view, destination, masked); !s) return s;
  return forEachLight([&](SliceInputs& in) {
    in.masked = picture == Redraw::Part;
    in.maskedPixels = masked;
    return epipolar::finish(passContext(), targets, recorder, scratch, in);
  });
}

Status Effect::State::maskChanges(const Frame& frame, const std::vector<DrawnLight>& lights, ViewHistory& view,
                                  const Destination& destination, std::uint64_t& masked) {
  using namespace passes;
  const bool comparesDepth = view.light(lights.front().index).comparesEnds;
  if (Status s = attach(frame, destination.inscatter, 0, true); !s) return s;
  const gl::Enum none = gl::NONE;
  gl.DrawBuffers(1, &none);
  const gl::Int zero = 0;
  gl.StencilMask(0xFF);
  gl.ClearBufferiv(gl::STENCIL, 0, &zero);
  bindTexture(passContext(), gl::Unit::SceneDepth, gl::TEXTURE_2D, frame.depth.texture);
  if (comparesDepth)
    bindTexture(passContext(), gl::Unit::LastDepth, gl::TEXTURE_2D,
                view.targets.get(Target::LastDepth, frame.width, frame.height));
  setBlend(passContext(), Blend::Replace);
  for (const DrawnLight& light : lights) {
    const LightHistory& history = view.light(light.index);
    const bool compares = comparesDepth && &light == &lights.front();
    if (history.redraw == Redraw::Nothing && !compares) continue;
    upload(2, &history.geometry.block, sizeof history.geometry.block);
    bindTexture(passContext(), gl::Unit::ChangedSlices, gl::TEXTURE_2D, history.changedSlices);
    bindTexture(passContext(), gl::Unit::ChangedSegments, gl::TEXTURE_2D, history.changedSegments);
    bindTexture(passContext(), gl::Unit::SampleEnds, gl::TEXTURE_2D, history.sampleEnds);
    bindTexture(passContext(), gl::Unit::SliceTable, gl::TEXTURE_2D, history.geometry.table);
    bool ok = true;
    masked += recorder.countWritten([&] {
      ok = recorder.run(light.name + " mask", [&] { return changes::mask(passContext(), light.variant, compares); });
    });
    if (!ok) return shaderError();
  }
  return comparesDepth ? keepDepth(frame, view, true) : Status{};
}

Status Effect::State::keepDepth(const Frame& frame, ViewHistory& view, bool underMask) {
  const gl::Uint last = view.targets.get(Target::LastDepth, frame.width, frame.height);
  if (!last) return {StatusCode::OutOfMemory, "GL could not allocate the textures of Frame::reuse"};
  if (Status s = attach(frame, last, 0, underMask); !s) return s;
  passes::bindTexture(passContext(), gl::Unit::SceneDepth, gl::TEXTURE_2D, frame.depth.texture);
  setBlend(passContext(), passes::Blend::Replace);
  const bool ok = recorder.run("keep depth", [&] { return passes::changes::keepDepth(passContext(), underMask); });
  view.keepsDepth = ok;
  return ok ? Status{} : shaderError();
}

Status Effect::State::copyToOutputs(const Frame& frame, const Destination& kept) {
  const std::array<std::array<gl::Uint, 2>, 2> copies = {
      {{kept.inscatter, frame.output.inscatter}, {kept.transmittance, frame.output.transmittance}}};
  for (const auto& [from, to] : copies) {
    if (to == 0) continue;
    if (Status s = attach(frame, to, 0); !s) return s;
    passes::bindTexture(passContext(), gl::Unit::Inscatter, gl::TEXTURE_2D, from);
    setBlend(passContext(), passes::Blend::Replace);
    if (!recorder.run("output", [&] { return passes::drawFullScreen(passContext(), "passes/copyImage.frag", {}); }))
      return shaderError();
  }
  return {};
}

} // namespace tyndall
