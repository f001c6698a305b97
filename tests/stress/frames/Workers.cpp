#include "Workers.h"

#include "LoopCounter.h"

#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <poll.h>
#include <set>
#include <sys/wait.h>
#include <unistd.h>

namespace stress {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

bool finds(const Plan& plan, std::uint64_t seed, const AxisSet& simple, const std::string& check,
           tyndall::Effect& effect) {
  for (const Finding& finding : stress::check(makeCase(seed, simple), effect, plan.runs).findings)
    if (finding.check == check) return true;
  return false;
}

/// All axes at their simplest that the finding does not need. `lives` is called between two frames.
AxisSet shrunk(const Plan& plan, std::uint64_t seed, AxisSet simple, const std::string& check, tyndall::Effect& effect,
               const std::function<void()>& lives) {
  for (int i = 0; i < kAxes; ++i) {
    lives();
    const AxisSet simpler = simple.with(static_cast<Axis>(i));
    if (!simple.has(static_cast<Axis>(i)) && finds(plan, seed, simpler, check, effect)) simple = simpler;
  }
  return simple;
}

/// Lines to the process that watches. They are shorter than what a pipe takes at once.
void send(int pipe, const nlohmann::json& message) {
  const std::string line = message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  std::size_t sent = 0;
  while (sent < line.size()) {
    const ssize_t n = write(pipe, line.data() + sent, line.size() - sent);
    if (n < 0) _exit(3);
    sent += static_cast<std::size_t>(n);
  }
}

/// No pass may come near the 65,535 turns after which llvmpipe ends the loops of some invocations that run together,
/// each loop as long as the slowest of them, whatever they have left to do.
void addLoops(Report& report, std::uint64_t seed, const Plan& plan, const std::map<std::string, std::uint32_t>& turns) {
  constexpr std::uint32_t kEnd = 32768;
  report.addLoops(seed, turns);
  for (const auto& [name, most] : turns)
    if (most >= kEnd)
      report.addFinding(seed, {"loops: " + name, static_cast<double>(most), static_cast<double>(kEnd), ""},
                        plan.simple.text());
}

/// The seeds first, first + step, ... before `end`.
[[noreturn]] void work(const Plan& plan, std::uint64_t first, std::uint64_t end, std::uint64_t step, double seconds,
                       int pipe) {
  const auto start = Clock::now();
  tyndall::Config config;
  config.loader = tests::testContext().loader();
  std::optional<LoopCounter> loops;
  if (plan.loops) config.loader = loops.emplace().loader();
  const std::unique_ptr<tyndall::Effect> effect = tyndall::Effect::create(config).effect;
  if (!effect) _exit(2);
  std::map<std::string, int> shrunkOf;
  for (std::uint64_t seed = first; seed < end && (seconds <= 0 || secondsSince(start) < seconds); seed += step) {
    send(pipe, {{"begin", seed}});
    const auto begin = Clock::now();
    Report report;
    const Outcome outcome = check(makeCase(seed, plan.simple), *effect, plan.runs, plan.pictures);
    report.add(seed, outcome, secondsSince(begin));
    if (loops) addLoops(report, seed, plan, loops->take());
    for (const Finding& finding : outcome.findings) {
      AxisSet simple = plan.simple;
      if (plan.shrink && ++shrunkOf[finding.check] <= 3)
        simple = shrunk(plan, seed, simple, finding.check, *effect, [&] { send(pipe, {{"begin", seed}}); });
      report.addFinding(seed, finding, simple.text());
    }
    send(pipe, {{"end", seed}, {"report", report.json()}});
  }
  _exit(0);
}

struct Worker {
  pid_t process = -1;
  int pipe = -1;
  std::uint64_t next = 0;            ///< seed that it has not begun
  std::optional<std::uint64_t> seed; ///< that it is drawing
  Clock::time_point since;
  std::string rest; ///< of a line
};

class Watch {
public:
  Watch(const Plan& plan, const std::function<void(const std::string&)>& said) : plan_(plan), said_(said) {}

