// Processes that crash, hang and fail beside one that does its work.
#include "support/Catch.h"

#include <csignal>
#include <map>
#include <regress/Processes.h>
#include <unistd.h>

TEST_CASE("a task that crashes or hangs takes nothing else with it") {
  const std::vector<std::function<int()>> tasks = {[] {
                                                     std::signal(SIGSEGV, SIG_DFL);
                                                     raise(SIGSEGV);
                                                     return 0;
                                                   },
                                                   [] {
                                                     pause();
                                                     return 0;
                                                   },
                                                   [] { return 0; }, [] { return 3; }};
  for (const int jobs : {1, 4}) {
    std::map<std::size_t, std::string> endings;
    const int signal = regress::runAll(tasks, jobs, 1, [&](std::size_t task, const regress::Ending& ending) {
      endings[task] = regress::describe(ending, 1);
      return true;
    });
    CHECK(signal == 0);
    REQUIRE(endings.size() == 4);
    CHECK(endings[0].rfind("ended by signal 11 (", 0) == 0);
    CHECK(endings[1] == "took more than 1 s");
    CHECK(endings[2] == "ended with exit status 0");
    CHECK(endings[3] == "ended with exit status 3");
  }
}

TEST_CASE("no more tasks are begun once one says so") {
  int ends = 0;
  const std::vector<std::function<int()>> tasks(5, [] { return 0; });
  regress::runAll(tasks, 1, 10, [&](std::size_t, const regress::Ending&) { return ++ends < 2; });
  CHECK(ends == 2);
}

TEST_CASE("the output of a child is what it wrote, and nothing if it failed") {
  CHECK(regress::outputOf({"echo", "a b"}) == "a b\n");
  CHECK(regress::outputOf({"sh", "-c", "echo lost; exit 1"}).empty());
  CHECK(regress::outputOf({"/no/such/program"}).empty());
}
