// tyndall-gpu: what tests/gpu.sh needs beside the other tools.
#include "Cases.h"
#include "Markdown.h"
#include "Programs.h"
#include "Report.h"
#include "Sheet.h"

#include <csignal>
#include <regress/Json.h>
#include <render/OptionRules.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Places.h>
#include <scene/Tool.h>

namespace gpu {

namespace {

namespace fs = std::filesystem;

std::atomic<bool> stopAsked{false};
void askToStop(int /*signal*/) { stopAsked = true; }

constexpr int kEndedEarly = 1;

int runPrograms(const fs::path& out) {
  std::signal(SIGINT, askToStop);
  std::signal(SIGTERM, askToStop);
  host::requireWritable(out);
  std::size_t failed = 0;
  buildPrograms(
      [&](const Json& json) {
        regress::writeJson(out, json);
        failed = static_cast<std::size_t>(std::count_if(json.at("programs").begin(), json.at("programs").end(),
                                                        [](const Json& one) { return one.at("built") == false; }));
      },
      stopAsked);
  if (failed > 0) host::say(std::to_string(failed) + " programs do not build");
  return stopAsked || failed > 0 ? kEndedEarly : 0;
}

int runReport(const fs::path& folder) {
  const Json report = reportOf(folder);
  // Pictures first: the text says whether there are any.
  std::vector<std::string> cases;
  for (const Json& one : report.value("pictures", Json::array()))
    cases.push_back(one.at("case"));
  const bool hasSheet = writeSheet(folder / "pictures.png", folder / "parts" / "c-pictures" / "pictures", cases);
  const fs::path tests = folder / "parts" / "b-tests" / "junit.xml";
  if (fs::exists(tests))
    host::writeAndRename(folder / "junit.xml",
                         [&](const fs::path& to) { fs::copy_file(tests, to, fs::copy_options::overwrite_existing); });
  host::writeText(folder / "report.md", markdownOf(report, hasSheet));
  regress::writeJson(folder / "report.json", report);
  return 0;
}

struct Arguments {
  fs::path out, folder;
  CasesOptions cases;
};

int runCasesCommand(const Arguments& arguments) {
  const int signal = runCases(arguments.cases);
  return signal == 0 ? 0 : kEndedEarly;
}

int run(int argc, const char* const* argv) {
  Arguments arguments;
  CLI::App app("Parts of tests/gpu.sh, which runs them all.", "tyndall-gpu");
  app.require_subcommand(1);
  CLI::App* who = app.add_subcommand("who", "driver, limits, extensions and machine, as JSON");
  CLI::App* commit = app.add_subcommand("commit", "prints what was built");
  CLI::App* programs = app.add_subcommand("programs", "builds every program and times each");
  CLI::App* cases = app.add_subcommand("cases", "runs the cases of a Catch2 executable, each by itself");
  CLI::App* report = app.add_subcommand("report", "writes report.json, report.md, junit.xml and pictures.png");
  for (CLI::App* command : {who, programs})
    command->add_option("--out", arguments.out, "a file")->type_name("JSON")->required();
  cases->add_option("PROGRAM", arguments.cases.program, "built of Catch2's cases")
      ->required()
      ->check(CLI::ExistingFile);
  cases->add_option("--out", arguments.cases.out, "a folder; what it has is not run again")
      ->type_name("DIR")
      ->required();
  cases->add_option("--select", arguments.cases.select, "as Catch2 takes it (default: all, slow ones last)")
      ->type_name("SPEC");
  cases->add_option("--jobs", arguments.cases.jobs, "cases at a time (default 1)")->check(CLI::Range(1, 256));
  cases->add_option("--case-seconds", arguments.cases.secondsOfCase, "after which a case is ended (default 60)")
      ->check(CLI::Range(1, 86400));
  report->add_option("FOLDER", arguments.folder, "of gpu.sh")->required()->check(CLI::ExistingDirectory);
  render::parseArguments(app, argc, argv);
  if (who->parsed()) return regress::writeJson(arguments.out, gpu::who()), 0;
  if (commit->parsed()) return host::print(host::commitOf(TYNDALL_SOURCE_DIR) + "\n"), 0;
  if (programs->parsed()) return runPrograms(arguments.out);
  if (cases->parsed()) return runCasesCommand(arguments);
  return runReport(arguments.folder);
}

} // namespace

} // namespace gpu

int main(int argc, char** argv) {
  return render::runCommand("tyndall-gpu", [&] { return gpu::run(argc, argv); });
}
