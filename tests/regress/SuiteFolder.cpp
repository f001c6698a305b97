#include "SuiteFolder.h"

#include <sstream>

namespace tests {

SuiteFolder::SuiteFolder(const nlohmann::json& cases) { writeCases(cases); }

void SuiteFolder::writeCases(const nlohmann::json& cases) const {
  const nlohmann::json list = {
      {"format", 1}, {"defaults", {{"options", {{"size", "96x54"}, {"shadow-size", 256}}}}}, {"cases", cases}};
  folder_.write("cases.json", list.dump(1));
}

ToolResult SuiteFolder::run(const std::string& command, const std::string& arguments, const std::string& before) const {
  return folder_.shell(before + " tyndall-regress " + command +
                       " cases.json --scenes " TYNDALL_SCENES_DIR " --references references --jobs 2 --commit test " +
                       arguments);
}

ToolResult SuiteFolder::record(const std::string& arguments, const std::string& before) const {
  return run("record", arguments, before);
}

ToolResult SuiteFolder::check(const std::string& arguments, const std::string& before) const {
  return run("check", (arguments.find("--out") == std::string::npos ? "--out out " : "") + arguments, before);
}

ToolResult SuiteFolder::report(const std::string& arguments) const {
  return folder_.shell("tyndall-regress report cases.json --scenes " TYNDALL_SCENES_DIR
                       " --references references --out out " +
                       arguments);
}

nlohmann::json SuiteFolder::result(const std::string& name, const std::string& out) const {
  return nlohmann::json::parse(folder_.read(out + "/results/" + name + ".json"));
}

nlohmann::json twoCases() {
  return {{{"name", "cage"}, {"scene", "cage.glb"}},
          {{"name", "projector"}, {"scene", "projector.glb"}, {"options", {"--slices", "128"}}}};
}

bool hasLine(const std::string& text, const std::string& begin, const std::string& mention) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.rfind(begin, 0) == 0 && line.find(mention) != std::string::npos) return true;
  return false;
}

} // namespace tests
