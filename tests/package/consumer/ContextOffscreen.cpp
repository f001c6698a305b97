// By the project's own way to contexts: OSMesa, or EGL where there is none.
#include "Context.h"

#include <cstdio>
#include <gl/NativeContext.h>
#include <scene/Error.h>

void* (*openContext())(const char* name) {
  static std::unique_ptr<host::NativeContext> context;
  for (const auto create : {host::createOsmesaContext, host::createEglContext}) {
    try {
      context = create({});
      context->bind();
      return context->loader();
    } catch (const host::Error& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
  }
  return nullptr;
}
