#include "gl/Library.h"

#include "scene/Error.h"

#include <dlfcn.h>
#include <utility>

namespace host {

Library::Library(std::string context, std::initializer_list<const char*> files, const std::string& package)
    : context_(std::move(context)) {
  for (const char* file : files) {
    handle_ = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
    if (handle_) {
      file_ = file;
      return;
    }
  }
  throw Error("context " + context_ + ": " + *files.begin() + " cannot be opened; is " + package + " installed?");
}

void* Library::symbol(const char* name) const {
  void* address = dlsym(handle_, name);
  if (!address) {
    throw Error("context " + context_ + ": " + file_ + " lacks " + name);
  }
  return address;
}

} // namespace host
