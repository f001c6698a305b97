// tyndall-regress: scenes rendered again and compared with references.

#include "Arguments.h"
#include "Suite.h"

#include <render/CommandLine.h>
#include <scene/Error.h>
#include <scene/Tool.h>

namespace {

constexpr const char* kName = "tyndall-regress";
constexpr int kUnusable = 2; ///< wrong usage, or something cannot be read or written

int run(const regress::Arguments& arguments) {
  try {
    switch (arguments.command) {
    case regress::Command::Record:
      return regress::record(arguments);
    case regress::Command::Check:
      return regress::check(arguments);
    case regress::Command::Report:
      return regress::report(arguments);
    }
  } catch (const host::Error& error) {
    host::say(std::string(kName) + ": " + error.what());
  }
  return kUnusable;
}

} // namespace

int main(int argc, char** argv) {
  return render::runCommand(kName, [&] { return run(regress::parseCommand(argc, argv)); });
}
