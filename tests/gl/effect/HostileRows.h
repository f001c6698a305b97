// What engines leave behind before they call the effect: a table that grows. HostileEngineTest.cpp runs it.
#pragma once

#include "GlState.h"

#include <functional>
#include <memory>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace tests {

/// An engine about to call the effect: its frame, and what its state names for as long as the call lasts.
struct HostileEngine {
  tyndall::Frame& frame;
  std::vector<host::GlTexture> textures = {};
  std::vector<host::GlSampler> samplers = {};
  std::vector<host::GlBuffer> buffers = {};
  std::vector<host::GlFramebuffer> framebuffers = {};
  std::vector<host::GlVertexArray> vertexArrays = {};
  std::vector<std::unique_ptr<host::Program>> programs = {};
  std::unique_ptr<Poison> poison = {};
};

/// In how many of the test's techniques, ways to reuse and debug views a row is run.
enum class Where { Once, Everywhere };

struct HostileRow {
  std::string name;
  std::function<void(HostileEngine&)> leave;
  Where where = Where::Once;
  int version = 33;         ///< of OpenGL that it needs
  std::string refusal = {}; ///< words of the message; empty: the picture is that of a clean state
  std::string error = {};   ///< words of the GL error that the engine itself makes
  std::function<void()> after = {};
};

const std::vector<HostileRow>& hostileRows();

/// GL's defaults again, for all that rows of the table change.
void leaveCleanState();

} // namespace tests
