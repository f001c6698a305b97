#include "passes/SliceContext.h"

#include "History.h"
#include "passes/Changes.h"

#include <algorithm>
#include <array>

namespace tyndall::passes {

namespace {

bool isWide(const SliceContext& context, Target which) {
  switch (which) {
  case Target::RowDepths:
  case Target::RowNodes:
  case Target::RowTree:
  case Target::PairTree:
    return context.slices.block.rowCode.w == 0;
  case Target::RowShares:
  case Target::RowNodeMeans:
  case Target::RowMeans:
    return context.inputs.variant.glass;
  default:
    return context.isColoured();
  }
}

constexpr const char* kChangedStrips = "passes/changedStrips.vert";
constexpr const char* kStrips = "passes/strips.vert";
constexpr int kStripLines = 64, kChangedLines = 8; // of a strip

gl::Definitions withChanges(gl::Definitions definitions) {
  definitions.emplace_back("CHANGED", 1);
  return definitions;
}

gl::Variant overChanges(const std::string& fragment, const gl::Definitions& definitions, Along along) {
  gl::Definitions with = withChanges(definitions);
  with.emplace_back("ALONG", static_cast<int>(along));
  return {fragment, with, kChangedStrips};
}

} // namespace

void SliceContext::selectDraw(int draw) {
  glm::ivec4& march = slices.block.march;
  const int first = draw * slices.viewsPerDraw;
  march = glm::ivec4(first, std::min(slices.viewsPerDraw, march.w - first), draw == 0 ? 1 : 0, march.w);
  inputs.upload(2, &slices.block, sizeof slices.block);
}

void SliceContext::bindMaps() const {
  if (inputs.variant.shadowViews == 0) return;
  const gl::Enum target = inputs.variant.shadowArray ? gl::TEXTURE_2D_ARRAY : gl::TEXTURE_2D;
  bindTexture(pass, gl::Unit::ShadowMap, target, inputs.light->shadow.texture);
  if (inputs.variant.curves) bindTexture(pass, gl::Unit::Curves, gl::TEXTURE_2D_ARRAY, inputs.light->curves.texture);
  if (!inputs.variant.glass) return;
  bindTexture(pass, gl::Unit::GlassColour, target, inputs.light->glass.colour);
  bindTexture(pass, gl::Unit::GlassDepth, target, inputs.light->glass.depth);
}

Status SliceContext::target(Target which, int width, int height, gl::Uint& texture) {
  texture = holderOf(which).get(which, width, height, isWide(*this, which));
  if (!texture) return slices::outOfMemory();
  gl.BindFramebuffer(gl::DRAW_FRAMEBUFFER, scratch.name());
  gl.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, gl::COLOR_ATTACHMENT0, gl::TEXTURE_2D, texture, 0);
  const gl::Enum buffer = gl::COLOR_ATTACHMENT0;
  gl.DrawBuffers(1, &buffer);
  gl.Viewport(0, 0, width, height);
  return {};
}

Status SliceContext::attachMore(gl::Enum index, Target which, int width, int height, gl::Uint& texture) {
  texture = holderOf(which).get(which, width, height, isWide(*this, which));
  if (!texture) return slices::outOfMemory();
  gl.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, gl::COLOR_ATTACHMENT0 + index, gl::TEXTURE_2D, texture, 0);
  const std::array<gl::Enum, 3> buffers = {gl::COLOR_ATTACHMENT0, gl::COLOR_ATTACHMENT0 + 1, gl::COLOR_ATTACHMENT0 + 2};
  gl.DrawBuffers(static_cast<gl::Sizei>(index + 1), buffers.data());
  return {};
}

void SliceContext::detachMore(gl::Enum kept) const {
  for (gl::Enum i = kept; i < 3; ++i)
    gl.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, gl::COLOR_ATTACHMENT0 + i, gl::TEXTURE_2D, 0, 0);
}

Status SliceContext::draw(const std::string& name, const std::string& fragment, const gl::Definitions& with) {
  const bool ok = recorder.run(inputs.name + " " + name, [&] { return drawFullScreen(pass, fragment, with); });
  return ok ? Status{} : shaderError();
}

Status SliceContext::drawImage(const std::string& name, const std::string& fragment, const gl::Definitions& with) {
  if (!inputs.tiles) return draw(name, fragment, with);
  bind(gl::Unit::ChangedTiles, inputs.tiles);
  const Frame& frame = *inputs.frame;
  const bool ok = recorder.run(inputs.name + " " + name, [&] {
    return changes::drawTiles(pass, {fragment, with}, frame.width, frame.height);
  });
  return ok ? Status{} : shaderError();
}

Status SliceContext::drawSlices(const std::string& name, const std::string& fragment, const gl::Definitions& with,
                                Along along) {
  if (!changedSlices) return draw(name, fragment, with);
  bindChanges();
  const int lines = along == Along::Rows ? rows() : slices.count;
  const bool ok = recorder.run(inputs.name + " " + name, [&] {
    return passes::drawStrips(pass, overChanges(fragment, with, along), lines, kChangedLines);
  });
  return ok ? Status{} : shaderError();
}

Status SliceContext::drawRows(const std::string& name, const std::string& fragment, const gl::Definitions& with) {
  return drawSlices(name, fragment, with, Along::Rows);
}

Status SliceContext::drawStrips(const std::string& name, const std::string& fragment, const gl::Definitions& with,
                                int lines, bool counted) {
  if (changedSlices) bindChanges();
  const gl::Variant variant{fragment, changedSlices ? withChanges(with) : with, kStrips};
  const auto strips = [&] {
    return passes::drawStrips(pass, variant, lines, changedSlices ? kChangedLines : kStripLines);
  };
  const std::string title = inputs.name + " " + name;
  const bool ok = counted ? recorder.runCounted(title, strips) : recorder.run(title, strips);
  return ok ? Status{} : shaderError();
}

void SliceContext::bindChanges() const {
  bind(gl::Unit::ChangedSlices, changedSlices);
  if (changedSegments) bind(gl::Unit::ChangedSegments, changedSegments);
}

// What the next frame needs is the light's own. Rows that do not stand in one texture are made anew.
Targets& SliceContext::holderOf(Target which) const {
  LightHistory* history = inputs.history;
  if (!history) return targets;
  switch (which) {
  case Target::SampleEnds:
    return history->ends[history->endsSide];
  case Target::RowDepths:
  case Target::RowShares:
  case Target::RowHashes:
    return draws() == 1 ? history->rows[history->rowsSide] : targets;
  case Target::RowTree:
  case Target::RowMeans:
  case Target::RowMoments:
  case Target::CurveCells:
  case Target::CurveTree:
    return draws() == 1 ? history->kept : targets;
  case Target::SliceTable:
  case Target::Marched:
  case Target::EpipolarInscatter:
  case Target::ChangedSegments:
  case Target::ChangedSlices:
  case Target::MovedSlices:
    return history->kept;
  default:
    return targets;
  }
}

std::vector<gl::Variant> inSlices(const char* fragment, const gl::Definitions& definitions, Along along) {
  return {{fragment, definitions}, overChanges(fragment, definitions, along)};
}

std::vector<gl::Variant> inRows(const char* fragment, const gl::Definitions& definitions) {
  return inSlices(fragment, definitions, Along::Rows);
}

std::vector<gl::Variant> inStrips(const char* fragment, const gl::Definitions& definitions) {
  return {{fragment, definitions, kStrips}, {fragment, withChanges(definitions), kStrips}};
}

} // namespace tyndall::passes
