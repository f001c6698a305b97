// Catch's own code, in executables with another main(), too.
#include "support/FailureReport.h"

#define CATCH_CONFIG_RUNNER
#include "support/Catch.h"

namespace tests {

int runTests(int argc, char** argv) {
  reportFailures();
  return Catch::Session().run(argc, argv);
}

} // namespace tests
