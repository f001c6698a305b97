#include "passes/CurveRows.h"

#include <algorithm>

namespace tyndall::passes::curve_rows {

namespace {

constexpr const char* kCells = "passes/curveCells.frag";
constexpr const char* kTree = "passes/curveTree.frag";

// Nodes of all levels, down to one node over all cells; at least one, so that there is a texture.
int treeNodes(int cells) {
  int nodes = 0;
  for (int level = 1, count = cells; count > 1; ++level) {
    count = (cells + (1 << (2 * level)) - 1) >> (2 * level);
    nodes += count;
  }
  return std::max(nodes, 1);
}

} // namespace

Status run(SliceContext& context, Out& out) {
  if (!context.inputs.variant.curves || context.views() == 0) return {};
  const int cells = context.inputs.map.curvesSize, nodes = treeNodes(cells);
  const auto target = [&](Target which, int width, gl::Uint& texture) {
    Status status = context.target(which, width, context.rowRoom(), texture);
    context.gl.Viewport(0, 0, width, context.rows());
    return status;
  };
  context.bindSlices();
  context.bindMaps();
  setBlend(context.pass, Blend::Replace);
  if (Status s = target(Target::CurveCells, cells, out.cells); !s) return s;
  if (Status s = context.drawRows("curve cells", kCells, context.definitions); !s) return s;
  context.bind(gl::Unit::CurveCells, out.cells);
  if (Status s = target(Target::CurveTree, nodes, out.tree); !s) return s;
  return context.drawRows("curve tree", kTree, context.definitions);
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  if (!variant.curves) return {};
  const gl::Definitions definitions = exact::definitionsOf(variant);
  std::vector<gl::Variant> all = inRows(kCells, definitions);
  for (const gl::Variant& tree : inRows(kTree, definitions))
    all.push_back(tree);
  return all;
}

void bind(const SliceContext& context, const Out& curves) {
  if (curves.cells == 0) return;
  context.bind(gl::Unit::CurveCells, curves.cells);
  context.bind(gl::Unit::CurveTree, curves.tree);
}

} // namespace tyndall::passes::curve_rows
