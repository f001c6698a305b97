// The epipolar pipeline of one light: slices, rows with their min/max tree, march samples, interpolation, unwarp,
// fix-up (Chen 2011, Yusov 2013). Data flow and formats: Targets.cpp and the head of each shader named in Epipolar.cpp.
#pragma once

#include "CheckFrame.h"
#include "PassRecorder.h"
#include "Targets.h"
#include "passes/Exact.h"

#include <functional>

namespace tyndall::passes::epipolar {

struct In {
  const Frame* frame = nullptr;
  const Light* light = nullptr;
  FrameTextures::Shadow map;
  exact::Variant variant; ///< of this light
  Blend blend = Blend::Replace;
  std::string name; ///< of the light, for the statistics
  /// Binds the framebuffer that receives the light, without its transmittance for draws that only add.
  std::function<Status(bool withStencil, bool withTransmittance)> attachDestination;
  std::function<void(int binding, const void* data, std::size_t size)> upload;
};

/// Objects that outlive a frame.
struct Objects {
  gl::Framebuffer scratch; ///< for the effect's own targets
  gl::Query fixup;         ///< samples that unwarp served
};

/// Adds the light. The frame and light blocks must be bound.
Status run(const PassContext& context, Targets& targets, PassRecorder& recorder, const Objects& objects, const In& in);

/// Definitions of every shader variant that run() can ask for, by fragment shader.
std::vector<std::pair<std::string, gl::Definitions>> allVariants();

} // namespace tyndall::passes::epipolar
