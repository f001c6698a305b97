// glsl/shared.glsl as a shader compiler lays it out and as a C++ compiler does: both from its text.
#include "SharedBlocks.h"
#include "support/Catch.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace tyndall::blocks;

struct Type {
  int words = 0;     ///< floats or ints in C++, one after the other
  int alignment = 0; ///< std140, in words
};

struct Member {
  std::string type, name;
  int count = 0; ///< of an array, else 0
};

struct Struct {
  std::string name;
  std::vector<Member> members;
};

struct Layout {
  std::vector<int> offsets; ///< words
  int size = 0;
};

std::string withoutComments(std::istream& in) {
  std::string text;
  for (std::string line; std::getline(in, line);)
    text += line.substr(0, line.find("//")) + '\n';
  return text;
}

std::vector<std::string> tokensOf(const std::string& text) {
  std::vector<std::string> tokens;
  std::string word;
  for (const char c : text) {
    const bool part = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
    if (!part && !word.empty()) tokens.push_back(std::exchange(word, {}));
    if (part)
      word += c;
    else if (!std::isspace(static_cast<unsigned char>(c)))
      tokens.emplace_back(1, c);
  }
  return tokens;
}

// Structs and blocks in the order of the text; `#define NAME value` gives the sizes of arrays.
std::vector<Struct> parse(std::istream& in) {
  const std::vector<std::string> tokens = tokensOf(withoutComments(in));
  std::map<std::string, int> sizes;
  std::vector<Struct> structs;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i] == "define") sizes[tokens[i + 1]] = static_cast<int>(std::stod(tokens[i + 2]));
    if (tokens[i] != "{") continue;
    const std::string& before = tokens[i - 1];
    Struct found{before == ")" ? tokens[i - 2] : before, {}};
    for (++i; tokens[i] != "}"; ++i) {
      const std::string type = tokens[i++];
      for (;; ++i) {
        Member member{type, tokens[i++], 0};
        if (tokens[i] == "[") {
          const auto named = sizes.find(tokens[i + 1]);
          member.count = named == sizes.end() ? std::stoi(tokens[i + 1]) : named->second;
          i += 3;
        }
        found.members.push_back(member);
        if (tokens[i] == ";") break;
      }
    }
    structs.push_back(found);
  }
  return structs;
}

class Layouts {
public:
  explicit Layouts(const std::vector<Struct>& structs) {
    for (const Struct& s : structs) {
      std140_[s.name] = layoutOf(s, true);
      cpp_[s.name] = layoutOf(s, false);
      types_[s.name] = {cpp_[s.name].size, 4};
    }
  }
  const Layout& std140(const std::string& name) const { return std140_.at(name); }
  const Layout& cpp(const std::string& name) const { return cpp_.at(name); }

private:
  // OpenGL 3.3, 2.11.4 "Standard uniform block layout"; C++: one word after the other.
  Layout layoutOf(const Struct& s, bool std140) const {
    Layout layout;
    for (const Member& member : s.members) {
      const Type& type = types_.at(member.type);
      const auto up = [](int words, int to) { return (words + to - 1) / to * to; };
      const int alignment = !std140 ? 1 : member.count > 0 ? 4 : type.alignment;
      const int stride = std140 && member.count > 0 ? up(type.words, 4) : type.words;
      layout.offsets.push_back(up(layout.size, alignment));
      layout.size = layout.offsets.back() + stride * std::max(member.count, 1);
    }
    return layout;
  }
  std::map<std::string, Type> types_ = {{"float", {1, 1}}, {"int", {1, 1}},  {"vec2", {2, 2}}, {"ivec2", {2, 2}},
                                        {"vec3", {3, 4}},  {"vec4", {4, 4}}, {"mat4", {16, 4}}};
  std::map<std::string, Layout> std140_, cpp_;
};

std::vector<Struct> sharedStructs() {
  std::ifstream in(TYNDALL_SHARED_GLSL);
  REQUIRE(in);
  return parse(in);
}

