// Where the viewport begins elsewhere than at the first texel, or where a layer that is written is read as well,
// textures of ours stand in for the engine's: of the same format and as large as the viewport, so that all passes draw
// what they would draw into textures of just that size. GL copies the pixels there and back, and no others.
#include "plan/PlanFrame.h"

namespace tyndall {

// A layer is drawn into as it is, unless a later pass may read it, as composites read the outputs.
void FramePlanner::makeStandIns(bool drawsColour) {
  const bool elsewhere = frame_.viewport.x != 0 || frame_.viewport.y != 0;
  if (elsewhere && drawsColour) standIn(Resource::StandInColour, "colour", colour_);
  if (!elsewhere && (frame_.output.layer < 0 || frame_.colour == 0)) return;
  standIn(Resource::StandInInscatter, "inscatter", inscatter_);
  standIn(Resource::StandInTransmittance, "transmittance", transmittance_);
}

void FramePlanner::standIn(Resource resource, const std::string& title, Surface& surface) {
  if (surface.texture == 0) return;
  const Rectangle& viewport = frame_.viewport;
  const Viewport there{viewport.x, viewport.y, viewport.width, viewport.height};
  const bool isColour = resource == Resource::StandInColour;
  const gl::Uint engines = framebufferOf(surface, isColour ? "colour" : "output");
  surface = {passes_.textureOf(resource)};
  const gl::Uint ours = allocator_.framebuffer({{surface.texture}}, {});
  if (isColour) out_.plan.steps.emplace_back(Copy{title + " in", engines, ours, there});
  copiesBack_.push_back({title + " out", ours, engines, {0, 0, there.width, there.height}, there.x, there.y});
}

void FramePlanner::copyBack() {
  for (const Copy& copy : copiesBack_)
    out_.plan.steps.emplace_back(copy);
}

// A layer, which the pass that copies a texture does not read.
void FramePlanner::copyColourLayer() {
  const gl::Uint copy = passes_.board[Resource::ColourCopy] = passes_.textureOf(Resource::ColourCopy);
  out_.plan.steps.emplace_back(Copy{rowOf(Pass::CopyColour).name,
                                    framebufferOf(colour_, "colour"),
                                    allocator_.framebuffer({{copy}}, {}),
                                    {0, 0, frame_.viewport.width, frame_.viewport.height}});
}

gl::Uint FramePlanner::framebufferOf(const Surface& engines, const std::string& field) {
  return allocator_.framebuffer({{engines.texture}, 0, true, {engines.layer, -1, -1}}, field);
}

// Of what is drawn into, the engine's own.
std::vector<Surface> FramePlanner::engines() const {
  std::vector<Surface> surfaces;
  if (colour_.texture == frame_.colour) surfaces.push_back(colour_);
  if (inscatter_.texture == frame_.output.inscatter) surfaces.push_back(inscatter_);
  if (transmittance_.texture == frame_.output.transmittance) surfaces.push_back(transmittance_);
  return surfaces;
}

} // namespace tyndall
