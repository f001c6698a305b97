#include "EmbeddedPrograms.h"

#include "gl/Variant.h"
#include "plan/Passes.h"

#include <set>

using namespace tyndall;

namespace tests {

namespace {

// Shaders, and every two of a variant's definitions.
std::set<std::string> pairsOf(const gl::Variant& variant) {
  const gl::Definitions definitions = gl::mentioned(variant);
  const std::string shaders = variant.vertex + " " + variant.fragment;
  std::set<std::string> pairs = {shaders};
  for (const auto& a : definitions)
    for (const auto& b : definitions)
      if (a <= b)
        pairs.insert(shaders + " " + a.first + " " + std::to_string(a.second) + " " + b.first + " " +
                     std::to_string(b.second));
  return pairs;
}

// Those that have a pair which none before them has.
std::vector<gl::Variant> coverPairs(const std::vector<gl::Variant>& all) {
  std::set<std::string> known;
  std::vector<gl::Variant> taken;
  for (const gl::Variant& variant : all) {
    bool isNew = false;
    for (const std::string& pair : pairsOf(variant))
      isNew = known.insert(pair).second || isNew;
    if (isNew) taken.push_back(variant);
  }
  return taken;
}

} // namespace

std::vector<ProgramText> embeddedPairs() {
  std::vector<gl::Variant> all = allVariants(true);
  const std::vector<gl::Variant> oneSource = allVariants(false);
  all.insert(all.end(), oneSource.begin(), oneSource.end());
  std::vector<ProgramText> texts;
  for (const gl::Variant& variant : coverPairs(all)) {
    const auto text = [&](const std::string& file) {
      return gl::completeSource(file, variant.definitions, gl::Language::Essl);
    };
    texts.push_back({gl::keyOf(variant), text(variant.vertex), text(variant.fragment)});
  }
  return texts;
}

} // namespace tests
