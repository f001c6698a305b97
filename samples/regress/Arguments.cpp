#include "Arguments.h"

#include <CLI/CLI.hpp>
#include <render/CommandLine.h>

namespace regress {

namespace {

constexpr const char* kFooter = R"(
The list
  {"format": 1,
   "defaults": {"options": {"size": "320x180", "strict": true}, "tolerance": {"rrmse": 0.005}},
   "cases": [{"name": "hall", "scene": "hall.glb", "options": {"slices": 512}, "tolerance": {"max": 0.5}}]}
  Options are tyndall-render's without their --, as an object or as a list of words; true is a switch. Of --frames A-B
  the last one is compared. A tolerance has rrmse, p99, max, pixel (the difference from which a pixel counts), over
  (the share of such pixels) and flip; the differences are relative to the mean of the reference.
Files
  References: NAME.exr, half floats, and NAME.json, which says what drew it. Out: report.html, junit.xml, a result and
  pictures for each case. Each file is written beside its name and renamed, a case's result last.
Exit status
  0: all are the same; 1: some differ, or could not be judged; 2: wrong usage, or something cannot be read or written.)";

struct Typed {
  std::string list, references, out, scenes, only, share, context, commit, jobs = "1", timeout = "600";
};

void addCommon(CLI::App& app, Typed& typed) {
  app.add_option("LIST", typed.list, "the cases, a JSON file")->required();
  app.add_option("--references", typed.references, "the folder of the references")->type_name("DIR")->required();
  app.add_option("--scenes", typed.scenes, "where relative names of scenes start (default: the list's folder)")
      ->type_name("DIR");
  app.add_option("--only", typed.only, "cases of this name, or whose whole name this regular expression matches")
      ->type_name("NAME");
}

void addRendering(CLI::App& app, Typed& typed) {
  app.add_option("--share", typed.share, "every N-th case from the K-th on, for one machine of N")->type_name("K/N");
  app.add_option("--jobs", typed.jobs, "cases at a time (default 1)")->type_name("N");
  app.add_option("--timeout", typed.timeout, "seconds after which a case has failed (default 600)")->type_name("S");
  app.add_option("--context", typed.context, "osmesa, egl or glfw (default: osmesa, or egl where its library is not)")
      ->type_name("NAME");
  app.add_option("--commit", typed.commit, "the name of what is tested (default: git's for the list's folder)")
      ->type_name("TEXT");
}

void addOut(CLI::App& app, Typed& typed) {
  app.add_option("--out", typed.out, "the folder of results, pictures and report")->type_name("DIR")->required();
}

/// An option given as "" must not pass for one left out.
void refuseEmpty(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& value : option->results())
      if (value.empty()) render::failUsage(option->get_name(), "\"\"", "must not be empty");
}

/// Said here: CLI11 would only miss a command.
void requireCommand(int argc, const char* const* argv) {
  const std::string word = argc > 1 ? argv[1] : "-";
  if (word[0] == '-' || word == "record" || word == "check" || word == "report") return;
  render::failUsage("command", word, "must be record, check or report");
}

Arguments fromTyped(const Typed& typed) {
  Arguments arguments;
  arguments.list = typed.list;
  arguments.references = typed.references;
  arguments.out = typed.out;
  arguments.scenes = typed.scenes.empty() ? arguments.list.parent_path() : std::filesystem::path(typed.scenes);
  if (!typed.only.empty()) arguments.only = typed.only;
  if (!typed.share.empty()) arguments.share = parseShare(typed.share);
  if (!typed.context.empty()) arguments.context = render::parseContext("--context", typed.context);
  if (!typed.commit.empty()) arguments.commit = typed.commit;
  arguments.jobs = render::parseInt("--jobs", typed.jobs, 1, 256);
  arguments.timeoutSeconds = static_cast<unsigned>(render::parseInt("--timeout", typed.timeout, 1, 86400));
  return arguments;
}

} // namespace

Arguments parseCommand(int argc, const char* const* argv) {
  Typed typed;
  bool force = false, resume = false;
  CLI::App app("Renders scenes again and compares them with references.", "tyndall-regress");
  app.footer(kFooter);
  app.set_version_flag("--version", "tyndall-regress " TYNDALL_VERSION);
  app.require_subcommand(1);
  CLI::App* record = app.add_subcommand("record", "renders the references that there are not yet");
  CLI::App* check = app.add_subcommand("check", "renders all cases again and compares them with their references");
  CLI::App* report = app.add_subcommand("report", "assembles the report from results of check --share");
  for (CLI::App* command : {record, check, report})
    addCommon(*command, typed);
  for (CLI::App* command : {check, report})
    addOut(*command, typed);
  for (CLI::App* command : {record, check})
    addRendering(*command, typed);
  record->add_flag("--force", force, "replaces the references that there are");
  check->add_flag("--force", force, "replaces the results and the report of an earlier run");
  check->add_flag("--resume", resume, "goes on with an earlier run: what is done and not out of date is kept");
  requireCommand(argc, argv);
  render::parseArguments(app, argc, argv);
  for (const CLI::App* command : app.get_subcommands())
    refuseEmpty(*command);
  Arguments arguments = fromTyped(typed);
  arguments.command = record->parsed() ? Command::Record : check->parsed() ? Command::Check : Command::Report;
  arguments.force = force;
  arguments.resume = resume;
  if (force && resume) throw render::UsageError("--force: cannot go with --resume");
  return arguments;
}

} // namespace regress
