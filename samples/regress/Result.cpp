#include "Result.h"

#include "Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <scene/Error.h>
#include <scene/FileIo.h>

namespace regress {

namespace {

constexpr Verdict kVerdicts[] = {Verdict::Same, Verdict::Different, Verdict::Failed};

/// JSON has no infinities.
double numberOf(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

Json jsonOf(const Difference& difference) {
  return {{"rrmse", difference.rRmse}, {"p99", difference.p99},   {"max", difference.max},
          {"over", difference.over},   {"flip", difference.flip}, {"not_finite", difference.notFinite}};
}

Difference differenceOf(const Json& json) {
  return {numberOf(json.at("rrmse")), numberOf(json.at("p99")),  numberOf(json.at("max")),
          numberOf(json.at("over")),  numberOf(json.at("flip")), json.at("not_finite")};
}

Json jsonOf(const Tolerance& tolerance) {
  Json json = {{"rrmse", tolerance.rRmse},
               {"p99", tolerance.p99},
               {"max", tolerance.max},
               {"pixel", tolerance.pixel},
               {"over", tolerance.over}};
  if (tolerance.flip) json["flip"] = *tolerance.flip;
  return json;
}

Tolerance toleranceOf(const Json& json) {
  Tolerance tolerance{json.at("rrmse"), json.at("p99"), json.at("max"), json.at("pixel"), json.at("over"), {}};
  if (json.contains("flip")) tolerance.flip = json.at("flip").get<double>();
  return tolerance;
}

Json jsonOf(const Origin& origin) {
  return {{"driver", origin.driver}, {"context", origin.context}, {"commit", origin.commit}};
}

Origin originOf(const Json& json) { return {json.at("driver"), json.at("context"), json.at("commit")}; }

Result resultOf(const Json& json) {
  Result result;
  result.name = json.at("case");
  const std::string verdict = json.at("verdict");
  for (const Verdict one : kVerdicts)
    if (verdict == nameOf(one)) result.verdict = one;
  result.message = json.at("message");
  result.notes = json.at("notes").get<std::vector<std::string>>();
  if (json.contains("difference")) result.difference = differenceOf(json.at("difference"));
  result.tolerance = toleranceOf(json.at("tolerance"));
  result.words = json.at("options").get<std::vector<std::string>>();
  result.range = json.at("range");
  result.isEqual = json.at("equal");
  result.pictures = json.at("pictures").get<std::vector<std::string>>();
  result.origin = originOf(json.at("origin"));
  result.recorded = originOf(json.at("recorded"));
  result.seconds = json.at("seconds");
  result.inputs = json.at("inputs");
  return result;
}

} // namespace

const char* nameOf(Verdict verdict) {
  return verdict == Verdict::Same ? "same" : verdict == Verdict::Different ? "different" : "failed";
}

double Result::badness() const {
  if (verdict == Verdict::Failed || !difference) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (const Judgement& one : judge(*difference, tolerance))
    worst = std::max(worst, one.limit > 0   ? one.value / one.limit
                            : one.value > 0 ? std::numeric_limits<double>::max()
                                            : 0);
  return worst;
}

std::string summaryOf(const Result& result) {
  if (result.verdict == Verdict::Failed) return "failed: " + result.message;
  if (result.isEqual) return "same, to the last bit";
  std::string text;
  for (const Judgement& one : judge(*result.difference, result.tolerance))
    if (one.isKept() == (result.verdict == Verdict::Same))
      text += fmt::format("{}{} = {} (at most {})", text.empty() ? ": " : ", ", one.name,
                          textOf(one.value, one.isRelative), textOf(one.limit, one.isRelative));
  return nameOf(result.verdict) + text;
}

void Results::prepare() const {
  for (const char* folder : {"results", "pictures"}) {
    std::error_code failure;
    std::filesystem::create_directories(out_ / folder, failure);
    if (failure) throw host::Error((out_ / folder).string() + ": cannot be made: " + failure.message());
    host::requireWritable(out_ / folder / "probe");
  }
  host::requireWritable(reportFile());
  host::requireWritable(junitFile());
}

std::optional<Result> Results::find(const std::string& name) const {
  try {
    const Json json = readJson(file(name));
    requireFormat(json, name);
    Result result = resultOf(json);
    for (const std::string& kind : result.pictures)
      if (!std::filesystem::is_regular_file(pictureFile(name, kind))) return std::nullopt;
    if (result.name == name) return result;
  } catch (const std::exception&) { // none that is whole
  }
  return std::nullopt;
}

bool Results::exists(const std::string& name) const { return std::filesystem::exists(file(name)); }

void Results::write(const Result& result) const {
  Json json = {{"format", kFormat},
               {"case", result.name},
               {"verdict", nameOf(result.verdict)},
               {"message", result.message},
               {"notes", result.notes},
               {"tolerance", jsonOf(result.tolerance)},
               {"options", result.words},
               {"range", result.range},
               {"equal", result.isEqual},
               {"pictures", result.pictures},
               {"origin", jsonOf(result.origin)},
               {"recorded", jsonOf(result.recorded)},
               {"seconds", result.seconds},
               {"inputs", result.inputs}};
  if (result.difference) json["difference"] = jsonOf(*result.difference);
  writeJson(file(result.name), json);
}

void Results::remove(const std::string& name) const {
  std::error_code ignored;
  std::filesystem::remove(file(name), ignored);
  for (const char* kind : {"got", "wanted", "difference"})
    std::filesystem::remove(pictureFile(name, kind), ignored);
}

void Results::removeReport() const {
  std::error_code ignored;
  for (const std::filesystem::path& file : {reportFile(), junitFile()})
    std::filesystem::remove(file, ignored);
}

} // namespace regress
