#include "Cases.h"

#include "Junit.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <regress/Json.h>
#include <regress/Processes.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <set>
#include <sstream>
#include <unistd.h>

namespace gpu {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kSkipped = 77; // of tests/support/TestContext.cpp

/// How Catch2 lists names alone: version 3 in another way than version 2.
std::vector<std::string> listCases(const fs::path& program, const std::vector<std::string>& select) {
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--list-test-names-only"}, {"--list-tests", "--verbosity", "quiet"}}) {
    // Version 2 ends with the number of cases as its exit status.
    std::vector<std::string> command = {"sh", "-c", "\"$@\" || true", "sh", program.string()};
    command.insert(command.end(), how.begin(), how.end());
    command.insert(command.end(), select.begin(), select.end());
    std::istringstream lines(regress::outputOf(command));
    std::vector<std::string> names;
    for (std::string line; std::getline(lines, line);)
      if (!line.empty()) names.push_back(line);
    if (!names.empty()) return names;
  }
  return {};
}

/// What the names of cases that tell most of a driver hold, the most important first.
int rankOf(const std::string& name) {
  constexpr const char* kWords[] = {"GL state",
                                    "StateMode",
                                    "a state that is left",
                                    "exact equals map-exact",
                                    "comes close to exact",
                                    "reused frames",
                                    "bit for bit",
                                    "curves are the same",
                                    "gives the same picture",
                                    "every format that the header names",
                                    "every shader variant",
                                    "is refused",
                                    "epipolar",
                                    "avsm"};
  const auto found = std::find_if(std::begin(kWords), std::end(kWords),
                                  [&](const char* word) { return name.find(word) != std::string::npos; });
  return static_cast<int>(found - std::begin(kWords));
}

std::vector<std::string> casesInOrder(const CasesOptions& options) {
  std::vector<std::string> quick = options.select, slow;
  if (options.select.empty()) quick = {"~[slow]"}, slow = {"[slow]"};
  std::vector<std::string> names = listCases(options.program, quick);
  std::stable_sort(names.begin(), names.end(), [](const auto& a, const auto& b) { return rankOf(a) < rankOf(b); });
  if (!slow.empty())
    for (std::string& name : listCases(options.program, slow))
      names.push_back(std::move(name));
  if (names.empty()) throw host::Error(options.program.string() + ": lists no cases");
  return names;
}

/// As Catch2 takes it on the command line, where some characters select by more than a name.
std::string argumentOf(const std::string& name) {
  std::string argument = name.rfind('-', 0) == 0 ? "\\" : "";
  for (const char c : name) {
    if (std::string("[],\\").find(c) != std::string::npos) argument += '\\';
    argument += c;
  }
  return argument;
}

std::string textOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string firstLinesOf(const std::string& text) {
  constexpr int kLines = 8;
  std::istringstream lines(text);
  std::string first, line;
  for (int i = 0; i < kLines && std::getline(lines, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) {
      first += host::printable(line) + "\n";
      ++i;
    }
  return first;
}

class CaseRuns {
public:
  explicit CaseRuns(const CasesOptions& options) : options_(options), names_(casesInOrder(options)) {
    fs::create_directories(options.out / "cases");
    readEarlier();
  }

  int run() {
    std::vector<std::function<int()>> tasks;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (results_.count(names_[i]) == 0) {
        numbers.push_back(i);
        tasks.emplace_back([this, i] { return execute(i); });
      }
    const int signal = regress::runAll(tasks, options_.jobs, static_cast<unsigned>(options_.secondsOfCase),
                                       [&](std::size_t task, const regress::Ending& ending) {
                                         finish(numbers[task], ending);
                                         return true;
                                       });
    write();
    writeJunit();
    return signal;
  }

private:
  /// A case has the file of its place in the list.
  fs::path fileOf(std::size_t i, const char* extension) const {
    return options_.out / "cases" / (fmt::format("{:03}", i) + extension);
  }

  void readEarlier() {
    const fs::path file = options_.out / "cases.json";
    if (!fs::exists(file)) return;
    const Json earlier = regress::readJson(file);
    for (const Json& one : earlier.at("cases"))
      if (one.at("result") != "killed") results_[one.at("name")] = one;
  }

  /// In the child: becomes the test.
  int execute(std::size_t i) const {
    const std::string xml = fileOf(i, ".xml").string(), log = fileOf(i, ".log").string();
    const int descriptor = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0 || dup2(descriptor, STDOUT_FILENO) < 0 || dup2(descriptor, STDERR_FILENO) < 0)
      throw host::Error(log + ": cannot be written");
    std::vector<std::string> words = {options_.program.string(), argumentOf(names_[i]), "-r", "junit", "-o", xml};
    std::vector<char*> arguments;
    for (std::string& word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    throw host::Error(options_.program.string() + ": cannot be run");
  }

  void finish(std::size_t i, const regress::Ending& ending) {
    if (ending.signal == SIGTERM || ending.signal == SIGINT || ending.signal == SIGHUP) return; // this run is ended
    const std::string xml = textOf(fileOf(i, ".xml"));
    Json one = {{"name", names_[i]}};
    const std::string log = textOf(fileOf(i, ".log"));
    if (ending.signal != 0) {
      one["result"] = ending.signal == SIGALRM ? "killed" : "crashed";
      one["message"] =
          regress::describe(ending, static_cast<unsigned>(options_.secondsOfCase)) + "\n" + firstLinesOf(log);
    } else if (ending.exitCode == kSkipped || log.rfind("skipped", 0) == 0) {
      one["result"] = "skipped";
      one["message"] = firstLinesOf(log);
    } else if (ending.exitCode == 0) {
      one["result"] = "passed";
    } else {
      one["result"] = "failed";
      const std::string failures = failuresIn(xml);
      one["message"] = firstLinesOf(failures.empty() ? log : failures);
    }
    results_[names_[i]] = one;
    write();
  }

  void write() const {
    Json json = {{"of", names_.size()}, {"cases", Json::array()}};
    for (const std::string& name : names_)
      if (const auto found = results_.find(name); found != results_.end()) json["cases"].push_back(found->second);
    regress::writeJson(options_.out / "cases.json", json);
  }

  void writeJunit() const {
    std::vector<std::string> documents;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto found = results_.find(names_[i]);
      if (found == results_.end()) continue;
      const std::string result = found->second.at("result");
      const bool left = result == "passed" || result == "failed";
      documents.push_back(left ? textOf(fileOf(i, ".xml"))
                               : suiteOf(names_[i], result, found->second.value("message", "")));
    }
    host::writeText(options_.out / "junit.xml", joinedJunit(documents));
  }

  const CasesOptions& options_;
  std::vector<std::string> names_;
  std::map<std::string, Json> results_;
};

} // namespace

int runCases(const CasesOptions& options) { return CaseRuns(options).run(); }

} // namespace gpu
