// What the parts of a FaultyContext share.
#pragma once

#include "FaultyContext.h"

namespace tests::faulty {

struct State {
  Fault kind = Fault::None;
  int at = 0;
  Times times = Times::From;
  int seen = 0;
  bool triggered = false;

  int callsLeft = -1; ///< until the context is lost; negative: it is not going to be
  bool lost = false, toldOfReset = false;

  GLenum error = GL_NO_ERROR; ///< pending, besides the context's own

  GlCounts counts;
  std::set<std::string> unknown;

  Compiling compiling = Compiling::AtOnce;
  int maxTextureSize = 0;
  int binaryFormats = 1;
};

State& state();

/// Whether this call, one of those that the fault is of, fails.
bool fails(Fault kind);

/// As GL does: unless an error is pending already.
void recordError(GLenum error);

using Targets = std::map<Call, void*>;

/// What takes a function's place, by its part.
void replacePrograms(Targets& targets);    ///< VirtualPrograms.cpp
void replaceWaits(Targets& targets);       ///< GpuWaits.cpp
void replaceAllocations(Targets& targets); ///< FaultyContext.cpp

void clearPrograms();
void clearWaits();
void forgetBinaries();

template <typename Function>
void* addressOf(Function* function) {
  return reinterpret_cast<void*>(function);
}

} // namespace tests::faulty
