#include "support/TestContext.h"

#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "support/Catch.h"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace tests {

namespace {

host::Context* theContext = nullptr; ///< null until a test asks for it

/// Reports GL errors while the section in which they arose still runs, so that they count as its failures.
class GlErrorListener : public Catch::TestEventListenerBase {
public:
  using Catch::TestEventListenerBase::TestEventListenerBase;

  void testRunStarting(const Catch::TestRunInfo& /*info*/) override {
    constexpr int kSkipped = 77; // CMake's SKIP_RETURN_CODE of these tests
    if (testContextKind() == host::ContextKind::Osmesa && !host::isOsmesaInstalled()) {
      std::puts("skipped: libOSMesa is not installed");
      std::exit(kSkipped);
    }
  }

  void sectionEnded(const Catch::SectionStats& stats) override {
    if (!theContext) {
      return;
    }
    for (const std::string& error : theContext->takeErrors()) {
      FAIL_CHECK("GL error in \"" << stats.sectionInfo.name << "\": " << error);
    }
  }
};

CATCH_REGISTER_LISTENER(GlErrorListener)

} // namespace

host::ContextKind testContextKind() {
  const char* name = std::getenv("TYNDALL_TEST_CONTEXT");
  return name ? host::parseContextKind(name) : host::defaultContextKind();
}

host::ContextOptions testContextOptions() {
  const char* const set = std::getenv("TYNDALL_TEST_PROFILE");
  const std::string name = set ? set : "core";
  host::ContextOptions options;
  if (name == "compatibility")
    options.profile = host::ContextProfile::Compatibility;
  else if (name == "embedded")
    options.profile = host::ContextProfile::Embedded;
  else if (name != "core")
    throw std::runtime_error("TYNDALL_TEST_PROFILE is '" + name + "': must be core, compatibility or embedded");
  return options;
}

host::Context& testContext() {
  static const std::unique_ptr<host::Context> context = host::Context::create(testContextKind(), testContextOptions());
  theContext = context.get();
  context->makeCurrent();
  return *context;
}

} // namespace tests
