// What a list of cases may hold, and the line that each mistake gets.
#include "support/Catch.h"
#include "unit/cli/RunTool.h"

#include <regress/CaseList.h>
#include <render/CommandLine.h>
#include <scene/Error.h>

namespace {

std::vector<regress::Case> read(const std::string& text) {
  const tests::ToolFolder folder;
  folder.write("l.json", text);
  return regress::readCases(folder.path("l.json"), "scenes");
}

std::string listOf(const std::string& cases) { return R"({"format": 1, "cases": [)" + cases + "]}"; }

void checkRefused(const std::string& text, const std::string& mention) {
  CAPTURE(text, mention);
  try {
    read(text);
    FAIL("is taken");
  } catch (const host::Error& error) {
    const std::string message = error.what();
    CAPTURE(message);
    CHECK(message.find("l.json: ") != std::string::npos);
    CHECK(message.find(mention) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
}

} // namespace

TEST_CASE("a case's options are an object or words, and those of the defaults that it does not name") {
  const auto cases =
      read(R"({"format": 1, "defaults": {"options": {"size": "64x32", "strict": true}, "tolerance": {"rrmse": 0.25}},
    "cases": [{"name": "a", "scene": "a.glb"},
              {"name": "b", "scene": "/b.glb", "options": {"size": "8x4", "strict": false, "slices": 96, "sun": "-1,-1,0"}},
              {"name": "c", "scene": "c.glb", "options": ["--slices", "96", "--reversed-depth", "--sun=-1,-1,0"],
               "tolerance": {"flip": 0.5}, "options": ["--slices", "96", "--reversed-depth", "--sun", "-1,-1,0"]}]})");
  REQUIRE(cases.size() == 3);
  CHECK(cases[0].options.scene == "scenes/a.glb");
  CHECK((cases[0].options.width == 64 && cases[0].options.strict));
  CHECK(cases[0].tolerance.rRmse == 0.25);
  CHECK(cases[1].options.scene == "/b.glb");
  CHECK((cases[1].options.height == 4 && !cases[1].options.strict && cases[1].options.settings.slices == 96));
  CHECK(cases[1].options.sun->direction.x == -1);
  CHECK((cases[2].options.width == 64 && cases[2].options.strict && cases[2].options.reversedDepth));
  CHECK((cases[2].options.settings.slices == 96 && cases[2].options.sun->direction.y == -1));
  CHECK((*cases[2].tolerance.flip == 0.5 && cases[2].tolerance.rRmse == 0.25));
}

TEST_CASE("a mistake in the list is a line with file, case, field and rule") {
  checkRefused("", "is no JSON");
  checkRefused("[]", "must be an object");
  checkRefused(R"({"cases": []})", "is of format none, this tool reads 1");
  checkRefused(R"({"format": 2, "cases": []})", "is of format 2, this tool reads 1");
  checkRefused(R"({"format": 1, "cases": []})", "cases: must be a list that is not empty");
  checkRefused(R"({"format": 1, "case": []})", "\"case\" is unknown; known are format, defaults, cases");
  checkRefused(listOf(R"({"scene": "a.glb"})"), "cases[0]: lacks a name");
  checkRefused(listOf(R"({"name": "a"})"), "case a: lacks a scene");
  checkRefused(listOf(R"({"name": "../a", "scene": "a.glb"})"), "cases[0].name \"../a\": must be 1 to 100 letters");
  checkRefused(listOf(R"({"name": 7, "scene": "a.glb"})"), "cases[0].name: must be a text");
  checkRefused(listOf(R"({"name": "a", "scene": "a.glb"}, {"name": "a", "scene": "b.glb"})"),
               "case a: its name is taken by one before it");
  const auto one = [](const std::string& more) { return listOf(R"({"name": "a", "scene": "a.glb", )" + more + "}"); };
  checkRefused(one(R"("size": 1)"), "cases[0]: \"size\" is unknown; known are name, scene, options, tolerance");
  checkRefused(one(R"("options": 1)"), "case a: options: must be an object, or a list of words");
  checkRefused(one(R"("options": {"slices": 0})"), "case a: --slices: Value 0 not in range");
  checkRefused(one(R"("options": {"slice": 1})"), "case a: ");
  checkRefused(one(R"("options": {"slices": [1]})"), "case a: options.slices: must be a text, a number, true or false");
  checkRefused(one(R"("options": {"out": "x.png"})"), "case a: options: --out is not an option of a case");
  checkRefused(one(R"("options": {"context": "egl"})"), "case a: options: --context is not an option of a case");
  checkRefused(one(R"("options": ["slices"])"), "case a: options: \"slices\": must be an option, --name");
  checkRefused(one(R"("options": ["--slices", "9", "--slices=8"])"), "case a: options: --slices is given twice");
  checkRefused(one(R"("tolerance": {"rmse": 1})"), "case a: tolerance: \"rmse\" is unknown; known are rrmse, p99");
  checkRefused(one(R"("tolerance": {"p99": -1})"), "case a: tolerance.p99: must be a number of at least 0");
  checkRefused(one(R"("tolerance": {"max": "1"})"), "case a: tolerance.max: must be a number of at least 0");
}

TEST_CASE("shares hold each case once") {
  const auto cases =
      read(listOf(R"({"name": "a", "scene": "s"}, {"name": "b", "scene": "s"}, {"name": "c", "scene": "s"})"));
  const auto names = [&](const char* share) {
    std::string all;
    for (const regress::Case& one : regress::shareOf(cases, render::parseShare("--share", share, 1000)))
      all += one.name;
    return all;
  };
  CHECK(names("1/1") == "abc");
  CHECK(names("1/2") == "ac");
  CHECK(names("2/2") == "b");
  CHECK(names("4/4").empty());
  for (const char* share : {"0/2", "3/2", "1", "1/2/3", "a/b", "1/0", "-1/2", "/"})
    CHECK_THROWS_AS(render::parseShare("--share", share, 1000), render::UsageError);
}

TEST_CASE("patterns choose cases by their names") {
  const auto cases = read(listOf(R"({"name": "nave", "scene": "s"}, {"name": "nave-glass", "scene": "s"},
                                    {"name": "a.b", "scene": "s"}, {"name": "acb", "scene": "s"})"));
  const auto chosen = [&](const char* pattern) {
    std::string names;
    for (const regress::Case& one : regress::only(cases, pattern))
      names += one.name + " ";
    return names;
  };
  CHECK(chosen("nave") == "nave ");
  CHECK(chosen("nave*") == "nave nave-glass ");
  CHECK(chosen("*a?e*s") == "nave-glass ");
  CHECK(chosen("a.b") == "a.b ");
  CHECK(chosen("a?b") == "a.b acb ");
  CHECK(chosen("**") == "nave nave-glass a.b acb ");
  for (const char* none : {"", "av", "nave?", "?", "*x*", "nave-glas", "NAVE"})
    CHECK_THROWS_AS(regress::only(cases, none), render::UsageError);
}

TEST_CASE("a value with line breaks is refused in one line") {
  const auto cases = read(listOf(R"({"name": "a", "scene": "s"})"));
  try {
    regress::only(cases, "b\nc");
    FAIL("is taken");
  } catch (const render::UsageError& error) {
    CHECK(std::string(error.what()) == "--only b?c: no case of the list has this name; there are a");
  }
  const char* const words[] = {"tyndall-render", "a.glb", "--size", "1\nx2"};
  try {
    render::parseOptions(4, words);
    FAIL("is taken");
  } catch (const render::UsageError& error) {
    CHECK_THAT(error.what(), Catch::Contains("--size 1?x2: must be WIDTHxHEIGHT"));
  }
}

TEST_CASE("no pattern takes longer than its length times the name's") {
  const auto cases = read(listOf(R"({"name": ")" + std::string(100, 'a') + R"(", "scene": "s"})"));
  std::string pattern;
  for (int i = 0; i < 10000; ++i)
    pattern += "*a";
  CHECK_THROWS_AS(regress::only(cases, pattern + "b"), render::UsageError);
}

TEST_CASE("a list of endless brackets is refused, without a message that takes the stack") {
  const std::string brackets = std::string(400000, '[') + std::string(400000, ']');
  checkRefused(R"({"format": )" + brackets + "}", "nested deeper than 64 levels");
}
