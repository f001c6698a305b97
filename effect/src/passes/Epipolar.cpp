#include "passes/Epipolar.h"

#include "passes/Interpolate.h"
#include "passes/March.h"
#include "passes/MarchExtra.h"
#include "passes/MeanLight.h"
#include "passes/PixelTree.h"
#include "passes/Refine.h"
#include "passes/Rows.h"
#include "passes/Samples.h"
#include "passes/SliceView.h"
#include "passes/Unwarp.h"

#include <cmath>

// One light. Boxes are passes, the rest are textures (Targets.cpp); [rows] and both marches run once for all shadow
// views, or for some at a time (SliceContext::draws).
//
//   light, camera --> [slices] --> slice table, which all passes read
//   shadow map, glass map --> [rows] --> row depths, row tree
//
//   Techniques tree and lowrank:
//                        scene depth, row depths, row tree --> [pixel tree] --> destination
//
//   Technique epipolar:  scene depth --> [samples] --> sample ends, marks
//                        sample ends, rows --> [march] --> marched
//                        marched --> [mean light] --> mean light
//                        marks, marched --> [refine] --> refined marks, offsets
//                        sample ends, refined marks, offsets, rows --> [march extra] --> extra
//                        sample ends, refined marks, offsets, marched, extra --> [interpolate] --> epipolar inscatter
//                        epipolar inscatter, mean light, scene depth --> [unwarp] --> destination, stencil
//                        pixels that it left, rows --> fix-up --> destination
//
namespace tyndall::passes::epipolar {

namespace {

Status runEpipolar(SliceContext& context) {
  samples::Out samples;
  rows::Out rows;
  march::Out marched;
  refine::Out refined;
  march_extra::Out extra;
  interpolate::Out interpolated;
  if (Status s = samples::run(context, samples); !s) return s;
  for (int draw = 0; draw < context.draws(); ++draw) {
    if (Status s = rows::run(context, {draw}, rows); !s) return s;
    if (Status s = march::run(context, {draw, rows, samples.ends}, marched); !s) return s;
  }
  mean_light::Out mean;
  if (std::isfinite(context.inputs.frame->settings.spreadThreshold))
    if (Status s = mean_light::run(context, {marched.marched}, mean); !s) return s;
  if (Status s = refine::run(context, {samples.marks, marched.marched}, refined); !s) return s;
  for (int draw = 0; draw < context.draws(); ++draw) {
    if (context.draws() > 1) // only the last draw's rows are at hand
      if (Status s = rows::run(context, {draw}, rows); !s) return s;
    const march_extra::In in{draw, rows, samples.ends, refined.marks, refined.offsets};
    if (Status s = march_extra::run(context, in, extra); !s) return s;
  }
  const interpolate::In in{samples.ends, refined.marks, refined.offsets, marched.marched, extra};
  if (Status s = interpolate::run(context, in, interpolated); !s) return s;
  if (Status s = unwarp::run(context, {interpolated.inscatter, mean.mean, rows}); !s) return s;
  return slice_view::run(context, {samples.ends, samples.marks, refined.marks});
}

Status runTree(SliceContext& context) {
  if (Status s = pixel_tree::run(context, {}); !s) return s;
  return slice_view::run(context, {});
}

} // namespace

Status run(const PassContext& pass, Targets& targets, PassRecorder& recorder, const gl::Framebuffer& scratch,
           const SliceInputs& inputs) {
  SliceContext context{pass, targets, recorder, scratch, inputs};
  const slices::In in{inputs.frame, inputs.light, inputs.map};
  if (Status s = slices::run(pass, targets, in, context.slices); !s) return s;
  return inputs.frame->settings.technique == Technique::Epipolar ? runEpipolar(context) : runTree(context);
}

std::vector<gl::Variant> allVariants() {
  std::vector<gl::Variant> all = slice_view::allVariants();
  all.push_back({"passes/offsets.frag", {}});
  for (const exact::Variant& variant : exact::allVariants()) {
    if (variant.multisampled || variant.lightKind == 3) continue;
    for (const gl::Variant& pixels : pixel_tree::variantsOf(variant))
      all.push_back(pixels);
    const gl::Definitions definitions = exact::definitionsOf(variant);
    for (const char* fragment : {"sampleEnds", "marks", "march", "refine", "interpolate"})
      all.push_back({std::string("passes/") + fragment + ".frag", definitions});
    all.push_back({"passes/marchExtra.frag", definitions, "passes/strips.vert"});
    for (const gl::Variant& unwarped : unwarp::variantsOf(variant))
      all.push_back(unwarped);
    for (const gl::Variant& mean : mean_light::variantsOf(variant))
      all.push_back(mean);
    for (const gl::Variant& row : rows::variantsOf(variant))
      all.push_back(row);
  }
  return all;
}

} // namespace tyndall::passes::epipolar
