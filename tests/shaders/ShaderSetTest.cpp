// The set of programs has none twice, and the file names of its shaders tell them apart.
#include "ShaderSet.h"

#include "avsm/Programs.h"
#include "gl/ShaderSources.h"
#include "plan/Passes.h"
#include "support/Catch.h"

#include <regex>
#include <set>

using namespace tyndall;

namespace {

// Programs as the cache tells them apart.
std::set<std::string> distinct(const std::vector<gl::Variant>& variants) {
  std::set<std::string> keys;
  for (const gl::Variant& v : variants)
    keys.insert(v.vertex + " " + tests::nameInWords(v.fragment, gl::mentioned(v)));
  return keys;
}

} // namespace

TEST_CASE("a definition inside a longer word does not make another program") {
  CHECK(gl::mentionedBy("int a[MAX_SHADOW_VIEWS]; SHADOW_VIEWS_2", {{"SHADOW_VIEWS", 1}}).empty());
  CHECK(gl::mentionedBy("#if SHADOW_VIEWS", {{"SHADOW_VIEWS", 1}}).size() == 1);
  CHECK(gl::mentionedBy("MAX_SHADOW_VIEWS < SHADOW_VIEWS+1", {{"SHADOW_VIEWS", 1}}).size() == 1);
  const std::regex words("[A-Za-z_][A-Za-z_0-9]*");
  for (const gl::Variant& variant : allVariants()) {
    const gl::Definitions mentioned = gl::mentioned(variant);
    if (mentioned.empty()) continue;
    const std::string text = shaderSource(variant.fragment) + shaderSource(variant.vertex);
    static std::map<std::string, std::set<std::string>> known;
    std::set<std::string>& found = known[variant.fragment + variant.vertex];
    if (found.empty())
      for (std::sregex_iterator word(text.begin(), text.end(), words), end; word != end; ++word)
        found.insert(word->str());
    for (const auto& [name, value] : mentioned) {
      CAPTURE(variant.fragment, variant.vertex, name);
      if (found.count(name) == 0) FAIL_CHECK("not a word of the shaders");
    }
  }
  CAPTURE(distinct(allVariants()).size());
  CHECK(distinct(allVariants()).size() > 300);
  CHECK(distinct(allVariants()).size() + distinct(avsm::allVariants()).size() <= 1121);
}

TEST_CASE("without dual-source blending no shader declares a second source, and there are no more programs") {
  for (const gl::Variant& variant : allVariants(false)) {
    if (shaderSource(variant.fragment).find("index = 1)") == std::string::npos) continue;
    const gl::Definitions defined = gl::mentioned(variant);
    const bool none = std::any_of(defined.begin(), defined.end(), [](const auto& definition) {
      const auto& [name, value] = definition;
      return name == "ONE_SOURCE" || name == "COPIED" || (name == "COMPOSITE" && value == 0);
    });
    if (!none) FAIL_CHECK(gl::keyOf(variant));
  }
  CHECK(distinct(allVariants(false)).size() > 250);
  CHECK(distinct(allVariants(false)).size() <= distinct(allVariants()).size());
}

TEST_CASE("shaders written as files have names and texts of their own") {
  std::set<std::string> names, texts;
  for (const auto& [name, text] : tests::allShaders()) {
    CAPTURE(name);
    if (!names.insert(name).second) FAIL_CHECK("two of the same name");
    if (!texts.insert(text).second) FAIL_CHECK("two of the same text");
    if (text.rfind("#version ", 0) != 0) FAIL_CHECK("does not begin with #version");
  }
  CHECK(names.count("march-directional-one-view-nearest-grey.frag") == 1);
  CHECK(names.count("fullscreen.vert") == 1);
}

TEST_CASE("without arrays of cube maps no program samples one") {
  const std::vector<gl::Variant> all = allVariants(true, false);
  const auto samples = [](const gl::Variant& variant) {
    const gl::Definitions& d = variant.definitions;
    return std::find(d.begin(), d.end(), std::pair<std::string, int>("SOURCE", 3)) != d.end();
  };
  CHECK(std::none_of(all.begin(), all.end(), samples));
  CHECK(distinct(all).size() + 2 == distinct(allVariants()).size()); // with glass, and without
}
