#include "Junit.h"

#include "Escape.h"

#include <algorithm>
#include <fmt/format.h>

namespace regress {

namespace {

std::string testcaseOf(const Result& result) {
  const std::string head = fmt::format(R"(    <testcase classname="tyndall.regress" name="{}" time="{:.3f}")",
                                       escaped(result.name), result.seconds);
  if (result.verdict == Verdict::Same) return head + "/>\n";
  const bool isFailed = result.verdict == Verdict::Failed;
  std::string details = summaryOf(result) + "\noptions:";
  for (const std::string& word : result.words)
    details += " " + word;
  for (const std::string& note : result.notes)
    details += "\nnote: " + note;
  return fmt::format("{}>\n      <{} type=\"{}\" message=\"{}\">{}</{}>\n    </testcase>\n", head,
                     isFailed ? "error" : "failure", nameOf(result.verdict), escaped(summaryOf(result)),
                     escaped(details), isFailed ? "error" : "failure");
}

} // namespace

std::string junitXml(const std::vector<Result>& results, const std::string& timestamp) {
  const auto countOf = [&](Verdict verdict) {
    return std::count_if(results.begin(), results.end(), [&](const Result& r) { return r.verdict == verdict; });
  };
  double seconds = 0;
  std::string cases;
  for (const Result& result : results) {
    seconds += result.seconds;
    cases += testcaseOf(result);
  }
  const std::string counts = fmt::format(R"(tests="{}" failures="{}" errors="{}")", results.size(),
                                         countOf(Verdict::Different), countOf(Verdict::Failed));
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"tyndall-regress\" {0} "
                     "time=\"{1:.3f}\">\n  <testsuite name=\"tyndall-regress\" {0} skipped=\"0\" time=\"{1:.3f}\" "
                     "timestamp=\"{2}\">\n{3}  </testsuite>\n</testsuites>\n",
                     counts, seconds, timestamp, cases);
}

} // namespace regress
