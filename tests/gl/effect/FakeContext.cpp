#include "FakeContext.h"

using namespace tyndall;

namespace tests {

namespace {

// A loader is a plain function, so what it reads is global.
GlLoader realLoader = nullptr;
std::set<std::string> hiddenNames;
std::set<std::string> askedNames;
std::map<std::string, void*> replacedFunctions;

void* fakeLoader(const char* name) {
  askedNames.insert(name);
  if (hiddenNames.count(name) != 0) return nullptr;
  const auto found = replacedFunctions.find(name);
  return found != replacedFunctions.end() ? found->second : realLoader(name);
}

} // namespace

FakeContext::FakeContext(std::set<std::string> hidden, std::map<std::string, void*> replaced) {
  realLoader = testContext().loader();
  hiddenNames = std::move(hidden);
  replacedFunctions = std::move(replaced);
  askedNames.clear();
}

FakeContext::~FakeContext() {
  hiddenNames.clear();
  replacedFunctions.clear();
}

CreateResult FakeContext::create() const { return Effect::create({fakeLoader, PassTiming::Off}); }

GlLoader FakeContext::loader() const { return fakeLoader; }

const std::set<std::string>& FakeContext::askedFor() const { return askedNames; }

} // namespace tests
