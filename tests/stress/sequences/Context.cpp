// The context of the sequences, where FaultyContext looks for the tests'.
#include "gl/Context.h"

#include "support/TestContext.h"

#include <cstdlib>

namespace tests {

host::ContextKind testContextKind() {
  const char* name = std::getenv("TYNDALL_TEST_CONTEXT");
  return name ? host::parseContextKind(name) : host::defaultContextKind();
}

host::ContextOptions testContextOptions() { return {}; }

host::Context& testContext() {
  static const std::unique_ptr<host::Context> context = host::Context::create(testContextKind(), testContextOptions());
  context->makeCurrent();
  return *context;
}

} // namespace tests
