// The GL context that tests run in. A test case after which the context reports GL errors fails.
#pragma once

#include "gl/Context.h"

namespace tests {

/// The kind that the environment's TYNDALL_TEST_CONTEXT names; the host's default if it is not set. Where it names
/// OSMesa and there is none, the run says so and is skipped: exit status 77.
host::ContextKind testContextKind();

/// How contexts of tests are made: of the profile that TYNDALL_TEST_PROFILE names, core, compatibility or embedded;
/// core if it is not set.
host::ContextOptions testContextOptions();

/// The one context of this process, made when first asked for, and current on return.
host::Context& testContext();

} // namespace tests
