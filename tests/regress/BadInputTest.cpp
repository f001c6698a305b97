// tyndall-regress as a user meets it: what is right, and a line with the case's name for what is not.
#include "SuiteFolder.h"
#include "support/Catch.h"

#include <filesystem>

namespace fs = std::filesystem;

namespace {

using tests::hasLine;
using tests::SuiteFolder;
using tests::ToolResult;

void checkUsage(const SuiteFolder& suite, const std::string& command, const std::string& mention) {
  const ToolResult result = suite.folder().shell("tyndall-regress " + command);
  CAPTURE(command, result.err);
  CHECK(result.exitCode == 2);
  CHECK(hasLine(result.err, "tyndall-regress: ", mention));
}

} // namespace

TEST_CASE("wrong usage of tyndall-regress is a line that names the option, exit status 2") {
  const SuiteFolder suite(tests::twoCases());
  const std::string check = "check cases.json --references references --out out ";
  checkUsage(suite, "", "subcommand");
  checkUsage(suite, "verify", "command verify: must be record, check or report");
  checkUsage(suite, "record cases.json", "--references");
  checkUsage(suite, "check cases.json --references references", "--out");
  checkUsage(suite, "check nothing.json --references r --out out", "nothing.json: cannot be read: no such file");
  checkUsage(suite, check + "--only candle",
             "--only candle: no case of the list has this name; there are cage, projector");
  checkUsage(suite, check + "--only 'cag'", "--only cag: no case");
  checkUsage(suite, check + "--only ''", "--only");
  checkUsage(suite, check + "--share 3/2", "--share 3/2: must be K/N");
  checkUsage(suite, check + "--jobs 0", "--jobs: 0 must be between 1 and 256");
  checkUsage(suite, check + "--timeout x", "--timeout: x is not a whole number");
  checkUsage(suite, check + "--context vulkan", "--context: vulkan not in");
  checkUsage(suite, check + "--force --resume", "--force excludes --resume");
  CHECK_FALSE(fs::exists(suite.folder().path("out")));
  CHECK(suite.folder().shell("tyndall-regress --help").exitCode == 0);
  CHECK(suite.folder().shell("tyndall-regress check --help").out.find("--resume") != std::string::npos);
}

TEST_CASE("checked where it was recorded a picture is the same to the last bit, and what exists is kept") {
  const SuiteFolder suite(tests::twoCases());
  const ToolResult recorded = suite.record();
  CAPTURE(recorded.err);
  REQUIRE(recorded.exitCode == 0);
  CHECK(hasLine(recorded.err, "[1/2] ", ": recorded; 00:"));
  const auto sidecar = nlohmann::json::parse(suite.folder().read("references/projector.json"));
  CHECK(sidecar.at("commit") == "test");
  CHECK(sidecar.at("size") == nlohmann::json({96, 54}));
  CHECK(sidecar.at("options") == nlohmann::json({"--shadow-size=256", "--size=96x54", "--slices=128"}));
  CHECK_FALSE(sidecar.at("driver").get<std::string>().empty());

  const ToolResult checked = suite.check();
  CAPTURE(checked.err);
  CHECK(checked.exitCode == 0);
  CHECK(checked.out == "2 cases: 2 same, 0 different, 0 failed: out/report.html\n");
  CHECK(suite.result("cage").at("equal") == true);

  const std::string before = suite.folder().read("references/cage.exr");
  const ToolResult again = suite.record();
  CHECK(again.exitCode == 2);
  for (const char* name : {"cage", "projector"})
    CHECK(hasLine(again.err, std::string("tyndall-regress: case ") + name,
                  "exists and is kept; record --force makes it anew"));
  CHECK(suite.folder().read("references/cage.exr") == before);
  CHECK(suite.record("--force --only cage").exitCode == 0);

  const ToolResult over = suite.check();
  CHECK(over.exitCode == 2);
  CHECK(hasLine(over.err, "tyndall-regress: out/report.html: is the report of an earlier run; --resume", ""));
  CHECK(suite.check("--force --only cage").exitCode == 0);
  suite.folder().write("out/report.html", "my own notes");
  for (const char* force : {"--force", "--resume"}) {
    const ToolResult foreign = suite.check(force);
    CHECK(foreign.exitCode == 2);
    CHECK(hasLine(foreign.err, "tyndall-regress: out/report.html: exists and is no report", ""));
  }
  CHECK(suite.folder().read("out/report.html") == "my own notes");
}

