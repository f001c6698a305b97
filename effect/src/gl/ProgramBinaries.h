// Linked programs in the engine's store, as the driver writes them.
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"

#include <string>
#include <tyndall/tyndall.h>
#include <utility>
#include <vector>

namespace tyndall::gl {

/// Without a store, or where the driver writes no binaries, nothing is found and nothing kept. What the store's
/// functions throw ends here: the program counts as not kept.
class ProgramBinaries {
public:
  ProgramBinaries(const Functions& gl, ProgramStore store) : gl_(gl), store_(std::move(store)) {}

  bool areKept();

  /// Of a program with these shader texts, in this driver.
  std::string keyOf(const std::vector<std::string>& texts) const;

  /// To be called before the program is linked.
  void makeRetrievable(Uint program) const { gl_.ProgramParameteri(program, PROGRAM_BINARY_RETRIEVABLE_HINT, 1); }

  /// Hands a kept program to the driver, which links it from that, or refuses it: its link status says so. False, and
  /// the program untouched, if the store has none that is whole and of a format of the driver's.
  bool load(Uint program, const std::string& key) const;

  /// Keeps a linked program.
  void save(Uint program, const std::string& key) const;

private:
  void askDriver();
  std::vector<std::uint8_t> loadBytes(const std::string& key) const;

  const Functions& gl_;
  ProgramStore store_;
  bool asked_ = false;       // what the driver can do
  std::vector<Int> formats_; // none: it writes no binaries
  std::string driver_;
};

} // namespace tyndall::gl
