// The command line of tyndall-regress.
#pragma once

#include "CaseList.h"

#include <filesystem>
#include <gl/Context.h>
#include <optional>
#include <string>

namespace regress {

enum class Command { Record, Check, Report };

struct Arguments {
  Command command = Command::Check;
  std::filesystem::path list;
  std::filesystem::path references;
  std::filesystem::path out;    ///< of check and report
  std::filesystem::path scenes; ///< where relative names of scenes start
  std::optional<std::string> only;
  std::optional<render::Share> share;
  std::optional<host::ContextKind> context; ///< none: OSMesa, or EGL where it is not
  std::optional<std::string> commit;        ///< none: what git says
  int jobs = 1;
  int timeoutSeconds = 600; ///< of a case
  bool force = false;
  bool resume = false;
};

/// Throws render::UsageError or render::Answer.
Arguments parseCommand(int argc, const char* const* argv);

} // namespace regress
