#include "Programs.h"

#include "avsm/Programs.h"
#include "gl/Variant.h"
#include "plan/Passes.h"

#include <algorithm>
#include <chrono>
#include <gl/Context.h>
#include <gl/Gl.h>
#include <set>

namespace gpu {

namespace {

using tyndall::gl::Variant;

/// The programs as GL tells them apart, those whose time matters most first.
std::vector<Variant> programsInOrder() {
  std::vector<Variant> all = tyndall::allVariants();
  const std::vector<Variant> curves = tyndall::avsm::allVariants();
  all.insert(all.end(), curves.begin(), curves.end());
  std::set<std::string> known;
  std::vector<Variant> programs;
  for (Variant& variant : all) {
    std::string key = variant.vertex + " " + variant.fragment;
    for (const auto& [name, value] : tyndall::gl::mentioned(variant))
      key += " " + name + " " + std::to_string(value);
    if (known.insert(key).second) programs.push_back(std::move(variant));
  }
  const auto marches = [](const Variant& variant) {
    for (const char* name : {"march", "exact", "pixelTree", "fixup"})
      if (variant.fragment.find(name) != std::string::npos) return true;
    return false;
  };
  std::stable_partition(programs.begin(), programs.end(), marches);
  return programs;
}

template <class Get, class GetLog>
std::string logOf(GLuint object, const Get& get, const GetLog& getLog) {
  GLint length = 0;
  get(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  getLog(object, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

/// Of one program. Its objects are deleted, so that the driver finds none of its shaders again.
class Building {
public:
  explicit Building(const Variant& variant) : program_(host::gl().CreateProgram()) {
    if (variant.vertex.empty()) {
      add(GL_COMPUTE_SHADER, variant.fragment, variant);
    } else {
      add(GL_VERTEX_SHADER, variant.vertex, variant);
      add(GL_FRAGMENT_SHADER, variant.fragment, variant);
    }
    host::gl().LinkProgram(program_);
    GLint linked = 0;
    host::gl().GetProgramiv(program_, GL_LINK_STATUS, &linked); // waits
    isBuilt_ = linked != 0;
    if (!isBuilt_) log_ += logOf(program_, host::gl().GetProgramiv, host::gl().GetProgramInfoLog);
  }
  ~Building() { host::gl().DeleteProgram(program_); }
  Building(const Building&) = delete;
  Building& operator=(const Building&) = delete;

  bool isBuilt() const { return isBuilt_; }
  const std::string& log() const { return log_; }

private:
  void add(GLenum kind, const std::string& file, const Variant& variant) {
    const std::string text = tyndall::gl::completeSource(file, variant.definitions);
    const char* pointer = text.c_str();
    const GLuint shader = host::gl().CreateShader(kind);
    host::gl().ShaderSource(shader, 1, &pointer, nullptr);
    host::gl().CompileShader(shader);
    GLint compiled = 0;
    host::gl().GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) log_ += logOf(shader, host::gl().GetShaderiv, host::gl().GetShaderInfoLog);
    host::gl().AttachShader(program_, shader);
    host::gl().DeleteShader(shader);
  }

  GLuint program_;
  bool isBuilt_ = false;
  std::string log_;
};

} // namespace

void buildPrograms(const std::function<void(const Json&)>& keep, const std::atomic<bool>& stop) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds kBetweenKeeping(2);
  const std::unique_ptr<host::Context> context = host::Context::create(host::ContextKind::Egl, {/*debug*/ false});
  const std::vector<Variant> programs = programsInOrder();
  Json json = {{"of", programs.size()}, {"programs", Json::array()}};
  auto kept = Clock::now();
  for (const Variant& variant : programs) {
    if (stop) break;
    const auto start = Clock::now();
    const Building building(variant);
    const std::chrono::duration<double, std::milli> time = Clock::now() - start;
    Json program = {{"name", tyndall::gl::keyOf(variant)}, {"ms", time.count()}, {"built", building.isBuilt()}};
    if (!building.isBuilt()) program["log"] = building.log();
    json["programs"].push_back(program);
    if (Clock::now() - kept < kBetweenKeeping) continue;
    keep(json);
    kept = Clock::now();
  }
  keep(json);
}

} // namespace gpu
