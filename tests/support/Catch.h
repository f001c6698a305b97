// Catch2 by the names of its version 2, whichever of 2 (Debian 12) and 3 (Debian 13) is installed. Every test includes
// this. Who defines CATCH_CONFIG_EXTERNAL_INTERFACES before gets listeners, CATCH_CONFIG_RUNNER the session.
#pragma once

#if __has_include(<catch2/catch.hpp>)

#include <catch2/catch.hpp>
#include <string>

#ifdef CATCH_CONFIG_EXTERNAL_INTERFACES
namespace Catch {

/// What a listener's assertionEnded returns.
using AssertionEnded = bool;

inline const std::string& nameOf(const TestCaseStats& stats) { return stats.testInfo.name; }

} // namespace Catch
#endif

#else

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <string>
#ifdef CATCH_CONFIG_EXTERNAL_INTERFACES
#include <catch2/catch_test_case_info.hpp>
#include <catch2/reporters/catch_reporter_event_listener.hpp>
#include <catch2/reporters/catch_reporter_registrars.hpp>
#endif
#ifdef CATCH_CONFIG_RUNNER
#include <catch2/catch_session.hpp>
#endif

using Catch::Approx;

namespace Catch {

using Matchers::StartsWith;

// NOLINTNEXTLINE(readability-identifier-naming): version 2's name
inline Matchers::StringContainsMatcher Contains(const std::string& text) { return Matchers::ContainsSubstring(text); }

#ifdef CATCH_CONFIG_EXTERNAL_INTERFACES
using TestEventListenerBase = EventListenerBase;
using AssertionEnded = void;

inline const std::string& nameOf(const TestCaseStats& stats) { return stats.testInfo->name; }
#endif

} // namespace Catch

#endif
