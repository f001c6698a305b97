#include "Processes.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Tool.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace regress {

namespace {

constexpr int kMostChildren = 256;
constexpr int kEndingSignals[] = {SIGHUP, SIGINT, SIGTERM};

volatile sig_atomic_t interrupted = 0;       ///< the signal; 0: none
volatile pid_t children[kMostChildren] = {}; ///< 0: none. Read by the signal handler

/// Their files in the making go with them.
void endChildren(int signal) {
  interrupted = signal;
  for (const volatile pid_t& child : children)
    if (child > 0) kill(child, SIGTERM);
}

/// Holds back the signals that end a run, so that the handler knows of every child.
class SignalsHeld {
public:
  SignalsHeld() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : kEndingSignals)
      sigaddset(&set, signal);
    sigprocmask(SIG_BLOCK, &set, &before_);
  }
  ~SignalsHeld() { release(); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;
  void release() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }

private:
  sigset_t before_{};
};

/// The handlers of a run, until it goes out of scope.
class Interruptible {
public:
  Interruptible() {
    interrupted = 0;
    struct sigaction action{};
    action.sa_handler = endChildren; // without SA_RESTART: waitpid() returns
    for (std::size_t i = 0; i < std::size(kEndingSignals); ++i) {
      sigaction(kEndingSignals[i], nullptr, &before_[i]);
      if (before_[i].sa_handler != SIG_IGN) sigaction(kEndingSignals[i], &action, nullptr); // nohup, say
    }
  }
  ~Interruptible() {
    for (std::size_t i = 0; i < std::size(kEndingSignals); ++i)
      sigaction(kEndingSignals[i], &before_[i], nullptr);
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

private:
  struct sigaction before_[std::size(kEndingSignals)]{};
};

[[noreturn]] void runChild(const std::function<int()>& task, unsigned timeoutSeconds, const SignalsHeld& held,
                           pid_t parent) {
  for (const int signal : kEndingSignals)
    std::signal(signal, SIG_DFL);
  host::removeUnfinishedOnSignals();
  std::signal(SIGALRM, host::endWithoutUnfinished);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  held.release();
  if (getppid() != parent) _exit(1);
  alarm(timeoutSeconds);
  const int status = host::runTool("tyndall-regress", task);
  _exit(status); // drivers' threads and destructors are of no use any more
}

/// Its place in `children`.
std::size_t begin(const std::function<int()>& task, unsigned timeoutSeconds) {
  const auto place = static_cast<std::size_t>(std::find(std::begin(children), std::end(children), 0) - children);
  std::fflush(nullptr);
  const SignalsHeld held;
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw host::Error(std::string("a process cannot be made: ") + std::strerror(errno));
  if (child == 0) runChild(task, timeoutSeconds, held, parent);
  children[place] = child;
  return place;
}

struct Ended {
  std::size_t place;
  Ending ending;
};

/// Waits for a child; one whose pid is not ours does not count.
Ended waitForOne() {
  while (true) {
    int status = 0;
    const pid_t child = waitpid(-1, &status, 0);
    if (child < 0 && errno == EINTR) continue;
    if (child < 0) throw host::Error(std::string("a process was lost: ") + std::strerror(errno));
    auto* const place = std::find(std::begin(children), std::end(children), child);
    if (place == std::end(children)) continue;
    *place = 0;
    const Ending ending{WIFEXITED(status) ? WEXITSTATUS(status) : 0, WIFSIGNALED(status) ? WTERMSIG(status) : 0};
    return {static_cast<std::size_t>(place - children), ending};
  }
}

std::string readAll(int descriptor) {
  std::string text;
  char buffer[4096];
  while (true) {
    const ssize_t count = read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

} // namespace

std::string describe(const Ending& ending, unsigned timeoutSeconds) {
  if (ending.signal == SIGALRM) return fmt::format("took more than {} s", timeoutSeconds);
  if (ending.signal != 0)
    return fmt::format("ended by signal {} ({})", ending.signal,
                       strsignal(ending.signal)); // NOLINT(concurrency-mt-unsafe)
  return fmt::format("ended with exit status {}", ending.exitCode);
}

int runAll(const std::vector<std::function<int()>>& tasks, int jobs, unsigned timeoutSeconds,
           const std::function<bool(std::size_t task, const Ending& ending)>& onEnd) {
  const Interruptible interruptible;
  const int most = std::clamp(jobs, 1, kMostChildren);
  std::size_t taskAt[kMostChildren] = {};
  std::size_t next = 0;
  int running = 0;
  bool goesOn = true;
  while (true) {
    while (goesOn && interrupted == 0 && next < tasks.size() && running < most) {
      taskAt[begin(tasks[next], timeoutSeconds)] = next;
      ++next;
      ++running;
    }
    if (running == 0) return interrupted;
    const Ended ended = waitForOne();
    --running;
    if (interrupted == 0 || ended.ending.signal == 0) goesOn = onEnd(taskAt[ended.place], ended.ending) && goesOn;
  }
}

std::string outputOf(const std::function<void(int descriptor)>& body) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return "";
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    try {
      body(ends[1]);
    } catch (const std::exception&) {
      _exit(1);
    }
    _exit(0);
  }
  close(ends[1]);
  const std::string text = child > 0 ? readAll(ends[0]) : "";
  close(ends[0]);
  int status = 1;
  if (child > 0)
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  return status == 0 ? text : "";
}

std::string outputOf(const std::vector<std::string>& command) {
  return outputOf([&](int descriptor) {
    std::vector<char*> words;
    words.reserve(command.size() + 1);
    for (const std::string& word : command)
      words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nothing >= 0) dup2(nothing, STDERR_FILENO);
    dup2(descriptor, STDOUT_FILENO);
    execvp(words[0], words.data());
    _exit(1);
  });
}

} // namespace regress
