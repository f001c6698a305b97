// Carries a plan out. Nothing in it can fail but by a lost context; nothing waits, but for what betweenDraws does.
#pragma once

#include "BandPaces.h"
#include "PassRecorder.h"
#include "gl/ProgramCache.h"
#include "gl/StateGuard.h"
#include "plan/BlockBuffers.h"
#include "plan/FramePlan.h"

#include <functional>

namespace tyndall {

/// What all draws share.
struct DrawObjects {
  gl::Uint vertexArray = 0;
  gl::Uint nearestSampler = 0; ///< nearest, clamped, compare mode off: engine textures keep their own parameters
  gl::Uint emptyTexture = 0;   ///< what a sampler reads that has nothing to read
  const BlockBuffers& blocks;  ///< the plan's
};

/// Texture units and targets that a plan's programs read, and what else of GL's state its draws change.
struct UnitsUsed {
  int count = 0;
  gl::TextureKinds kinds;
  bool stencil = false, scissor = false, copies = false;
};

/// Starts to build the plan's programs.
void requestPrograms(const FramePlan& plan, gl::ProgramCache& programs);

/// A plan that is to be drawn has its textures, one made ahead of its frame may not.
enum class Resolve { Ahead, ToDraw };

/// Has every draw know its program and where its textures go; ShaderError if a program does not build, or if a draw
/// would read what nothing has made.
Status resolvePrograms(FramePlan& plan, gl::ProgramCache& programs, Resolve what);

UnitsUsed unitsOf(const FramePlan& plan);

/// False: `betweenDraws` did not want the rest.
bool drawPlan(const FramePlan& plan, const gl::Functions& gl, const DrawObjects& objects, PassRecorder& recorder,
              BandPaces& paces, const std::function<bool()>& betweenDraws);

} // namespace tyndall
