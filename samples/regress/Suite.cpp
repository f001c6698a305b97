#include "Suite.h"

#include "CheckCase.h"
#include "Junit.h"
#include "Processes.h"
#include "Report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Tool.h>
#include <unistd.h>

namespace regress {

namespace {

constexpr int kDiffer = 1;
constexpr int kUnusable = 2;

std::vector<Case> casesOf(const Arguments& arguments) {
  std::vector<Case> cases = readCases(arguments.list, arguments.scenes);
  if (arguments.only) cases = only(cases, *arguments.only);
  if (arguments.share) cases = shareOf(cases, *arguments.share);
  return cases;
}

// ---------------------------------------------------------------------------------------------------------------------
// Where it runs

/// The driver of such a context; empty if there is none. In a process of its own: the library stays out of this one.
std::string driverOf(host::ContextKind kind) {
  return outputOf([kind](int descriptor) {
    const std::string driver = host::Context::create(kind)->driver();
    if (write(descriptor, driver.data(), driver.size()) < 0) _exit(1);
    _exit(0);
  });
}

struct Machine {
  host::ContextKind context = host::ContextKind::Osmesa;
  std::string driver;
};

Machine findMachine(const Arguments& arguments) {
  if (arguments.context) return {*arguments.context, driverOf(*arguments.context)};
  Machine machine{host::ContextKind::Osmesa, driverOf(host::ContextKind::Osmesa)};
  if (!machine.driver.empty()) return machine;
  host::say("OSMesa cannot be opened: the context is EGL's");
  return {host::ContextKind::Egl, driverOf(host::ContextKind::Egl)};
}

/// What git calls the state of the list's folder; empty where there is no git.
std::string commitOf(const Arguments& arguments) {
  if (arguments.commit) return *arguments.commit;
  const std::filesystem::path folder = arguments.list.has_parent_path() ? arguments.list.parent_path() : ".";
  std::string commit = outputOf({"git", "-C", folder.string(), "describe", "--always", "--dirty", "--abbrev=12"});
  while (!commit.empty() && std::isspace(static_cast<unsigned char>(commit.back())) != 0)
    commit.pop_back();
  return commit;
}

// ---------------------------------------------------------------------------------------------------------------------
// How far it is

class Progress {
public:
  explicit Progress(std::size_t count) : count_(count) {}

