// Runs that are ended midway and gone on with, against a plain run.
#include "SuiteFolder.h"
#include "support/Catch.h"

#include <filesystem>

namespace fs = std::filesystem;

namespace {

using tests::SuiteFolder;
using tests::ToolResult;

nlohmann::json sixCases() {
  nlohmann::json cases;
  for (const int slices : {64, 96, 128, 160, 192, 224})
    cases.push_back(
        {{"name", "c" + std::to_string(slices)}, {"scene", "projector.glb"}, {"options", {{"slices", slices}}}});
  return cases;
}

/// Ends a check by a signal once two results are there; what the shell saw of it.
ToolResult interrupted(const SuiteFolder& suite, const std::string& signal) {
  return suite.folder().shell("tyndall-regress check cases.json --scenes " TYNDALL_SCENES_DIR
                              " --references references --out out --jobs 2 --commit test & tool=$!\n"
                              "until [ \"$(ls out/results 2>/dev/null | grep -c '^c')\" -ge 2 ]; do sleep 0.02; done\n"
                              "kill -" +
                              signal + " $tool; wait $tool");
}

/// Results without the time they took.
nlohmann::json timeless(const SuiteFolder& suite, const std::string& name, const std::string& out) {
  nlohmann::json result = suite.result(name, out);
  result.erase("seconds");
  return result;
}

void checkEndsAsPlain(const std::string& signal) {
  const nlohmann::json cases = sixCases();
  const SuiteFolder suite(cases);
  REQUIRE(suite.record().exitCode == 0);
  REQUIRE(suite.check("--out plain").exitCode == 0);
  const ToolResult cut = interrupted(suite, signal);
  CAPTURE(signal, cut.err);
  CHECK(cut.exitCode > 128);
  CHECK_FALSE(fs::exists(suite.folder().path("out/report.html")));
  if (signal != "KILL") CHECK(cut.err.find("the same command with --resume does the others") != std::string::npos);

  const ToolResult refused = suite.check();
  CHECK(refused.exitCode == 2);
  CHECK(tests::hasLine(refused.err, "tyndall-regress: out: holds a result of case c64; --resume goes on with it", ""));

  const ToolResult resumed = suite.check("--resume");
  CAPTURE(resumed.err);
  CHECK(resumed.exitCode == 0);
  CHECK(resumed.err.find(" of 6 cases are done already") != std::string::npos);
  for (const nlohmann::json& one : cases) {
    const std::string name = one.at("name");
    CHECK(timeless(suite, name, "out") == timeless(suite, name, "plain"));
    for (const char* kind : {".got.png", ".wanted.png"})
      CHECK(suite.folder().read("out/pictures/" + name + kind) == suite.folder().read("plain/pictures/" + name + kind));
  }
  for (const auto& entry : fs::recursive_directory_iterator(suite.folder().path("out")))
    if (signal != "KILL") CHECK(entry.path().extension() != ".part");
}

} // namespace

TEST_CASE("a check that is ended midway and resumed ends as a plain one") { checkEndsAsPlain("TERM"); }

TEST_CASE("a check that is killed midway and resumed ends as a plain one") { checkEndsAsPlain("KILL"); }

TEST_CASE("resumed, a case is done again if its list, reference or result is another") {
  const SuiteFolder suite(tests::twoCases());
  REQUIRE(suite.record().exitCode == 0);
  REQUIRE(suite.check().exitCode == 0);
  const auto done = [&] {
    const ToolResult result = suite.check("--resume");
    CAPTURE(result.err);
    CHECK(result.exitCode == 0);
    return result.err.substr(0, result.err.find('\n'));
  };
  CHECK(done() == "2 of 2 cases are done already");
  suite.folder().write("out/results/cage.json", "{\"format\": 1");
  CHECK(done() == "1 of 2 cases are done already");
  fs::remove(suite.folder().path("out/pictures/cage.got.png"));
  CHECK(done() == "1 of 2 cases are done already");
  REQUIRE(suite.record("--force --only projector --commit other").exitCode == 2); // given twice
  REQUIRE(suite.folder().shell("rm references/projector.*").exitCode == 0);
  REQUIRE(suite.folder()
              .shell("tyndall-regress record cases.json --scenes " TYNDALL_SCENES_DIR
                     " --references references --only projector --commit other")
              .exitCode == 0);
  CHECK(done() == "1 of 2 cases are done already");
  CHECK(done() == "2 of 2 cases are done already");
}
