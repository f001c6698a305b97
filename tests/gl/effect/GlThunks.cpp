#include "GlThunks.h"

#include <map>
#include <string>

namespace tests {

namespace {

template <Call kCall, typename Function>
struct Thunk;

template <Call kCall, typename Result, typename... Arguments>
struct Thunk<kCall, Result(GLAD_API_PTR*)(Arguments...)> {
  static Result GLAD_API_PTR call(Arguments... arguments) {
    CallRow& row = callRows()[static_cast<std::size_t>(kCall)];
    ++row.count;
    if (swallowsCall() && swallowsCall()(kCall)) return Result();
    return reinterpret_cast<Result(GLAD_API_PTR*)(Arguments...)>(row.target)(arguments...);
  }
};

struct Entry {
  const char* name;
  void* thunk;
};

const std::array<Entry, kCalls>& entries() {
  static const std::array<Entry, kCalls> all = {{
#define TESTS_GL_ENTRY(name)                                                                                           \
  {"gl" #name, reinterpret_cast<void*>(Thunk<Call::name, decltype(GladGLContext::name)>::call)},
      TESTS_GL_FUNCTIONS(TESTS_GL_ENTRY)
#undef TESTS_GL_ENTRY
  }};
  return all;
}

} // namespace

std::array<CallRow, kCalls>& callRows() {
  static std::array<CallRow, kCalls> rows;
  return rows;
}

Swallows& swallowsCall() {
  static Swallows swallows = nullptr;
  return swallows;
}

const char* nameOf(Call call) { return entries()[static_cast<std::size_t>(call)].name; }

Call callNamed(const char* name) {
  static const std::map<std::string, Call> indices = [] {
    std::map<std::string, Call> result;
    for (std::size_t i = 0; i < kCalls; ++i)
      result[entries()[i].name] = static_cast<Call>(i);
    return result;
  }();
  const auto found = indices.find(name);
  return found == indices.end() ? Call::Count : found->second;
}

void* thunkOf(Call call) { return entries()[static_cast<std::size_t>(call)].thunk; }

} // namespace tests
