// Programs in an engine's store: found again, never trusted, and nothing that is wrong with it is seen in the picture.
#include "FakeContext.h"
#include "SceneRig.h"
#include "support/Catch.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <stdexcept>

using namespace tyndall;
using tests::address;
using tests::FakeContext;

namespace {

using Bytes = std::vector<std::uint8_t>;
using Kept = std::map<std::string, Bytes>;

// A driver whose binaries are the texts of the program's shaders, which it compiles when it is handed them.
constexpr GLenum kFormat = 0xABCD;
struct Driver {
  int formats = 1;
  bool refuses = false;
  int compiled = 0; // by the effect
  int handed = 0;   // binaries
  std::vector<GLenum> unknownFormats;
  std::map<GLuint, std::string> shaders;
  std::map<GLuint, std::string> programs; // kind and text of each shader
} driver;

void GLAD_API_PTR getInteger(GLenum name, GLint* value) {
  if (name == GL_NUM_PROGRAM_BINARY_FORMATS)
    *value = driver.formats;
  else if (name == GL_PROGRAM_BINARY_FORMATS)
    *value = kFormat;
  else
    host::gl().GetIntegerv(name, value);
}
void GLAD_API_PTR setSource(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
  REQUIRE(count == 1);
  host::gl().ShaderSource(shader, count, texts, lengths);
  driver.shaders[shader] = texts[0];
}
void GLAD_API_PTR countCompile(GLuint shader) {
  ++driver.compiled;
  host::gl().CompileShader(shader);
}
void GLAD_API_PTR attach(GLuint program, GLuint shader) {
  GLint kind = 0;
  host::gl().GetShaderiv(shader, GL_SHADER_TYPE, &kind);
  driver.programs[program] += std::to_string(kind) + "\n" + driver.shaders[shader] + '\0';
  host::gl().AttachShader(program, shader);
}
void GLAD_API_PTR getProgram(GLuint program, GLenum name, GLint* value) {
  host::gl().GetProgramiv(program, name, value);
  if (name == GL_PROGRAM_BINARY_LENGTH) *value = static_cast<GLint>(driver.programs[program].size());
}
void GLAD_API_PTR getBinary(GLuint program, GLsizei size, GLsizei* length, GLenum* format, void* bytes) {
  const std::string& text = driver.programs[program];
  *format = kFormat;
  *length = std::min(size, static_cast<GLsizei>(text.size()));
  std::memcpy(bytes, text.data(), static_cast<std::size_t>(*length));
}
void GLAD_API_PTR setBinary(GLuint program, GLenum format, const void* bytes, GLsizei length) {
  ++driver.handed;
  if (format != kFormat) driver.unknownFormats.push_back(format); // an error of GL's
  if (driver.refuses || format != kFormat) return;
  std::string text(static_cast<const char*>(bytes), static_cast<std::size_t>(length));
  driver.programs[program] = text;
  for (std::size_t end = 0; (end = text.find('\0')) != std::string::npos; text.erase(0, end + 1)) {
    const GLuint shader = host::gl().CreateShader(static_cast<GLenum>(std::stoul(text)));
    const char* source = text.c_str() + text.find('\n') + 1;
    host::gl().ShaderSource(shader, 1, &source, nullptr);
    host::gl().CompileShader(shader);
    host::gl().AttachShader(program, shader);
    host::gl().DeleteShader(shader);
  }
  host::gl().LinkProgram(program);
}
void GLAD_API_PTR hint(GLuint /*program*/, GLenum /*name*/, GLint /*value*/) {}
const GLubyte* GLAD_API_PTR newerDriver(GLenum name) {
  static std::string version;
  const GLubyte* const its = host::gl().GetString(name);
  if (name != GL_VERSION) return its;
  version = std::string(reinterpret_cast<const char*>(its)) + " newer";
  return reinterpret_cast<const GLubyte*>(version.c_str());
}

const std::map<std::string, void*> kDriver = {
    {"glGetIntegerv", address(getInteger)},     {"glShaderSource", address(setSource)},
    {"glCompileShader", address(countCompile)}, {"glAttachShader", address(attach)},
    {"glGetProgramiv", address(getProgram)},    {"glGetProgramBinary", address(getBinary)},
    {"glProgramBinary", address(setBinary)},    {"glProgramParameteri", address(hint)}};

ProgramStore storeIn(Kept& kept) {
  ProgramStore store;
  store.load = [&kept](const std::string& key) {
    const auto found = kept.find(key);
    return found != kept.end() ? found->second : Bytes();
  };
  store.save = [&kept](const std::string& key, const Bytes& bytes) { kept[key] = bytes; };
  return store;
}

// A frame of few programs, with effects of the fake driver.
class StoreRig {
public:
  explicit StoreRig(std::map<std::string, void*> replaced = kDriver) : fake_({}, std::move(replaced)) {
    driver = {};
    scene_.addLight(LightKind::Directional);
    scene_.frame.settings.technique = Technique::Exact;
    colour_ = scene_.makeColour(GL_RGBA16F, std::vector<float>(4 * 24 * 16, 0.5F)); // for a second program
  }

