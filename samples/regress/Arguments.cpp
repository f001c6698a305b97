#include "Arguments.h"

#include <render/OptionRules.h>

namespace regress {

namespace {

constexpr int kMaxShares = 1000000;

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

void addCommon(CLI::App& app, Arguments& arguments) {
  app.add_option("LIST", arguments.list, "the cases, a JSON file")->required();
  app.add_option("--references", arguments.references, "the folder of the references")->type_name("DIR")->required();
  app.add_option("--scenes", arguments.scenes, "where relative names of scenes start (default: the list's folder)")
      ->type_name("DIR");
  app.add_option("--only", arguments.only, "cases of this name, in which * stands for any letters and ? for one")
      ->type_name("NAME");
}

void addRendering(CLI::App& app, Arguments& arguments) {
  app.add_option_function<std::string>(
         "--share", [&](const std::string& text) { arguments.share = render::parseShare("--share", text, kMaxShares); },
         "every N-th case from the K-th on, for one machine of N")
      ->type_name("K/N");
  app.add_option("--jobs", arguments.jobs, "cases at a time (default 1)")
      ->check(render::numberThat("must be between 1 and 256", [](double x) { return x >= 1 && x <= 256; }));
  app.add_option("--timeout", arguments.timeoutSeconds, "seconds after which a case has failed (default 600)")
      ->check(render::numberThat("must be between 1 and 86400", [](double x) { return x >= 1 && x <= 86400; }));
  render::chooseFrom(render::kContextNames, app.add_option("--context", arguments.context,
                                                           "GL's (default: osmesa, or egl where its library is not)"));
  app.add_option("--commit", arguments.commit, "the name of what is tested (default: git's for the list's folder)")
      ->type_name("TEXT");
}

void addOut(CLI::App& app, Arguments& arguments) {
  app.add_option("--out", arguments.out, "the folder of results, pictures and report")->type_name("DIR")->required();
}

/// Said here: CLI11 would only miss a command.
void requireCommand(int argc, const char* const* argv) {
  const std::string word = argc > 1 ? argv[1] : "-";
  if (word[0] == '-' || word == "record" || word == "check" || word == "report") return;
  render::failUsage("command", word, "must be record, check or report");
}

} // namespace

Arguments parseCommand(int argc, const char* const* argv) {
  Arguments arguments;
  CLI::App app("Renders scenes again and compares them with references.", "tyndall-regress");
  app.footer(kFooter);
  app.set_version_flag("--version", "tyndall-regress " TYNDALL_VERSION);
  app.require_subcommand(1);
  CLI::App* record = app.add_subcommand("record", "renders the references that there are not yet");
  CLI::App* check = app.add_subcommand("check", "renders all cases again and compares them with their references");
  CLI::App* report = app.add_subcommand("report", "assembles the report from results of check --share");
  for (CLI::App* command : {record, check, report})
    addCommon(*command, arguments);
  for (CLI::App* command : {check, report})
    addOut(*command, arguments);
  for (CLI::App* command : {record, check})
    addRendering(*command, arguments);
  record->add_flag("--force", arguments.force, "replaces the references that there are");
  auto* force = check->add_flag("--force", arguments.force, "replaces the results and the report of an earlier run");
  check->add_flag("--resume", arguments.resume, "goes on with an earlier run: what is done and not out of date is kept")
      ->excludes(force);
  requireCommand(argc, argv);
  render::parseArguments(app, argc, argv);
  arguments.command = record->parsed() ? Command::Record : check->parsed() ? Command::Check : Command::Report;
  if (arguments.scenes.empty()) arguments.scenes = arguments.list.parent_path();
  return arguments;
}

} // namespace regress
