// Debug views: what takes the composite's place.
#include "EffectState.h"
#include "passes/Changes.h"
#include "passes/View.h"

namespace tyndall {

// Black, where no light is drawn or a sample lies; or red.
Status Effect::State::clearView(const Frame& frame, float red) {
  const gl::Uint view = targets.get(Target::View, frame.width, frame.height);
  if (!view) return {StatusCode::OutOfMemory, "GL could not allocate a texture for Frame::settings.view"};
  if (Status s = attach(frame, view, 0); !s) return s;
  const std::array<gl::Float, 4> colour = {red, 0, 0, red};
  gl.ClearBufferfv(gl::COLOR, 0, colour.data());
  return {};
}

// What a frame with Frame::reuse drew: all, or its tiles.
Status Effect::State::showRedrawn(const Frame& frame, Redraw picture) {
  if (Status s = clearView(frame, picture == Redraw::All ? 1 : 0); !s || picture != Redraw::Part) return s;
  passes::setBlend(passContext(), passes::Blend::Replace);
  const gl::Uint tiles = targets.get(Target::ChangedTiles, passes::changes::kTilesAcross,
                                     passes::changes::tileLines(frame.width, frame.height));
  return drawTiles(frame, {"passes/viewFixup.frag", {}}, tiles) ? Status{} : shaderError();
}

Status Effect::State::drawView(const Frame& frame, const FrameTextures& textures, const Destination& destination) {
  passes::view::In in{frame.settings.view, destination.inscatter};
  if (in.view == View::Transmittance) in.image = destination.transmittance;
  if (showsSlices(frame) || in.view == View::Redrawn) in.image = targets.get(Target::View, frame.width, frame.height);
  if (in.view == View::Difference)
    if (Status s = drawDifference(frame, textures, in); !s) return s;
  if (in.view == View::NodeVisits)
    if (Status s = readVisits(frame, in.image); !s) return s;
  if (Status s = attach(frame, frame.colour, 0); !s) return s;
  return recorder.run("view", [&] { return passes::view::run(passContext(), in); }) ? Status{} : shaderError();
}

// Exact's inscatter, and its mean.
Status Effect::State::drawDifference(const Frame& frame, const FrameTextures& textures, passes::view::In& in) {
  Frame exactFrame = frame;
  exactFrame.settings.technique = Technique::Exact;
  in.exact = targets.get(Target::ViewExact, frame.width, frame.height);
  if (!in.exact) return {StatusCode::OutOfMemory, "GL could not allocate a texture for Frame::settings.view"};
  if (Status s = drawLights(exactFrame, textures, {in.exact, 0, true}); !s) return s;
  return drawMean(frame, in.exact, 3, in.mean);
}

Status Effect::State::drawMean(const Frame& frame, gl::Uint image, int channels, gl::Uint& mean) {
  mean = targets.get(Target::ViewMean, 1, 1);
  const gl::Uint rowMeans = targets.get(Target::ViewRowMeans, frame.height, 1);
  if (!mean || !rowMeans) return {StatusCode::OutOfMemory, "GL could not allocate a texture for Frame::settings.view"};
  if (Status s = attach(frame, image, 0); !s) return s; // without a second target and a stencil
  const passes::view::MeanIn in{image, channels, frame.height, rowMeans, mean};
  return recorder.run("view mean", [&] { return passes::view::runMean(passContext(), in); }) ? Status{} : shaderError();
}

// Waits for the GPU, which a view to look at may.
Status Effect::State::readVisits(const Frame& frame, gl::Uint image) {
  gl::Uint mean = 0;
  if (Status s = drawMean(frame, image, 1, mean); !s) return s;
  gl::Float visits = 0;
  passes::bindTexture(passContext(), gl::Unit::ViewMean, gl::TEXTURE_2D, mean);
  gl.GetTexImage(gl::TEXTURE_2D, 0, gl::RED, gl::FLOAT, &visits);
  recorder.countVisits(visits);
  return {};
}

} // namespace tyndall
