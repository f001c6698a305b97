#include "passes/Unwarp.h"

#include "passes/Changes.h"

namespace tyndall::passes::unwarp {

namespace {

/// The stencil test, while this lives.
class StencilTest {
public:
  struct Rule {
    gl::Enum function; ///< compares reference and stencil, both & mask
    gl::Int reference; ///< also what REPLACE writes
    gl::Uint mask;
    gl::Enum passed; ///< KEEP or REPLACE
  };
  StencilTest(const gl::Functions& gl, const Rule& rule) : gl_(gl) {
    gl.Enable(gl::STENCIL_TEST);
    gl.StencilFunc(rule.function, rule.reference, rule.mask);
    gl.StencilOp(gl::KEEP, gl::KEEP, rule.passed);
  }
  ~StencilTest() { gl_.Disable(gl::STENCIL_TEST); }
  StencilTest(const StencilTest&) = delete;
  StencilTest& operator=(const StencilTest&) = delete;

private:
  const gl::Functions& gl_;
};

constexpr StencilTest::Rule kServing = {gl::ALWAYS, 1, 0xFF, gl::REPLACE}, kUnserved = {gl::EQUAL, 0, 0xFF, gl::KEEP};

gl::Definitions definitionsOf(const exact::Variant& variant, bool spread) {
  gl::Definitions definitions = exact::definitionsOf(variant);
  definitions.emplace_back("SPREAD", spread ? 1 : 0);
  return definitions;
}

// The few pixels that no sample serves: along their slice's row. With several draws only the last one's rows are at
// hand, and to make them all again would take longer than every texel does.
Status fixUpUnserved(SliceContext& context, const In& in) {
  rows::bind(context, in.rows);
  const StencilTest test(context.gl, kUnserved);
  return context.drawImage("fix-up", context.draws() > 1 ? "passes/exact.frag" : "passes/pixelTree.frag",
                           context.definitions);
}

// Those pixels and the many between slices that disagree: along their own line.
Status fixUpBetweenSlices(SliceContext& context, const In& in) {
  rows::Out rows = in.rows;
  for (int draw = 0; draw < context.draws(); ++draw) {
    if (context.draws() > 1) // only the last draw's rows are at hand
      if (Status s = rows::run(context, {draw}, rows); !s) return s;
    if (Status s = rows::runPairs(context, {draw}, rows); !s) return s;
    context.selectDraw(draw);
    context.bindSceneDepth();
    rows::bind(context, rows);
    if (Status s = context.inputs.attachDestination(true, draw == 0); !s) return s;
    const StencilTest test(context.gl, kUnserved);
    setBlend(context.pass, draw == 0 ? context.inputs.blend : Blend::Add);
    if (Status s = context.draw("fix-up", "passes/fixup.frag", context.definitions); !s) return s;
  }
  return {};
}

} // namespace

Status run(SliceContext& context, const In& in) {
  const gl::Functions& gl = context.gl;
  const Frame& frame = *context.inputs.frame;
  context.bindSceneDepth();
  context.bindSlices();
  context.bind(gl::Unit::EpipolarInscatter, in.epipolarInscatter);
  if (in.meanLight) context.bind(gl::Unit::MeanLight, in.meanLight);
  if (Status s = context.inputs.attachDestination(true, true); !s) return s;
  const gl::Int zero = 0;
  gl.StencilMask(0xFF);
  gl.ClearBufferiv(gl::STENCIL, 0, &zero);
  setBlend(context.pass, context.inputs.blend);
  Status status;
  const std::uint64_t served = context.recorder.countWritten([&] {
    const StencilTest test(gl, kServing);
    status =
        context.drawImage("unwarp", "passes/unwarp.frag", definitionsOf(context.inputs.variant, in.meanLight != 0));
  });
  if (!status) return status;
  if (context.inputs.tiles) { // how many pixels they have is not known
    const std::uint64_t fixed = context.recorder.countWritten([&] { status = fixUpUnserved(context, in); });
    context.recorder.countFixup(fixed);
    context.recorder.countMarched(fixed);
    return status;
  }
  const auto pixels = static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height);
  context.recorder.countFixup(pixels - served);
  context.recorder.countMarched(pixels - served);
  if (served == pixels) {
    context.recorder.skip(context.inputs.name + " fix-up", "every pixel was served");
    return {};
  }
  return in.meanLight ? fixUpBetweenSlices(context, in) : fixUpUnserved(context, in);
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  std::vector<gl::Variant> all = {{"passes/unwarp.frag", definitionsOf(variant, false)},
                                  {"passes/unwarp.frag", definitionsOf(variant, true)},
                                  {"passes/fixup.frag", exact::definitionsOf(variant)}};
  if (variant.composite) return all; // temporal reuse keeps its pictures
  all.push_back(changes::overTiles({"passes/unwarp.frag", definitionsOf(variant, false)}));
  for (const char* alone : {"passes/pixelTree.frag", "passes/exact.frag"})
    all.push_back(changes::overTiles({alone, exact::definitionsOf(variant)}));
  return all;
}

} // namespace tyndall::passes::unwarp