TEST_CASE("a reference that is missing, half, damaged, of another size or version fails its case alone, with a line") {
  const SuiteFolder suite(tests::twoCases());
  const auto& folder = suite.folder();
  const auto checkFailed = [&](const std::string& cause) {
    const ToolResult result = suite.check("--force");
    CAPTURE(cause, result.err, result.out);
    CHECK(result.exitCode == 1);
    CHECK(hasLine(result.out, "cage: failed: references/cage.", cause));
    CHECK(hasLine(result.out, "2 cases: 1 same, 0 different, 1 failed", ""));
  };
  REQUIRE(suite.record("--only projector").exitCode == 0);
  checkFailed("there is no reference; record makes it");
  REQUIRE(suite.record("--only cage").exitCode == 0);
  const std::string picture = folder.read("references/cage.exr"), sidecar = folder.read("references/cage.json");

  fs::remove(folder.path("references/cage.json"));
  checkFailed("is half a reference, cage.json is missing; record --force makes it anew");
  const ToolResult kept = suite.record("--only cage"); // half of one is not replaced either
  CHECK(kept.exitCode == 2);
  CHECK(folder.read("references/cage.exr") == picture);

  folder.write("references/cage.json", sidecar);
  folder.write("references/cage.exr", picture.substr(0, picture.size() / 2));
  checkFailed("is damaged or half a reference");
  folder.write("references/cage.exr", picture);
  fs::remove(folder.path("references/cage.exr"));
  checkFailed("is half a reference, cage.exr is missing");
  folder.write("references/cage.exr", picture);

  auto json = nlohmann::json::parse(sidecar);
  json["format"] = 0;
  folder.write("references/cage.json", json.dump());
  checkFailed("is of format 0, this tool reads 1");
  folder.write("references/cage.json", sidecar.substr(0, sidecar.size() / 2));
  checkFailed("is no JSON");
  folder.write("references/cage.json", sidecar);

  auto cases = tests::twoCases();
  cases[0]["options"] = {{"size", "64x64"}};
  suite.writeCases(cases);
  checkFailed("is of 96x54 pixels, the case of 64x64");
  cases[0]["options"] = {{"slices", 300}};
  suite.writeCases(cases);
  suite.check("--force");
  CHECK(suite.result("cage").at("notes").back().get<std::string>().rfind("the reference was recorded with other", 0) ==
        0);
}

TEST_CASE("a folder or disk that takes nothing is a line, exit status 2, and nothing is lost") {
  const SuiteFolder suite(tests::twoCases());
  const ToolResult nowhere = suite.check("--out /proc/tyndall");
  CHECK(nowhere.exitCode == 2);
  CHECK(hasLine(nowhere.err, "tyndall-regress: /proc/tyndall", "cannot be made: "));
  REQUIRE(suite.record().exitCode == 0);
  const std::string before = suite.folder().read("references/cage.exr");

  // No file of more than a kilobyte.
  const ToolResult full = suite.check("", "ulimit -f 2;");
  CAPTURE(full.err);
  CHECK(full.exitCode == 2);
  CHECK(hasLine(full.err, "tyndall-regress: case ", "cannot be written: "));
  const ToolResult fullRecord = suite.record("--force", "ulimit -f 2;");
  CHECK(fullRecord.exitCode == 2);
  CHECK(hasLine(fullRecord.err, "tyndall-regress: case cage: references/cage.exr: cannot be written", ""));
  CHECK(suite.folder().read("references/cage.exr") == before);
  for (const auto& entry : fs::recursive_directory_iterator(suite.folder().path(".")))
    CHECK(entry.path().extension() != ".part");
  CHECK(suite.check("--resume").exitCode == 0);
}

TEST_CASE("a scene that cannot be read fails its case, and shares end in one report") {
  auto cases = tests::twoCases();
  cases.push_back({{"name", "lost"}, {"scene", "nothing.glb"}});
  const SuiteFolder suite(cases);
  CHECK(suite.record().exitCode == 2);
  CHECK(suite.check("--share 1/2").exitCode == 1); // cage and lost
  CHECK_FALSE(fs::exists(suite.folder().path("out/report.html")));
  const ToolResult early = suite.report();
  CHECK(early.exitCode == 1);
  CHECK(hasLine(early.out, "projector: failed: there is no result of it", ""));
  CHECK(suite.check("--share 2/2 --resume").exitCode == 0);
  const ToolResult late = suite.report();
  CHECK(late.exitCode == 1);
  CHECK(hasLine(late.out, "lost: failed: ", "nothing.glb: cannot be read: no such file"));
  CHECK(hasLine(late.out, "3 cases: 2 same, 0 different, 1 failed", ""));
  cases[0]["options"] = {{"slices", 300}};
  suite.writeCases(cases);
  CHECK(hasLine(suite.report().out, "cage: failed: its result is out of date", ""));
}
