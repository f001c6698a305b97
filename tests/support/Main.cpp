#include "support/FailureReport.h"

#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

int main(int argc, char** argv) {
  tests::reportFailures();
  return Catch::Session().run(argc, argv);
}
