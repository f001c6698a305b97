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
  if (Status s = context.target(which, width, context.slices.count, texture); !s) return s;
  context.gl.Viewport(0, 0, drawn, context.slices.count);
  return {};
}

// The same for two targets.
Status targets(SliceContext& context, Target first, Target second, int width, int drawn, gl::Uint& firstTexture,
               gl::Uint& secondTexture) {
  if (Status s = target(context, first, width, drawn, firstTexture); !s) return s;
  return context.attachMore(1, second, width, context.slices.count, secondTexture);
}

// Draws what has one fragment for four texels of a row, where rows are.
gl::Variant inStrips(const char* fragment, const exact::Variant& variant) {
  gl::Definitions definitions = exact::definitionsOf(variant);
  definitions.emplace_back("STRIPS_OF_ROWS", 1);
  return {fragment, definitions, "passes/strips.vert"};
}

Status drawStrips(SliceContext& context, const char* name, const char* fragment) {
  const gl::Variant v = inStrips(fragment, context.inputs.variant);
  const bool ok = context.recorder.run(context.inputs.name + " " + name, [&] {
    return drawStrips(context.pass, v.vertex, context.slices.count, v.fragment, v.definitions);
  });
  return ok ? Status{} : context.shaderError();
}

} // namespace

Status run(SliceContext& context, const In& in, Out& out) {
  if (context.views() == 0) return {};
  const int room = context.slices.rowTexels, drawn = context.slices.block.grid.z, levels = context.slices.block.grid.w;
  gl::Uint nodes = 0;
  context.selectView(in.view);
  context.bindSlices();
  context.bindMaps();
  setBlend(context.pass, Blend::Replace);
  if (Status s = target(context, Target::RowDepths, room / 4, drawn / 4, out.depths); !s) return s;
  if (Status s = drawStrips(context, "rows", "passes/rowDepths.frag"); !s) return s;
  if (levels == 0) {
    context.recorder.skip(context.inputs.name + " tree", "settings.minMaxTree is false");
    out.tree = out.averages = out.depths; // bound, never read
    return {};
  }
  gl::Uint nodeAverages = 0;
  context.bind(gl::Unit::RowDepths, out.depths);
  if (Status s = targets(context, Target::RowNodes, Target::RowNodeAverages, room / 16, drawn / 16, nodes, nodeAverages);
      !s)
    return s;
  if (Status s = context.draw("nodes", "passes/rowNodes.frag", context.definitions); !s) return s;
  context.bind(gl::Unit::RowNodes, nodes);
  context.bind(gl::Unit::RowNodeAverages, nodeAverages);
  const int roomNodes = treeNodes(room, 2, levels), drawnNodes = treeNodes(drawn, 2, levels);
  if (Status s = targets(context, Target::RowTree, Target::RowAverages, roomNodes, drawnNodes, out.tree, out.averages);
      !s)
    return s;
  const Status drawnTree = context.draw("tree", "passes/rowTree.frag", context.definitions);
  context.detachMore(1);
  return drawnTree;
}

Status runPairs(SliceContext& context, const In& in, Out& out) {
  const int room = context.slices.rowTexels, drawn = context.slices.block.grid.z, levels = context.slices.block.grid.w;
  if (context.views() == 0 || levels == 0) return {};
  gl::Uint pairs = 0;
  context.selectView(in.view);
  context.bindSlices();
  bind(context, out);
  setBlend(context.pass, Blend::Replace);
  const int groups = drawn / 4;
  if (Status s = target(context, Target::PairTree, treeNodes(room, 1, levels), groups, pairs); !s) return s;
  if (Status s = drawStrips(context, "pair groups", "passes/pairTree.frag"); !s) return s;
  context.gl.Viewport(groups, 0, treeNodes(drawn, 2, levels), context.slices.count);
  if (Status s = context.draw("pair tree", "passes/pairTree.frag", context.definitions); !s) return s;
  out.tree = pairs;
  return {};
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  if (variant.shadowViews == 0) return {};
  const gl::Definitions definitions = exact::definitionsOf(variant);
  return {inStrips("passes/rowDepths.frag", variant),
          {"passes/rowNodes.frag", definitions},
          {"passes/rowTree.frag", definitions},
          inStrips("passes/pairTree.frag", variant),
          {"passes/pairTree.frag", definitions}};
}

void bind(const SliceContext& context, const Out& rows) {
  context.bindMaps();
  if (rows.tree == 0) return;
  context.bind(gl::Unit::RowDepths, rows.depths);
  context.bind(gl::Unit::RowTree, rows.tree);
  context.bind(gl::Unit::RowAverages, rows.averages);
}

} // namespace tyndall::passes::rows
