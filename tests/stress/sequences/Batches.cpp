#include "Batches.h"

#include "Shrink.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace tyndall;

namespace stress {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kFreshEvery = 50; // sequences whose reference is a fresh effect for each frame
constexpr std::size_t kMostFailures = 100, kMostText = 1000;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What a batch's process leaves where the other sees it, whatever becomes of it.
struct Shared {
  std::atomic<std::uint64_t> seed{0}; ///< the sequence under way
  std::atomic<long> begun{0}, failed{0};
  Tally tally;
  char failures[kMostFailures][kMostText] = {};
};

class SharedMemory {
public:
  SharedMemory() {
    void* at = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) throw std::runtime_error("no memory to share between processes");
    shared_ = new (at) Shared;
  }
  ~SharedMemory() { munmap(shared_, sizeof(Shared)); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  Shared* operator->() const { return shared_; }

private:
  Shared* shared_;
};

void report(Shared& shared, const Recipe& recipe, const std::string& trouble) {
  const std::string text = commandOf(recipe) + "\n    " + trouble;
  std::puts(text.c_str());
  std::fflush(stdout);
  const auto at = static_cast<std::size_t>(shared.failed++);
  if (at < kMostFailures) std::snprintf(shared.failures[at], kMostText, "%s", text.c_str());
}

bool isOver(const Plan& plan, Clock::time_point start) {
  return plan.seconds > 0 && secondsSince(start) >= plan.seconds;
}

/// The process of a batch.
class Worker {
public:
  Worker(const Plan& plan, Shared& shared, Clock::time_point start)
      : plan_(plan), shared_(shared), start_(start), reference_(context_.create().effect) {
    if (!reference_) throw std::runtime_error("no effect can be created");
  }
  void run(std::uint64_t first, std::uint64_t end) {
    for (std::uint64_t seed = first; seed < end && !isOver(plan_, start_); ++seed) {
      Recipe recipe = plan_.recipe;
      recipe.seed = seed;
      shared_.seed = seed;
      ++shared_.begun;
      std::optional<std::string> trouble = runOne(recipe, true);
      if (trouble && plan_.shrinks) {
        recipe = shrunk(recipe, *trouble, [&](const Recipe& smaller) { return runOne(smaller, false); });
        trouble = runOne(recipe, false);
      }
      if (trouble) report(shared_, recipe, *trouble);
    }
  }

private:
  std::optional<std::string> runOne(const Recipe& recipe, bool counts) {
    Sequence sequence(context_, recipe.seed % kFreshEvery == 0 ? nullptr : reference_.get(), recipe);
    sequence.describes = plan_.describes;
    std::optional<std::string> trouble = sequence.run();
    if (counts) shared_.tally.add(sequence.tally());
    return trouble;
  }

  const Plan& plan_;
  Shared& shared_;
  Clock::time_point start_;
  tests::FaultyContext context_;
  std::unique_ptr<Effect> reference_;
};

[[noreturn]] void work(const Plan& plan, Shared& shared, Clock::time_point start, std::uint64_t first,
                       std::uint64_t end) {
  prctl(PR_SET_PDEATHSIG, SIGKILL); // no batch without who waits for it
  int code = 0;
  try {
    Worker(plan, shared, start).run(first, end);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tyndall-stress-sequences: %s\n", error.what());
    code = 1;
  }
  std::fflush(stdout);
  std::_Exit(code);
}

/// Waits for a batch, and ends it where a sequence takes too long. What is wrong with it as a process; empty if
/// nothing.
std::string await(pid_t child, const Shared& shared, double patience) {
  long begun = -1;
  Clock::time_point since = Clock::now();
  for (int status = 0;;) {
    if (waitpid(child, &status, WNOHANG) == child) {
      if (WIFSIGNALED(status)) return std::string("crashes: ") + strsignal(WTERMSIG(status));
      return WEXITSTATUS(status) == 0 ? "" : "ends with " + std::to_string(WEXITSTATUS(status));
    }
    if (shared.begun != begun) since = Clock::now();
    begun = shared.begun;
    if (secondsSince(since) > patience) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return "hangs: more than " + std::to_string(static_cast<int>(patience)) + " s";
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

} // namespace

Outcome runBatches(const Plan& plan) {
  const Clock::time_point start = Clock::now();
  Outcome outcome;
  const std::uint64_t end = plan.first + plan.count;
  for (std::uint64_t first = plan.first; first < end && !isOver(plan, start);) {
    const std::uint64_t last = std::min(first + static_cast<std::uint64_t>(plan.batch), end);
    const SharedMemory shared;
    std::fflush(stdout);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process can be made");
    if (child == 0) work(plan, *shared.operator->(), start, first, last);
    const std::string trouble = await(child, *shared.operator->(), plan.patience);
    first = last;
    if (!trouble.empty()) {
      Recipe recipe = plan.recipe;
      recipe.seed = shared->seed;
      report(*shared.operator->(), recipe, trouble);
      first = std::max(shared->seed.load() + 1, plan.first + 1);
    }
    outcome.tally.add(shared->tally);
    outcome.failed += shared->failed;
    for (std::size_t i = 0; i < kMostFailures && shared->failures[i][0] != 0; ++i)
      outcome.failures.emplace_back(shared->failures[i]);
  }
  outcome.seconds = secondsSince(start);
  return outcome;
}

} // namespace stress