  Report run() {
    for (int i = 0; i < plan_.jobs; ++i) {
      Worker worker;
      worker.next = plan_.first + static_cast<std::uint64_t>(i);
      workers_.push_back(worker);
    }
    for (Worker& worker : workers_)
      begin(worker);
    while (std::any_of(workers_.begin(), workers_.end(), [](const Worker& w) { return w.process > 0; }))
      step();
    return std::move(report_);
  }

private:
  std::uint64_t end() const { return plan_.first + plan_.count; }

  void begin(Worker& worker) {
    const double left = plan_.seconds > 0 ? plan_.seconds - secondsSince(start_) : 0;
    worker.process = -1;
    worker.seed.reset();
    worker.since = Clock::now();
    if (worker.next >= end() || (plan_.seconds > 0 && left <= 0)) return;
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    worker.process = fork();
    if (worker.process == 0) {
      close(ends[0]);
      work(plan_, worker.next, end(), static_cast<std::uint64_t>(plan_.jobs), left, ends[1]);
    }
    close(ends[1]);
    worker.pipe = ends[0];
  }

  void step() {
    std::vector<pollfd> waits;
    for (const Worker& worker : workers_)
      if (worker.process > 0) waits.push_back({worker.pipe, POLLIN, 0});
    poll(waits.data(), waits.size(), 1000);
    for (Worker& worker : workers_) {
      if (worker.process <= 0) continue;
      for (const pollfd& wait : waits)
        if (wait.fd == worker.pipe && wait.revents != 0) read(worker);
      if (worker.process > 0 && secondsSince(worker.since) > plan_.hangSeconds) kill(worker.process, SIGKILL);
    }
  }

  void read(Worker& worker) {
    char buffer[65536];
    const ssize_t n = ::read(worker.pipe, buffer, sizeof buffer);
    if (n <= 0) {
      ended(worker);
      return;
    }
    worker.rest.append(buffer, static_cast<std::size_t>(n));
    for (std::size_t line; (line = worker.rest.find('\n')) != std::string::npos; worker.rest.erase(0, line + 1))
      take(worker, nlohmann::json::parse(worker.rest.substr(0, line)));
  }

  void take(Worker& worker, const nlohmann::json& message) {
    worker.since = Clock::now();
    if (message.contains("begin")) {
      worker.seed = message["begin"].get<std::uint64_t>();
      worker.next = *worker.seed + static_cast<std::uint64_t>(plan_.jobs);
      return;
    }
    worker.seed.reset();
    report_.merge(message.at("report"));
    for (const nlohmann::json& finding : message.at("report").at("findings"))
      tell(finding);
  }

  void ended(Worker& worker) {
    int status = 0;
    waitpid(worker.process, &status, 0);
    close(worker.pipe);
    worker.process = -1;
    worker.rest.clear();
    if (!worker.seed) {
      if (status != 0) throw std::runtime_error("a worker cannot begin");
      return;
    }
    Report report;
    const bool isHang = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
    report.addFinding(*worker.seed, {isHang ? "hang" : "crash", 0, 0, fmt::format("wait status {}", status)},
                      plan_.simple.text());
    report_.merge(report.json());
    tell(report.json()["findings"][0]);
    begin(worker);
  }

  void tell(const nlohmann::json& finding) {
    const auto number = [&](const char* name) { return finding[name].is_number() ? finding[name].get<double>() : NAN; };
    const std::string simple = finding["simple"];
    said_(fmt::format("tyndall-stress --first {} --count 1{}   # {}: {:.3g}, limit {:.3g} {}",
                      finding["seed"].get<std::uint64_t>(), simple.empty() ? "" : " --simple " + simple,
                      finding["check"].get<std::string>(), number("value"), number("limit"),
                      finding["detail"].get<std::string>()));
  }

  const Plan& plan_;
  const std::function<void(const std::string&)>& said_;
  Clock::time_point start_ = Clock::now();
  std::vector<Worker> workers_;
  Report report_;
};

} // namespace

Report run(const Plan& plan, const std::function<void(const std::string&)>& said) { return Watch(plan, said).run(); }

} // namespace stress
