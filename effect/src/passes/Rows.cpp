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

gl::Definitions inStripsOfRows(gl::Definitions definitions) {
  definitions.emplace_back("STRIPS_OF_ROWS", 1);
  return definitions;
}

gl::Definitions hashing(gl::Definitions definitions) {
  definitions.emplace_back("ROW_HASHES", 1);
  return definitions;
}

bool hasShares(const exact::Variant& variant) { return variant.glass || variant.bilinear; }

} // namespace

Status run(SliceContext& context, const In& in, Out& out) {
  if (Status s = runDepths(context, in, out); !s) return s;
  return runTree(context, in, out);
}

Status runDepths(SliceContext& context, const In& in, Out& out) {
  if (context.views() == 0) return {};
  const int room = context.slices.rowTexels, drawn = context.slices.block.grid.z;
  gl::Definitions definitions = inStripsOfRows(definitionsOf(context.inputs.variant, in.tintSums));
  context.selectDraw(in.draw);
  context.bindSlices();
  context.bindMaps();
  setBlend(context.pass, Blend::Replace);
  if (Status s = target(context, Target::RowDepths, room / 4, drawn / 4, out.depths); !s) return s;
  if (hasShares(context.inputs.variant)) {
    if (Status s = context.attachMore(1, Target::RowShares, room / 4, context.rowRoom(), out.shares); !s) return s;
    if (in.hashes) {
      definitions = hashing(definitions);
      if (Status s = context.attachMore(2, Target::RowHashes, room / 4, context.rowRoom(), out.hashes); !s) return s;
    }
  }
  Status status = context.drawStrips("rows", "passes/rowDepths.frag", definitions, context.rows(), false);
  context.detachMore(1);
  return status;
}

Status runTree(SliceContext& context, const In& in, Out& out) {
  if (context.views() == 0) return {};
  if (Status s = curve_rows::run(context, out.curves); !s) return s;
  const int room = context.slices.rowTexels, drawn = context.slices.block.grid.z, levels = context.slices.block.grid.w;
  const gl::Definitions definitions = definitionsOf(context.inputs.variant, in.tintSums);
  if (levels == 0) {
    context.recorder.skip(context.inputs.name + " tree", "settings.minMaxTree is false");
    out.tree = out.means = out.depths; // bound, never read
    return {};
  }
  Out finest;
  context.bindSlices();
  setBlend(context.pass, Blend::Replace);
  context.bind(gl::Unit::RowDepths, out.depths);
  if (out.shares) context.bind(gl::Unit::RowShares, out.shares);
  constexpr TreeTargets kFinest{Target::RowNodes, Target::RowNodeMeans, Target::RowNodeMoments};
  constexpr TreeTargets kAll{Target::RowTree, Target::RowMeans, Target::RowMoments};
  if (Status s = targets(context, kFinest, room / 16, drawn / 16, finest); !s) return s;
  if (Status s = context.drawRows("nodes", "passes/rowNodes.frag", definitions); !s) return s;
  context.bind(gl::Unit::RowNodes, finest.tree);
  context.bind(gl::Unit::RowNodeMeans, finest.means);
  if (finest.moments) context.bind(gl::Unit::RowNodeMoments, finest.moments);
  if (Status s = targets(context, kAll, treeNodes(room, 2, levels), treeNodes(drawn, 2, levels), out); !s) return s;
  Status drawnTree = context.drawRows("tree", "passes/rowTree.frag", definitions);
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
  if (Status s = context.drawStrips("pair groups", "passes/pairTree.frag", inStripsOfRows(context.definitions),
                                    context.rows(), false);
      !s)
    return s;
  context.gl.Viewport(groups, 0, treeNodes(drawn, 2, levels), context.rows());
  if (Status s = context.draw("pair tree", "passes/pairTree.frag", context.definitions); !s) return s;
  out.tree = pairs;
  return {};
}

Status copyDepths(SliceContext& context, const Out& from, Out& to) {
  struct Copy {
    Target which;
    gl::Uint from;
    gl::Uint& to;
  };
  const int room = context.slices.rowTexels, drawn = context.slices.block.grid.z;
  setBlend(context.pass, Blend::Replace);
  for (const Copy& copy :
       {Copy{Target::RowDepths, from.depths, to.depths}, Copy{Target::RowShares, from.shares, to.shares},
        Copy{Target::RowHashes, from.hashes, to.hashes}}) {
    if (copy.from == 0) continue;
    context.bind(gl::Unit::ViewImage, copy.from);
    if (Status s = target(context, copy.which, room / 4, drawn / 4, copy.to); !s) return s;
    if (Status s = context.drawRows("keep rows", "passes/copyTexels.frag", {}); !s) return s;
  }
  return {};
}

gl::Definitions definitionsOf(const exact::Variant& variant, bool tintSums) {
  gl::Definitions definitions = exact::definitionsOf(variant);
  if (tintSums) definitions.emplace_back("TINT_SUMS", 1);
  return definitions;
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  if (variant.shadowViews == 0) return {};
  std::vector<gl::Variant> all;
  const auto add = [&](const std::vector<gl::Variant>& some) { all.insert(all.end(), some.begin(), some.end()); };
  const gl::Definitions pairs = exact::definitionsOf(variant);
  all.push_back(inStrips("passes/pairTree.frag", inStripsOfRows(pairs))[0]);
  all.push_back({"passes/pairTree.frag", pairs});
  const gl::Definitions definitions = definitionsOf(variant, false), depths = inStripsOfRows(definitions);
  add(inStrips("passes/rowDepths.frag", depths));
  if (hasShares(variant)) add(inStrips("passes/rowDepths.frag", hashing(depths)));
  add(curve_rows::variantsOf(variant));
  add(inRows("passes/rowNodes.frag", definitions));
  add(inRows("passes/rowTree.frag", definitions));
  if (variant.glass) {
    const gl::Definitions sums = definitionsOf(variant, true);
    all.push_back(inStrips("passes/rowDepths.frag", inStripsOfRows(sums))[0]);
    all.push_back({"passes/rowNodes.frag", sums});
    all.push_back({"passes/rowTree.frag", sums});
  }
  return all;
}

void bind(const SliceContext& context, const Out& rows) {
  context.bindMaps();
  curve_rows::bind(context, rows.curves);
  if (rows.tree == 0) return;
  context.bind(gl::Unit::RowDepths, rows.depths);
  context.bind(gl::Unit::RowTree, rows.tree);
  context.bind(gl::Unit::RowMeans, rows.means);
  if (rows.shares) context.bind(gl::Unit::RowShares, rows.shares);
  if (rows.moments) context.bind(gl::Unit::RowMoments, rows.moments);
}

} // namespace tyndall::passes::rows
