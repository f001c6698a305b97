#include "LoopCounter.h"

#include "gl/Gl.h"
#include "gl/ShaderSources.h"
#include "support/TestContext.h"

#include <cctype>
#include <sstream>
#include <stdexcept>
#include <vector>

using host::gl;

namespace stress {

namespace {

constexpr int kSlots = 512;

// A loader is a plain function, and so is what it answers.
tyndall::GlLoader realLoader = nullptr;
std::vector<std::string> slotNames;

int slotNamed(const std::string& name) {
  for (std::size_t i = 0; i < slotNames.size(); ++i)
    if (slotNames[i] == name) return static_cast<int>(i);
  if (slotNames.size() == kSlots) throw std::runtime_error("more loops than counters");
  slotNames.push_back(name);
  return static_cast<int>(slotNames.size()) - 1;
}

bool continuesWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Whether a word begins here.
bool isWord(const std::string& text, std::size_t at, const std::string& word) {
  return text.compare(at, word.size(), word) == 0 && (at == 0 || !continuesWord(text[at - 1])) &&
         !continuesWord(text[at + word.size()]);
}

// The place of the bracket that closes the one at `open`, and of the semicolons between them.
std::size_t closingOf(const std::string& text, std::size_t open, std::vector<std::size_t>& semicolons) {
  int depth = 0;
  for (std::size_t at = open; at < text.size(); ++at) {
    if (text[at] == '(') ++depth;
    if (text[at] == ')' && --depth == 0) return at;
    if (text[at] == ';' && depth == 1) semicolons.push_back(at);
  }
  throw std::runtime_error("a loop's bracket does not close: " + text.substr(open, 60));
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \n"), last = text.find_last_not_of(" \n");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// The pass whose text the source ends with.
std::string passOf(const std::string& source) {
  std::istringstream passes(TYNDALL_PASSES);
  for (std::string pass; std::getline(passes, pass, ',');) {
    const std::string body = tyndall::shaderSource("passes/" + pass);
    if (!body.empty() && body.size() <= source.size() &&
        source.compare(source.size() - body.size(), body.size(), body) == 0)
      return pass;
  }
  throw std::runtime_error("a shader of no pass");
}

// Copies a text, and gives its loops counters.
class Counting {
public:
  Counting(const std::string& text, std::string pass, int (*slotOf)(const std::string&))
      : text_(text), pass_(std::move(pass)), slotOf_(slotOf) {}

  std::string run() {
    while (at_ < text_.size())
      if (text_.compare(at_, 2, "//") == 0 || (text_[at_] == '#' && isLineStart()))
        copyTo(std::min(text_.find('\n', at_), text_.size()));
      else if (isWord(text_, at_, "for") || isWord(text_, at_, "while"))
        count(text_[at_] == 'f');
      else
        step();
    return out_;
  }

private:
  bool isLineStart() const { return at_ == 0 || text_[at_ - 1] == '\n'; }

  void copyTo(std::size_t end) {
    out_ += text_.substr(at_, end - at_);
    at_ = end;
  }

  // What a line begins with in its first column, and goes on to a bracket, names the function that follows.
  void step() {
    if (isLineStart() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size()), bracket = text_.find('(', at_);
      if (bracket < end) {
        std::size_t first = bracket;
        while (first > at_ && continuesWord(text_[first - 1]))
          --first;
        function_ = text_.substr(first, bracket - first);
      }
    }
    copyTo(at_ + 1);
  }

  void count(bool isFor) {
    const std::size_t open = text_.find('(', at_);
    std::vector<std::size_t> semicolons;
    const std::size_t close = closingOf(text_, open, semicolons);
    if (semicolons.size() != (isFor ? 2 : 0)) throw std::runtime_error("an odd loop: " + text_.substr(at_, 60));
    const auto part = [&](std::size_t from, std::size_t to) { return trimmed(text_.substr(from + 1, to - from - 1)); };
    const std::string name = (function_ == "main" ? pass_ : function_) + ": " + text_.substr(at_, close + 1 - at_);
    const std::string turns = "tyndallTurns" + std::to_string(loops_++);
    const std::string turn = "tyndallTurn(" + std::to_string(slotOf_(name)) + ", int(++" + turns + "))";
    const std::string begin = isFor ? part(open, semicolons[0]) : "";
    const std::string next = isFor ? part(semicolons[1], close) : "";
    const bool isUnsigned = begin.compare(0, 5, "uint ") == 0;
    out_ += "for (" + (begin.empty() ? "int " : begin + ", ") + turns + (isUnsigned ? " = 0u; " : " = 0; ") +
            (isFor ? part(semicolons[0], semicolons[1]) : part(open, close)) + "; " + next +
            (next.empty() ? "" : ", ") + turn + ")";
    at_ = close + 1;
  }

  const std::string& text_;
  const std::string pass_;
  int (*slotOf_)(const std::string&);
  std::string out_, function_;
  std::size_t at_ = 0;
  int loops_ = 0;
};

void takeSource(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
  std::string all;
  for (GLsizei i = 0; i < count; ++i)
    all += lengths && lengths[i] >= 0 ? std::string(texts[i], static_cast<std::size_t>(lengths[i])) : texts[i];
  all = countingSource(all, kSlots, slotNamed);
  const char* text = all.c_str();
  gl().ShaderSource(shader, 1, &text, nullptr);
}

void* load(const char* name) {
  return std::string(name) == "glShaderSource" ? reinterpret_cast<void*>(takeSource) : realLoader(name);
}

} // namespace

std::string countingSource(const std::string& source, int slots, int (*slotOf)(const std::string& name)) {
  const std::string version = "#version 330 core\n";
  if (source.compare(0, version.size(), version) != 0) return source;
  const std::string pass = passOf(source);
  const std::string counter = "layout(std430, binding = 7) buffer TyndallTurns { int tyndallMost[" +
                              std::to_string(slots) +
                              "]; };\n"
                              "int tyndallAllTurns = 0;\n"
                              "int tyndallTurn(int slot, int turns) {\n"
                              "  atomicMax(tyndallMost[slot], turns);\n"
                              "  atomicMax(tyndallMost[" +
                              std::to_string(slotOf(pass)) +
                              "], ++tyndallAllTurns);\n"
                              "  return turns;\n"
                              "}\n";
  std::string text = Counting(source, pass, slotOf).run();
  text.replace(0, version.size(), "#version 430 core\n");
  // Declarations may follow the last extension that is asked for, where a context has it.
  std::size_t at = text.rfind("\n#extension ");
  at = text.find('\n', at == std::string::npos ? 0 : text.find("\n#endif", at) + 1);
  return text.insert(at + 1, counter);
}

LoopCounter::LoopCounter() {
  realLoader = tests::testContext().loader();
  const std::vector<GLint> none(kSlots, 0);
  gl().GenBuffers(1, &buffer_);
  gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer_);
  gl().BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(sizeof(GLint) * none.size()), none.data(),
                  GL_DYNAMIC_COPY);
  gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, 0);
  gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, buffer_);
}

LoopCounter::~LoopCounter() { gl().DeleteBuffers(1, &buffer_); }

tyndall::GlLoader LoopCounter::loader() { return load; }

std::map<std::string, std::uint32_t> LoopCounter::take() {
  std::vector<GLuint> turns(kSlots);
  const std::vector<GLuint> none(kSlots, 0);
  const auto bytes = static_cast<GLsizeiptr>(sizeof(GLuint) * turns.size());
  gl().MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer_);
  gl().GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, turns.data());
  gl().BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, none.data());
  gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, 0);
  gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, buffer_);
  std::map<std::string, std::uint32_t> most;
  for (std::size_t i = 0; i < slotNames.size(); ++i)
    if (turns[i] != 0) most[slotNames[i]] = turns[i];
  return most;
}

} // namespace stress
