#include "Tool.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <unistd.h>

namespace host {

namespace {

/// Opened the wrong way round: what is read or written there fails, as it did while it was closed.
void holdStandardStreams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY); // takes the lowest number, which is this one
  }
}

void throwOutputError() { throw Error(std::string("standard output: cannot be written: ") + std::strerror(errno)); }

int runGuarded(const char* name, const std::function<int()>& body) {
  try {
    const int status = body();
    errno = EIO; // if it failed earlier, the reason is gone
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throwOutputError();
    return status;
  } catch (const std::bad_alloc&) {
    say(std::string(name) + ": out of memory");
  } catch (const std::exception& error) {
    say(std::string(name) + ": " + error.what());
  }
  return 1;
}

} // namespace

int runTool(const char* name, const std::function<int()>& body) {
  holdStandardStreams();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  removeUnfinishedOnSignals();
  return runGuarded(name, body);
}

void say(std::string_view line) { sayRaw(printable(line) + "\n"); }

void sayRaw(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) throwOutputError();
}

} // namespace host
