#include "passes/SliceView.h"

#include "passes/PixelTree.h"

namespace tyndall::passes::slice_view {

namespace {

constexpr const char* kName = " view";

// The samples that a view shows, as colours that add up in their pixels.
Status drawSamples(SliceContext& context, const In& in, int shown) {
  context.bindSlices();
  context.bind(gl::Unit::SampleEnds, in.sampleEnds);
  context.bind(gl::Unit::Marks, in.marks);
  context.bind(gl::Unit::ViewImage, in.refinedMarks);
  setBlend(context.pass, Blend::AddAll);
  const int vertices = 3 * context.slices.count * context.slices.samples;
  const bool ok = context.recorder.run(context.inputs.name + kName, [&] {
    if (!context.pass.programs.use("passes/viewSamples.frag", {{"SHOWN", shown}}, "passes/viewSamples.vert"))
      return false;
    context.gl.DrawArrays(gl::TRIANGLES, 0, vertices);
    return true;
  });
  return ok ? Status{} : context.shaderError();
}

Status drawFixupPixels(SliceContext& context) {
  setBlend(context.pass, Blend::Replace);
  context.gl.Enable(gl::STENCIL_TEST);
  context.gl.StencilFunc(gl::EQUAL, 0, 0xFF);
  context.gl.StencilOp(gl::KEEP, gl::KEEP, gl::KEEP);
  Status status = context.draw("view", "passes/viewFixup.frag", {});
  context.gl.Disable(gl::STENCIL_TEST);
  return status;
}

Status drawSlices(SliceContext& context) {
  context.bindSlices();
  setBlend(context.pass, Blend::Replace);
  return context.draw("view", "passes/viewSlices.frag", {});
}

} // namespace

Status run(SliceContext& context, const In& in) {
  if (!context.inputs.attachView) return {};
  const View view = context.inputs.frame->settings.view;
  if (view == View::NodeVisits) return pixel_tree::run(context, {true});
  if (Status s = context.inputs.attachView(view == View::FixupPixels); !s) return s;
  switch (view) {
  case View::Slices:
    return drawSlices(context);
  case View::Samples:
    return drawSamples(context, in, 0);
  case View::Breaks:
    return drawSamples(context, in, 1);
  case View::MarchSamples:
    return drawSamples(context, in, 2);
  default:
    return drawFixupPixels(context);
  }
}

std::vector<gl::Variant> allVariants() {
  std::vector<gl::Variant> all = {{"passes/viewSlices.frag", {}}, {"passes/viewFixup.frag", {}}};
  for (const int shown : {0, 1, 2})
    all.push_back({"passes/viewSamples.frag", {{"SHOWN", shown}}, "passes/viewSamples.vert"});
  return all;
}

} // namespace tyndall::passes::slice_view
