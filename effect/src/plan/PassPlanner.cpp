#include "plan/PassPlanner.h"

#include "Rounding.h"

#include <algorithm>
#include <utility>

namespace tyndall {

gl::Uint Allocator::texture(Targets& targets, Resource resource, const Extent& extent, int side) {
  if (!makes_ || !status_) return 1;
  const gl::Uint name = targets.get(resource, extent, side);
  if (name == 0) {
    const Size size = rowOf(resource).size(extent);
    fail({StatusCode::OutOfMemory, std::string("GL could not allocate a texture of ") + std::to_string(size.width) +
                                       " x " + std::to_string(size.height) + " (" + rowOf(resource).name + ")"});
  }
  return name;
}

gl::Uint Allocator::stencil(Targets& targets, const Extent& extent) {
  if (!makes_ || !status_) return 1;
  const gl::Uint name = targets.stencil(extent);
  if (name == 0) fail({StatusCode::OutOfMemory, "GL could not allocate a stencil buffer"});
  return name;
}

// Formats of our own textures are ones that GL must render to: if they are refused there is no memory behind them.
gl::Uint Allocator::framebuffer(const Attachments& attachments, const std::string& field) {
  if (!makes_ || !status_) return 1;
  const gl::Uint name = framebuffers_.get(attachments);
  if (name == 0 && attachments.engines)
    fail({StatusCode::InvalidFrame, "Frame::" + field + ": this context cannot render to the texture's format"});
  if (name == 0) fail({StatusCode::OutOfMemory, "GL has no memory behind the textures of a pass"});
  return name;
}

void Allocator::fail(Status status) {
  if (status_) status_ = std::move(status);
}

// ---------------------------------------------------------------------------------------------------------------------

void PassPlanner::draw(Pass pass, const DrawOptions& options) { draw(pass, titleOf(rowOf(pass).name), options); }

void PassPlanner::draw(Pass pass, const std::string& title, const DrawOptions& options) {
  const PassRow& row = rowOf(pass);
  const bool changes = isOverChanges(row.shape);
  Draw draw;
  draw.title = title;
  draw.variant = variantOf(pass, variant, options.options);
  draw.firstVertex = firstVertexOf(pass, changes);
  draw.blend = options.blend.value_or(blendOf(row.joining));
  draw.stencil = stencilFor(row.shape, options.stencil);
  draw.counting = options.counting;
  draw.blocks = {frameBlock, lightBlock, epipolarBlock};
  addReads(row, draw);
  addTarget(row, options, draw);
  if (options.viewport) draw.viewport = *options.viewport;
  addBands(row, draw);
  addVertices(row.shape, changes, draw);
  if (options.clearTo) plan.steps.emplace_back(Clear{draw.framebuffer, 0, {*options.clearTo, 0, 0, *options.clearTo}});
  plan.steps.emplace_back(std::move(draw));
}

void PassPlanner::drawLight(Pass pass, const std::string& title, DrawOptions options) {
  if (firstLight && drawIndex == 0 && destination.transmittance != 0) {
    draw(Pass::Transmittance, rowOf(Pass::Transmittance).name, {{}, options.stencil});
    options.blend = Blend::Add;
  }
  draw(pass, title, options);
}

void PassPlanner::clear(Resource resource, float red) {
  board[resource] = textureOf(resource);
  plan.steps.emplace_back(Clear{imageTarget({board[resource]}, false), 0, {red, 0, 0, red}});
}

void PassPlanner::clearStencil() {
  clearStencil(drawsMarked || extent.sampledDepth ? Stencil::kServed : Stencil::kAll);
}

void PassPlanner::clearStencil(gl::Uint bits) {
  const gl::Uint target = destinationTarget(blendOf(Joining::SumOfLights), true);
  plan.steps.emplace_back(Clear{target, bits});
}

gl::Uint PassPlanner::textureOf(Resource resource) {
  const Lifetime lifetime = rowOf(resource).lifetime;
  return allocator.texture(holderOf(lifetime), resource, extent, sideOf(lifetime));
}

bool PassPlanner::isOverChanges(Shape shape) const {
  switch (shape) {
  case Shape::FullScreen:
  case Shape::Samples:
    return false;
  case Shape::Image:
  case Shape::ImageOfMarch:
    return drawnTiles != 0;
  default:
    return drawnSlices != 0;
  }
}

Stencil PassPlanner::stencilFor(Shape shape, Stencil stencil) const {
  if (!drawsMarked || (shape != Shape::Image && shape != Shape::ImageOfMarch)) return stencil;
  stencil.tested |= Stencil::kChanged;
  stencil.required |= Stencil::kChanged;
  return stencil;
}

// A shape's own come last: they are 0 where all is drawn.
void PassPlanner::addReads(const PassRow& row, Draw& draw) const {
  for (const Read& read : row.reads)
    draw.reads.push_back({read.as ? read.as : samplerOf(read.resource), board[read.resource], read.mayLack});
  draw.reads.push_back({samplerOf(Resource::ChangedTiles), drawnTiles, true});
  draw.reads.push_back({samplerOf(Resource::ChangedSlices), drawnSlices, true});
  draw.reads.push_back({samplerOf(Resource::ChangedSegments), drawnSegments, true});
}

void PassPlanner::addTarget(const PassRow& row, const DrawOptions& options, Draw& draw) {
  draw.viewport = {0, 0, extent.width, extent.height};
  const bool withStencil = !draw.stencil.isOff();
  switch (row.into) {
  case Into::Own:
    addOwnTarget(row, options.layer, withStencil, draw);
    break;
  case Into::Destination:
    draw.framebuffer = destinationTarget(draw.blend, withStencil);
    break;
  case Into::DebugView:
    draw.framebuffer = imageTarget({board[Resource::DebugView]}, withStencil);
    break;
  case Into::Colour:
    draw.framebuffer = imageTarget({destination.colour}, false);
    break;
  case Into::Output:
    draw.framebuffer = imageTarget({options.output}, false);
    break;
  case Into::Lookup:
    addLookupTarget(options, draw);
    break;
  }
}

void PassPlanner::addOwnTarget(const PassRow& row, int layer, bool withStencil, Draw& draw) {
  Attachments attachments;
  attachments.layers = {layer, layer, layer};
  if (withStencil) attachments.stencil = allocator.stencil(frameTargets, extent);
  std::size_t count = 0;
  for (const Resource resource : row.writes) {
    if (!rowOf(resource).exists(extent)) continue;
    board[resource] = textureOf(resource);
    attachments.colours[count++] = board[resource];
  }
  draw.framebuffer = allocator.framebuffer(attachments, {});
  const Size drawn = rowOf(row.writes.front()).drawn(extent);
  draw.viewport = {0, 0, drawn.width, drawn.height};
}

void PassPlanner::addLookupTarget(const DrawOptions& options, Draw& draw) {
  Attachments attachments;
  attachments.engines = true;
  static_assert(std::tuple_size_v<decltype(attachments.colours)> == LOOKUP_LAYERS);
  for (int i = 0; i < LOOKUP_LAYERS && options.layer + i < extent.lookupDepths; ++i) {
    attachments.colours[static_cast<std::size_t>(i)] = options.output;
    attachments.layers[static_cast<std::size_t>(i)] = options.layer + i;
  }
  draw.framebuffer = allocator.framebuffer(attachments, "lookup");
  draw.viewport = {0, 0, extent.lookup.width, extent.lookup.height};
}

// A draw that only adds brings no transmittance.
gl::Uint PassPlanner::destinationTarget(Blend blend, bool withStencil) {
  return imageTarget({destination.direct() ? destination.colour : destination.inscatter,
                      blend == Blend::Add ? 0 : destination.transmittance},
                     withStencil);
}

gl::Uint PassPlanner::imageTarget(std::array<gl::Uint, 3> colours, bool withStencil) {
  Attachments attachments{colours, withStencil ? allocator.stencil(frameTargets, extent) : 0};
  for (const Surface& engines : destination.engines)
    for (std::size_t i = 0; i < colours.size(); ++i) {
      if (colours[i] == 0 || colours[i] != engines.texture) continue;
      attachments.engines = true;
      attachments.layers[i] = engines.layer;
    }
  return allocator.framebuffer(attachments, colours[0] != 0 && colours[0] == destination.colour ? "colour" : "output");
}

// Where a draw may take longer than allowed at the slowest pace that is believed, it is watched.
void PassPlanner::addBands(const PassRow& row, Draw& draw) const {
  const double most = plan.bandMilliseconds;
  if (!(most > 0)) return;
  const Size target{draw.viewport.width, draw.viewport.height};
  const double nanoseconds = nanosecondsPerFragment(row, variant, paths);
  const double all = 1e-6 * nanoseconds * target.width * target.height;
  const bool learns = paces && row.walk != RayWalk::None && BandPaces::kMost * all > most;
  const double pace = learns ? paces->of(draw.title) : 1;
  draw.bands = bandsOf(target, pace * nanoseconds, most);
  if (learns) draw.bands.estimate = draw.bands.milliseconds / pace;
}

Blend PassPlanner::blendOf(Joining joining) const {
  switch (joining) {
  case Joining::SumOfDraws:
    return drawIndex == 0 ? Blend::Replace : Blend::AddAll;
  case Joining::SumOfLights:
    return !firstLight || drawIndex > 0 ? Blend::Add : destination.direct() ? Blend::DualSource : Blend::Replace;
  case Joining::AddAll:
    return Blend::AddAll;
  case Joining::BlendIntoColour:
    return Blend::DualSource;
  case Joining::OverwriteRgb:
    return Blend::Colour;
  default:
    return Blend::Replace;
  }
}

void PassPlanner::addVertices(Shape shape, bool changes, Draw& draw) const {
  constexpr int kStripLines = 64, kChangedLines = 8;
  const auto strips = [&](int lines) {
    const int each = changes ? kChangedLines : kStripLines;
    draw.vertices = 6;
    draw.instances = unitsFor(lines, each);
  };
  if (shape == Shape::Samples) {
    draw.vertices = 3 * extent.slices * extent.samples;
  } else if ((shape == Shape::Image || shape == Shape::ImageOfMarch) && changes) {
    draw.vertices = 6;
    draw.instances = tilesOf(extent);
  } else if (shape == Shape::StripsOfSlices || (changes && shape != Shape::Rows && shape != Shape::StripsOfRows)) {
    strips(extent.slices);
  } else if (shape == Shape::StripsOfRows || changes) {
    strips(extent.rows);
  }
}

} // namespace tyndall