int offsetOf(const std::vector<Struct>& structs, const Layouts& layouts, const std::string& block,
             const std::string& name) {
  const Struct& found = *std::find_if(structs.begin(), structs.end(), [&](const Struct& s) { return s.name == block; });
  for (std::size_t i = 0; i < found.members.size(); ++i)
    if (found.members[i].name == name) return 4 * layouts.std140(block).offsets[i];
  return -1;
}

} // namespace

TEST_CASE("what of a block C++ writes is where std140 reads it") {
  const std::vector<Struct> structs = sharedStructs();
  const Layouts layouts(structs);
  REQUIRE(structs.size() == 6);
  for (const Struct& s : structs) {
    const Layout &shader = layouts.std140(s.name), &cpp = layouts.cpp(s.name);
    for (std::size_t i = 0; i < s.members.size(); ++i) {
      CAPTURE(s.name, s.members[i].name);
      CHECK(shader.offsets[i] == cpp.offsets[i]);
    }
    CHECK(shader.size == cpp.size);
    CHECK(shader.size % 4 == 0); // whole rows: no padding at the end either
  }
}

TEST_CASE("the layouts from the text are the compiler's") {
  const std::vector<Struct> structs = sharedStructs();
  const Layouts layouts(structs);
  CHECK(4 * layouts.cpp("FrameBlock").size == sizeof(FrameBlock));
  CHECK(4 * layouts.cpp("MapView").size == sizeof(MapView));
  CHECK(4 * layouts.cpp("LightBlock").size == sizeof(LightBlock));
  CHECK(4 * layouts.cpp("CopyBlock").size == sizeof(CopyBlock));
  CHECK(4 * layouts.cpp("AmbientBlock").size == sizeof(AmbientBlock));
  CHECK(offsetOf(structs, layouts, "AmbientBlock", "occlusionSize") == offsetof(AmbientBlock, occlusionSize));
  CHECK(4 * layouts.cpp("EpipolarBlock").size == sizeof(EpipolarBlock));
  CHECK(offsetOf(structs, layouts, "CopyBlock", "copiedLayer") == offsetof(CopyBlock, copiedLayer));
  CHECK(offsetOf(structs, layouts, "FrameBlock", "frameSize") == offsetof(FrameBlock, frameSize));
  CHECK(offsetOf(structs, layouts, "FrameBlock", "visibleEnd") == offsetof(FrameBlock, visibleEnd));
  CHECK(offsetOf(structs, layouts, "MapView", "layer") == offsetof(MapView, layer));
  CHECK(offsetOf(structs, layouts, "LightBlock", "lightRange") == offsetof(LightBlock, lightRange));
  CHECK(offsetOf(structs, layouts, "LightBlock", "texelsPerCurve") == offsetof(LightBlock, texelsPerCurve));
  CHECK(offsetOf(structs, layouts, "LightBlock", "shadowViews") == offsetof(LightBlock, shadowViews));
  CHECK(offsetOf(structs, layouts, "EpipolarBlock", "storedScale") == offsetof(EpipolarBlock, storedScale));
  CHECK(offsetOf(structs, layouts, "EpipolarBlock", "shownSamples") == offsetof(EpipolarBlock, shownSamples));
}

TEST_CASE("a vec3 that no scalar follows, and an array of scalars, are found out") {
  for (const char* text : {"struct Bad { vec3 a; vec3 b; };", "struct Bad { float a[3]; vec4 b; };",
                           "struct Bad { float a; vec2 b; float c; };", "struct Bad { vec3 a; ivec2 b; };"}) {
    std::istringstream in(text);
    const std::vector<Struct> structs = parse(in);
    REQUIRE(structs.size() == 1);
    const Layouts layouts(structs);
    CAPTURE(text);
    CHECK((layouts.std140("Bad").offsets != layouts.cpp("Bad").offsets ||
           layouts.std140("Bad").size != layouts.cpp("Bad").size));
  }
}
