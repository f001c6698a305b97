#include "Report.h"

#include "Sheet.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <regress/Json.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <sstream>

namespace gpu {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> linesOf(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

/// The last lines of what a step's tool said, without those of a progress.
Json endOf(const fs::path& log) {
  constexpr std::size_t kLines = 12;
  std::vector<std::string> lines = linesOf(log);
  if (lines.size() > kLines) lines.erase(lines.begin(), lines.end() - kLines);
  Json json = Json::array();
  for (const std::string& line : lines)
    json.push_back(host::printable(line));
  return json;
}

std::vector<fs::path> foldersIn(const fs::path& folder) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory()) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  return folders;
}

/// Rows of a CSV file as objects; numbers as numbers.
Json readCsv(const std::vector<std::string>& lines) {
  const auto cells = [](const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> all;
    for (std::string cell; std::getline(stream, cell, ',');)
      all.push_back(cell);
    return all;
  };
  Json rows = Json::array();
  if (lines.empty()) return rows;
  const std::vector<std::string> names = cells(lines.front());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> values = cells(lines[i]);
    if (values.size() != names.size()) continue; // the last one, where its writer was killed
    Json row;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const Json value = Json::parse(values[k], nullptr, false);
      row[names[k]] = value.is_number() ? value : Json(values[k]);
    }
    rows.push_back(row);
  }
  return rows;
}

/// tyndall-sequence's output: a line of words, then CSV.
Json sequenceOf(const fs::path& file, const std::string& name) {
  std::vector<std::string> lines = linesOf(file);
  if (lines.size() < 2 || lines[0].rfind("# ", 0) != 0) return nullptr;
  // What is drawn; the driver is who.json's.
  const std::size_t profile = lines[0].find(", profile ");
  const std::size_t end = profile == std::string::npos ? profile : lines[0].find(',', profile + 1);
  const std::string what = lines[0].substr(2, end == std::string::npos ? end : end - 2);
  lines.erase(lines.begin());
  return {{"name", name}, {"what", what}, {"frames", readCsv(lines)}};
}

void append(Json& to, const char* name, const Json& from) {
  if (!from.contains(name)) return;
  for (const Json& one : from.at(name))
    to[name].push_back(one);
}

class Collector {
public:
  explicit Collector(const fs::path& parts) : parts_(parts) {}

  Json collect() {
    Json json = {{"format", regress::kFormat}, {"who", regress::readJson(parts_ / "a-who" / "who.json")}};
    json["parts"] = Json::array();
    for (const fs::path& folder : foldersIn(parts_)) {
      Json row = statusOf(folder);
      try {
        add(folder, json);
      } catch (const std::exception& error) {
        row["damaged"] = host::printable(error.what());
      }
      json["parts"].push_back(row);
    }
    return json;
  }

private:
  static Json statusOf(const fs::path& folder) {
    Json row = {{"name", folder.filename().string()}};
    try {
      row.update(regress::readJson(folder / "status.json"));
    } catch (const std::exception&) {
      row["result"] = "interrupted";
    }
    if (row["result"] != "done") row["log"] = endOf(folder / "log");
    return row;
  }

  static void add(const fs::path& folder, Json& json) {
    const std::string name = folder.filename();
    const auto has = [&](const char* file) { return fs::exists(folder / file); };
    const auto read = [&](const char* file) { return regress::readJson(folder / file); }; // before anything is added
    if (has("cases.json")) {
      const Json cases = read("cases.json");
      json["tests"][name] = cases;
    }
    if (has("programs.json")) {
      const Json programs = read("programs.json");
      json["programs"] = programs;
    }
    if (has("bench.json")) {
      const Json bench = read("bench.json");
      addBench(bench, json["bench"]);
    }
    if (has("results")) {
      const Json pictures = picturesOf(folder);
      json["pictures"] = pictures;
    }
    if (has("sequence.csv"))
      if (const Json sequence = sequenceOf(folder / "sequence.csv", name); !sequence.is_null())
        json["sequences"].push_back(sequence);
    if (has("avsm.csv"))
      for (const Json& row : readCsv(linesOf(folder / "avsm.csv")))
        json["avsm"].push_back(row);
    if (has("nvidia-smi")) json["clocks"] = linesOf(folder / "nvidia-smi");
  }

  static Json picturesOf(const fs::path& folder) {
    Json all = Json::array();
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "results"))
      if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      const Json result = regress::readJson(file);
      Json one;
      for (const char* field :
           {"case", "verdict", "message", "difference", "equal", "tolerance", "recorded", "seconds"})
        if (result.contains(field)) one[field] = result.at(field);
      const SheetPlace place = placeOnSheet(all.size());
      one["on_sheet"] = {{"row", place.row}, {"column", place.column}};
      all.push_back(one);
    }
    return all;
  }

  static void addBench(const Json& from, Json& to) {
    for (const char* field : {"machine", "commit", "date"})
      if (!to.contains(field)) to[field] = from.at(field);
    for (const char* list : {"equal_error", "scaling"})
      append(to, list, from);
    for (const Json& result : from.at("results"))
      if (!isKnown(result, to)) to["results"].push_back(result);
  }

  /// Whether an earlier step timed the same technique on the same setup.
  static bool isKnown(const Json& result, const Json& bench) {
    const Json none = Json::array();
    const Json& all = bench.contains("results") ? bench.at("results") : none;
    return std::any_of(all.begin(), all.end(), [&](const Json& other) {
      for (const char* field : {"series", "x", "scene", "size", "shadow_size", "lights", "density", "technique"})
        if (result.at(field) != other.at(field)) return false;
      return other.contains("ms");
    });
  }

  fs::path parts_;
};

} // namespace

Json reportOf(const fs::path& folder) { return Collector(folder / "parts").collect(); }

} // namespace gpu
