// The libraries that bring contexts, which are opened at run time.
#pragma once

#include <initializer_list>
#include <string>

namespace host {

/// Stays open for good: drivers do not survive being unloaded.
class Library {
public:
  /// Opens the first of the files that there is; `context` and `package` are for the errors. Throws host::Error.
  Library(std::string context, std::initializer_list<const char*> files, const std::string& package);

  /// Sets `function` to the library's of that name. Throws host::Error if it has none.
  template <class Function>
  void resolve(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(symbol(name));
  }

private:
  void* symbol(const char* name) const;

  std::string context_, file_;
  void* handle_ = nullptr;
};

} // namespace host
