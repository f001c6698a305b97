#include "passes/Rows.h"

namespace tyndall::passes::rows {

namespace {

int treeNodes(int texels, int finest, int levels) {
  int nodes = 0;
  for (int level = finest; level <= levels; ++level)
    nodes += texels >> (2 * level);
  return nodes;
}

// Makes a row texture of full size the target; only this frame's rows are drawn.
Status target(SliceContext& context, Target which, int width, int drawn, gl::Uint& texture) {
  if (Status s = context.target(which, width, context.rowRoom(), texture); !s) return s;
  context.gl.Viewport(0, 0, drawn, context.rows());
  return {};
}

// Splits, means and, with glass, moments of a level or of all.
struct TreeTargets {
  Target splits, means, moments;
};

Status targets(SliceContext& context, const TreeTargets& which, int width, int drawn, Out& out) {
  if (Status s = target(context, which.splits, width, drawn, out.tree); !s) return s;
  if (Status s = context.attachMore(1, which.means, width, context.rowRoom(), out.means); !s) return s;
  if (!context.inputs.variant.glass) return {};
  return context.attachMore(2, which.moments, width, context.rowRoom(), out.moments);
}

// Draws what has one fragment for four texels of a row, where rows are.
gl::Variant inStrips(const char* fragment, gl::Definitions definitions) {
  definitions.emplace_back("STRIPS_OF_ROWS", 1);
  return {fragment, definitions, "passes/strips.vert"};
}

Status drawStrips(SliceContext& context, const char* name, const char* fragment, const gl::Definitions& definitions) {
  const gl::Variant v = inStrips(fragment, definitions);
  const bool ok = context.recorder.run(context.inputs.name + " " + name, [&] {
    return drawStrips(context.pass, v.vertex, context.rows(), v.fragment, v.definitions);
  });
  return ok ? Status{} : context.shaderError();
}

} // namespace

Status run(SliceContext& context, const In& in, Out& out) {
  if (context.views() == 0) return {};
  const int room = context.slices.rowTexels, drawn = context.slices.block.grid.z, levels = context.slices.block.grid.w;
  const gl::Definitions definitions = definitionsOf(context.inputs.variant, in.tintSums);
  context.selectDraw(in.draw);
  context.bindSlices();
  context.bindMaps();
  setBlend(context.pass, Blend::Replace);
  if (Status s = target(context, Target::RowDepths, room / 4, drawn / 4, out.depths); !s) return s;
  const bool hasShares = context.inputs.variant.glass || context.inputs.variant.bilinear;
  if (hasShares)
    if (Status s = context.attachMore(1, Target::RowShares, room / 4, context.rowRoom(), out.shares); !s) return s;
  Status drawnDepths = drawStrips(context, "rows", "passes/rowDepths.frag", definitions);
  context.detachMore(1);
  if (!drawnDepths) return drawnDepths;
  if (levels == 0) {
    context.recorder.skip(context.inputs.name + " tree", "settings.minMaxTree is false");
    out.tree = out.means = out.depths; // bound, never read
    return {};
  }
  Out finest;
  context.bind(gl::Unit::RowDepths, out.depths);
  if (hasShares) context.bind(gl::Unit::RowShares, out.shares);
  constexpr TreeTargets kFinest{Target::RowNodes, Target::RowNodeMeans, Target::RowNodeMoments};
  constexpr TreeTargets kAll{Target::RowTree, Target::RowMeans, Target::RowMoments};
  if (Status s = targets(context, kFinest, room / 16, drawn / 16, finest); !s) return s;
  if (Status s = context.draw("nodes", "passes/rowNodes.frag", definitions); !s) return s;
  context.bind(gl::Unit::RowNodes, finest.tree);
  context.bind(gl::Unit::RowNodeMeans, finest.means);
  if (finest.moments) context.bind(gl::Unit::RowNodeMoments, finest.moments);
  if (Status s = targets(context, kAll, treeNodes(room, 2, levels), treeNodes(drawn, 2, levels), out); !s) return s;
  Status drawnTree = context.draw("tree", "passes/rowTree.frag", definitions);
  context.detachMore(1);
  return drawnTree;
}

Status runPairs(SliceContext& context, const In& in, Out& out) {
  const int room = context.slices.rowTexels, drawn = context.slices.block.grid.z, levels = context.slices.block.grid.w;
  if (context.views() == 0 || levels == 0) return {};
  gl::Uint pairs = 0;
  context.selectDraw(in.draw);
  context.bindSlices();
  bind(context, out);
  setBlend(context.pass, Blend::Replace);
  const int groups = drawn / 4;
  if (Status s = target(context, Target::PairTree, treeNodes(room, 1, levels), groups, pairs); !s) return s;
  if (Status s = drawStrips(context, "pair groups", "passes/pairTree.frag", context.definitions); !s) return s;
  context.gl.Viewport(groups, 0, treeNodes(drawn, 2, levels), context.rows());
  if (Status s = context.draw("pair tree", "passes/pairTree.frag", context.definitions); !s) return s;
  out.tree = pairs;
  return {};
}

gl::Definitions definitionsOf(const exact::Variant& variant, bool tintSums) {
  gl::Definitions definitions = exact::definitionsOf(variant);
  if (tintSums) definitions.emplace_back("TINT_SUMS", 1);
  return definitions;
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  if (variant.shadowViews == 0) return {};
  const gl::Definitions pairs = exact::definitionsOf(variant);
  std::vector<gl::Variant> all = {inStrips("passes/pairTree.frag", pairs), {"passes/pairTree.frag", pairs}};
  for (int sums = 0; sums <= (variant.glass ? 1 : 0); ++sums) {
    const gl::Definitions definitions = definitionsOf(variant, sums == 1);
    all.push_back(inStrips("passes/rowDepths.frag", definitions));
    all.push_back({"passes/rowNodes.frag", definitions});
    all.push_back({"passes/rowTree.frag", definitions});
  }
  return all;
}

void bind(const SliceContext& context, const Out& rows) {
  context.bindMaps();
  if (rows.tree == 0) return;
  context.bind(gl::Unit::RowDepths, rows.depths);
  context.bind(gl::Unit::RowTree, rows.tree);
  context.bind(gl::Unit::RowMeans, rows.means);
  if (rows.shares) context.bind(gl::Unit::RowShares, rows.shares);
  if (rows.moments) context.bind(gl::Unit::RowMoments, rows.moments);
}

} // namespace tyndall::passes::rows
