#include "support/FailureReport.h"

#define CATCH_CONFIG_RUNNER
#include "support/Catch.h"

int main(int argc, char** argv) {
  tests::reportFailures();
  return Catch::Session().run(argc, argv);
}