  void step(const std::string& name, const std::string& outcome) {
    ++done_;
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
    const long left = std::lround(time.count() / static_cast<double>(done_) * static_cast<double>(count_ - done_));
    const std::string rest = done_ < count_ ? fmt::format("; {:02d}:{:02d} left", left / 60, left % 60) : "";
    host::say(fmt::format("[{}/{}] {}: {}{}", done_, count_, name, outcome, rest));
  }

private:
  std::size_t count_;
  std::size_t done_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// In a child: what cannot be written is said with the case's name.
std::function<int()> taskOf(const Case& one, std::function<void()> body) {
  return [name = one.name, body = std::move(body)] {
    try {
      body();
      return 0;
    } catch (const std::exception& error) {
      host::say(fmt::format("tyndall-regress: case {}: {}", name, error.what()));
      return kUnusable;
    }
  };
}

/// Ends as the signal would have ended it, with a word on how to go on.
[[noreturn]] void endBySignal(int signal, std::size_t done, std::size_t count, const std::string& advice) {
  host::say(fmt::format("tyndall-regress: interrupted; {} of {} cases are done and kept: {}", done, count, advice));
  std::signal(signal, SIG_DFL);
  raise(signal);
  _exit(128 + signal);
}

// ---------------------------------------------------------------------------------------------------------------------
// record

/// Those whose reference is to be made; the others are named.
std::vector<Case> unrecorded(const std::vector<Case>& cases, const References& references, bool force) {
  std::vector<Case> left;
  for (const Case& one : cases)
    if (!force && references.exists(one.name))
      host::say(fmt::format("tyndall-regress: case {}: {} exists and is kept; record --force makes it anew", one.name,
                            references.pictureFile(one.name).string()));
    else
      left.push_back(one);
  return left;
}

void prepareReferences(const std::vector<Case>& cases, const Arguments& arguments, const References& references) {
  std::error_code failure;
  std::filesystem::create_directories(arguments.references, failure);
  if (failure) throw host::Error(arguments.references.string() + ": cannot be made: " + failure.message());
  for (const Case& one : cases) {
    host::requireWritable(references.pictureFile(one.name));
    host::requireWritable(references.sidecarFile(one.name));
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// check and report

bool isUpToDate(const Case& one, const Result& result, const References& references) {
  return result.inputs == inputsOf(one, references);
}

/// An earlier run's files are in the way, unless they are to be replaced or gone on with.
void refuseEarlierRun(const std::vector<Case>& cases, const Arguments& arguments, const Results& results) {
  const std::string advice = "--resume goes on with it, --force replaces it, or give another --out";
  if (std::filesystem::exists(results.reportFile()))
    throw host::Error(fmt::format("{}: is the report of an earlier run; {}", results.reportFile().string(), advice));
  for (const Case& one : cases)
    if (results.exists(one.name))
      throw host::Error(fmt::format("{}: holds a result of case {}; {}", arguments.out.string(), one.name, advice));
}

/// A page of somebody else's is not replaced.
void refuseForeignReport(const Results& results) {
  if (!std::filesystem::exists(results.reportFile())) return;
  std::ifstream stream(results.reportFile());
  std::string line;
  std::getline(stream, line);
  if (line != kReportMark)
    throw host::Error(results.reportFile().string() + ": exists and is no report of this tool; give another --out");
}

/// Those without a result of the same inputs and driver. What could not be judged is tried again.
std::vector<Case> unchecked(const std::vector<Case>& cases, const Machine& machine, const Run& run,
                            const Results& results) {
  std::vector<Case> left;
  for (const Case& one : cases) {
    const std::optional<Result> result = results.find(one.name);
    const bool isDone = result && result->verdict != Verdict::Failed && isUpToDate(one, *result, run.references) &&
                        result->origin.driver == machine.driver &&
                        result->origin.context == host::nameOf(machine.context);
    if (!isDone) left.push_back(one);
  }
  return left;
}

/// Of all cases: a result that is missing or out of date is a failure.
std::vector<Result> collected(const std::vector<Case>& cases, const Run& run, const Results& results) {
  std::vector<Result> all;
  for (const Case& one : cases) {
    const std::optional<Result> result = results.find(one.name);
    if (result && isUpToDate(one, *result, run.references))
      all.push_back(*result);
    else
      all.push_back(failureOf(one, run,
                              result ? "its result is out of date: list, scene, reference or program are others"
                                     : "there is no result of it"));
  }
  return all;
}

std::string timestamp() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc);
  return text;
}

int writeReport(const std::vector<Result>& all, const Arguments& arguments, const Results& results) {
  const std::string time = timestamp();
  host::writeText(results.reportFile(), reportPage(all, results, arguments.list.filename().string(), time + " UTC"));
  host::writeText(results.junitFile(), junitXml(all, time));
  const auto countOf = [&](Verdict verdict) {
    return std::count_if(all.begin(), all.end(), [&](const Result& result) { return result.verdict == verdict; });
  };
  for (const Result& result : all)
    if (result.verdict != Verdict::Same)
      host::print(fmt::format("{}: {}\n", result.name, host::printable(summaryOf(result))));
  host::print(fmt::format("{} cases: {} same, {} different, {} failed: {}\n", all.size(), countOf(Verdict::Same),
                          countOf(Verdict::Different), countOf(Verdict::Failed), results.reportFile().string()));
  return countOf(Verdict::Same) == static_cast<std::ptrdiff_t>(all.size()) ? 0 : kDiffer;
}

/// How many of a share's cases are not the same.
int statusOf(const std::vector<Result>& all) {
  return std::all_of(all.begin(), all.end(), [](const Result& r) { return r.verdict == Verdict::Same; }) ? 0 : kDiffer;
}

} // namespace

int record(const Arguments& arguments) {
  const std::vector<Case> cases = casesOf(arguments);
  const References references(arguments.references);
  const std::vector<Case> left = unrecorded(cases, references, arguments.force);
  prepareReferences(left, arguments, references);
  int status = left.size() < cases.size() ? kUnusable : 0;
  if (left.empty()) return status;
  const Run run{references, findMachine(arguments).context, commitOf(arguments)};
  std::vector<std::function<int()>> tasks;
  tasks.reserve(left.size());
  for (const Case& one : left)
    tasks.push_back(taskOf(one, [&one, &run] {
      for (const std::string& note : recordCase(one, run))
        host::say(fmt::format("note: case {}: {}", one.name, note));
    }));
  Progress progress(left.size());
  std::size_t done = 0;
  const int signal =
      runAll(tasks, arguments.jobs, arguments.timeoutSeconds, [&](std::size_t task, const Ending& ending) {
        const bool isDone = ending.signal == 0 && ending.exitCode == 0;
        done += isDone ? 1 : 0;
        if (!isDone) status = kUnusable;
        progress.step(left[task].name, isDone ? "recorded" : "failed: " + describe(ending, arguments.timeoutSeconds));
        return true;
      });
  if (signal != 0) endBySignal(signal, done, left.size(), "the same command records the others");
  return status;
}

int check(const Arguments& arguments) {
  const std::vector<Case> cases = casesOf(arguments);
  const Results results(arguments.out);
  if (!arguments.force && !arguments.resume) refuseEarlierRun(cases, arguments, results);
  refuseForeignReport(results);
  results.prepare();
  const Machine machine = findMachine(arguments);
  const Run run{References(arguments.references), machine.context, commitOf(arguments)};
  if (arguments.force)
    for (const Case& one : cases)
      results.remove(one.name);
  results.removeReport();
  const std::vector<Case> left = unchecked(cases, machine, run, results);
  if (left.size() < cases.size())
    host::say(fmt::format("{} of {} cases are done already", cases.size() - left.size(), cases.size()));
  std::vector<std::function<int()>> tasks;
  tasks.reserve(left.size());
  for (const Case& one : left)
    tasks.push_back(taskOf(one, [&] { checkCase(one, run, results); }));
  Progress progress(left.size());
  std::size_t done = cases.size() - left.size();
  bool canWrite = true;
  const int signal =
      runAll(tasks, arguments.jobs, arguments.timeoutSeconds, [&](std::size_t task, const Ending& ending) {
        const Case& one = left[task];
        if (ending.signal == 0 && ending.exitCode != 0) return canWrite = false;
        if (ending.signal != 0) results.write(failureOf(one, run, describe(ending, arguments.timeoutSeconds)));
        ++done;
        const std::optional<Result> result = results.find(one.name);
        progress.step(one.name, result ? summaryOf(*result) : "failed: its result is lost");
        return true;
      });
  if (signal != 0) endBySignal(signal, done, cases.size(), "the same command with --resume does the others");
  if (!canWrite) return kUnusable;
  const std::vector<Result> all = collected(cases, run, results);
  return arguments.share ? statusOf(all) : writeReport(all, arguments, results);
}

int report(const Arguments& arguments) {
  const std::vector<Case> cases = casesOf(arguments);
  const Results results(arguments.out);
  refuseForeignReport(results);
  results.prepare();
  const Run run{References(arguments.references), host::ContextKind::Osmesa, ""};
  return writeReport(collected(cases, run, results), arguments, results);
}

} // namespace regress
