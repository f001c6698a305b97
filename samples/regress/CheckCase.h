// One case, in a process of its own: rendered, and recorded or compared.
#pragma once

#include "CaseList.h"
#include "Reference.h"
#include "Result.h"

#include <string>
#include <vector>

namespace regress {

/// What all cases of a run share.
struct Run {
  References references;
  host::ContextKind context;
  std::string commit;
};

/// Renders and writes the reference; returns the notes. Throws host::Error.
std::vector<std::string> recordCase(const Case& one, const Run& run);

/// Renders, compares and writes the pictures and the result. Throws host::Error only if something cannot be written:
/// all else is a result.
void checkCase(const Case& one, const Run& run, const Results& results);

/// The result of a case that could not be judged.
Result failureOf(const Case& one, const Run& run, const std::string& message);

/// Changes with all that the result depends on but the driver: the case, its scene, its reference, this program.
std::string inputsOf(const Case& one, const References& references);

} // namespace regress
