// The test context with some of its functions hidden or replaced.
#pragma once

#include "support/TestContext.h"

#include <map>
#include <set>
#include <string>
#include <tyndall/tyndall.h>

namespace tests {

template <typename Function>
void* address(Function* function) {
  return reinterpret_cast<void*>(function);
}

/// While it lives, effects that its create() makes see the test context without the hidden functions and with others
/// replaced. One at a time.
class FakeContext {
public:
  explicit FakeContext(std::set<std::string> hidden = {}, std::map<std::string, void*> replaced = {});
  ~FakeContext();
  FakeContext(const FakeContext&) = delete;
  FakeContext& operator=(const FakeContext&) = delete;

  tyndall::CreateResult create() const;
  tyndall::GlLoader loader() const;              ///< for others than an effect
  const std::set<std::string>& askedFor() const; ///< names that the loader was asked for
};

} // namespace tests