  // What a fresh effect draws.
  std::vector<double> render(const ProgramStore& store) {
    driver.compiled = driver.handed = 0;
    Config config;
    config.loader = fake_.loader();
    config.programs = store;
    const CreateResult created = Effect::create(config);
    REQUIRE(created.effect);
    const reference::ImageAnswer answer = scene_.render(*created.effect);
    programs = created.effect->statistics().compiledPrograms;
    std::vector<double> picture = answer.inscatter.rgb;
    picture.insert(picture.end(), answer.transmittance.rgb.begin(), answer.transmittance.rgb.end());
    return picture;
  }

  int programs = 0; // of the last effect

private:
  FakeContext fake_;
  tests::SceneRig scene_;
  host::GlTexture colour_;
};

} // namespace

TEST_CASE("programs that the store has are not compiled again") {
  StoreRig rig;
  Kept kept;
  const std::vector<double> picture = rig.render(storeIn(kept));
  CHECK(driver.compiled > 0);
  CHECK(driver.handed == 0);
  CHECK(kept.size() == static_cast<std::size_t>(rig.programs));
  for (const auto& [key, bytes] : kept)
    CHECK(key.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-_") ==
          std::string::npos);
  const Kept before = kept;
  CHECK(rig.render(storeIn(kept)) == picture);
  CHECK(driver.compiled == 0);
  CHECK(driver.handed == rig.programs);
  CHECK(kept == before);
}

TEST_CASE("programs that the store has wrong are compiled and kept again") {
  StoreRig rig;
  Kept kept;
  const std::vector<double> picture = rig.render(storeIn(kept));
  const int compiled = driver.compiled;
  const Kept whole = kept;
  REQUIRE(whole.size() > 1);
  std::vector<std::function<void(Bytes&)>> damages = {
      [](Bytes& bytes) { bytes.clear(); },
      [](Bytes& bytes) { bytes.resize(1); },
      [](Bytes& bytes) { bytes.resize(bytes.size() / 2); },
      [](Bytes& bytes) { bytes.pop_back(); },
      [](Bytes& bytes) { bytes.push_back(0); },
      [](Bytes& bytes) { bytes.back() ^= 1; },
      [](Bytes& bytes) { bytes.assign(bytes.size(), 0); },
      [](Bytes& bytes) { bytes[bytes.size() / 2] ^= 128; },
      [&whole](Bytes& bytes) {
        bytes = bytes == whole.begin()->second ? whole.rbegin()->second : whole.begin()->second;
      },
  };
  for (std::size_t byte = 0; byte < 24; ++byte)
    damages.emplace_back([byte](Bytes& bytes) { bytes[byte] ^= 4; });
  for (const auto& damage : damages) {
    const auto number = &damage - damages.data();
    CAPTURE(number);
    kept = whole;
    for (auto& [key, bytes] : kept)
      damage(bytes);
    REQUIRE(kept != whole);
    CHECK(rig.render(storeIn(kept)) == picture);
    CHECK(driver.compiled == compiled);
    CHECK(driver.unknownFormats.empty());
    CHECK(kept == whole);
  }
}

TEST_CASE("programs that the driver refuses are compiled and kept again") {
  StoreRig rig;
  Kept kept;
  const std::vector<double> picture = rig.render(storeIn(kept));
  const int compiled = driver.compiled;
  driver.refuses = true;
  int saved = 0;
  ProgramStore store = storeIn(kept);
  store.save = [&](const std::string&, const Bytes&) { ++saved; };
  CHECK(rig.render(store) == picture);
  CHECK(driver.handed == rig.programs);
  CHECK(driver.compiled == compiled);
  CHECK(saved == rig.programs);
}

TEST_CASE("what a store throws is no matter") {
  StoreRig rig;
  Kept kept;
  const std::vector<double> picture = rig.render(storeIn(kept));
  ProgramStore store;
  store.load = [](const std::string&) -> Bytes { throw std::runtime_error("no disk"); };
  store.save = [](const std::string&, const Bytes&) { throw 7; }; // NOLINT(hicpp-exception-baseclass)
  CHECK(rig.render(store) == picture);
}

TEST_CASE("programs of another driver are not asked for") {
  Kept kept;
  StoreRig(kDriver).render(storeIn(kept));
  const Kept before = kept;
  auto newer = kDriver;
  newer["glGetString"] = address(newerDriver);
  StoreRig rig(newer);
  rig.render(storeIn(kept));
  CHECK(driver.handed == 0);
  CHECK(kept.size() == 2 * before.size());
  for (const auto& [key, bytes] : before)
    CHECK(kept[key] == bytes);
}

TEST_CASE("a store is left alone that lacks a function, or by a driver that writes no binaries") {
  for (const int formats : {0, 1}) {
    StoreRig rig;
    driver.formats = formats;
    int calls = 0;
    ProgramStore store;
    store.load = [&](const std::string&) { return ++calls, Bytes(); };
    if (formats == 0) store.save = [&](const std::string&, const Bytes&) { ++calls; };
    rig.render(store);
    CHECK(calls == 0);
  }
}

TEST_CASE("this context's own driver finds its programs again, if it writes any") {
  StoreRig rig({{"glCompileShader", address(countCompile)}});
  Kept kept;
  const std::vector<double> picture = rig.render(storeIn(kept));
  GLint formats = 0;
  host::gl().GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
  CHECK(kept.size() == static_cast<std::size_t>(formats > 0 ? rig.programs : 0));
  const int compiled = driver.compiled;
  CHECK(rig.render(storeIn(kept)) == picture);
  CHECK(driver.compiled == (formats > 0 ? 0 : compiled));
}
