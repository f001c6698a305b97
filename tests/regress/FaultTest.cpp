// Faults that a regression suite is for: each is found.
#include "SuiteFolder.h"
#include "support/Catch.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;

namespace {

using tests::SuiteFolder;
using tests::ToolResult;

/// The real library; empty where there is none.
std::string osmesaFile() {
  const ToolResult result = tests::ToolFolder().shell(
      "PATH=$PATH:/usr/sbin:/sbin ldconfig -p | awk '$1 == \"libOSMesa.so.8\" { printf \"%s\", $NF; exit }'");
  return result.out;
}

/// Records, then checks with shaders in which `from` is `to`.
void checkShaderFaultIsFound(const nlohmann::json& one, const std::string& from, const std::string& to) {
  const std::string library = osmesaFile();
  if (library.empty()) {
    WARN("skipped: no libOSMesa.so.8");
    return;
  }
  const SuiteFolder suite(nlohmann::json::array({one}));
  REQUIRE(suite.record().exitCode == 0);
  const auto changedTo = [&](const std::string& text) {
    return "LD_LIBRARY_PATH=" TYNDALL_FAULTY_DIR " TYNDALL_TEST_OSMESA=" + library + " TYNDALL_TEST_FROM='" + from +
           "' TYNDALL_TEST_TO='" + text + "'";
  };
  // A change that changes nothing finds nothing: what is found below is the fault.
  const ToolResult harmless = suite.check("--force", changedTo(from));
  CAPTURE(harmless.err);
  CHECK(harmless.err.find("a shader has been changed") != std::string::npos);
  CHECK(harmless.exitCode == 0);
  const ToolResult faulty = suite.check("--force", changedTo(to));
  CAPTURE(faulty.err, faulty.out);
  CHECK(faulty.exitCode == 1);
  CHECK(suite.result(one.at("name")).at("verdict") == "different");
}

/// A .glb: a header, the JSON with its length in front, padded to four bytes, and the rest.
struct Glb {
  nlohmann::json json;
  std::string rest;
};

Glb readGlb(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<std::uint32_t, 5> head{};
  stream.read(reinterpret_cast<char*>(head.data()), sizeof head);
  std::string text(head[3], '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  return {nlohmann::json::parse(text), std::string(std::istreambuf_iterator<char>(stream), {})};
}

void writeGlb(const fs::path& file, const Glb& glb) {
  std::string text = glb.json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto length = static_cast<std::uint32_t>(text.size());
  const std::array<std::uint32_t, 5> head = {0x46546C67, 2, 20 + length + static_cast<std::uint32_t>(glb.rest.size()),
                                             length, 0x4E4F534A};
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(head.data()), sizeof head);
  stream << text << glb.rest;
}

} // namespace

TEST_CASE("a pass shifted by one slice is found") {
  checkShaderFaultIsFound({{"name", "nave"}, {"scene", "nave.glb"}, {"options", {{"no-program-cache", true}}}},
                          "texelFetch(epipolarInscatter, ivec2(slice, low + k), 0)",
                          "texelFetch(epipolarInscatter, ivec2(slice + 1, low + k), 0)");
}

TEST_CASE("a swapped tint is found") {
  checkShaderFaultIsFound({{"name", "glass"}, {"scene", "nave-glass.glb"}, {"options", {{"no-program-cache", true}}}},
                          "vec3 tint = TEXEL(glassColour, texel, view).rgb",
                          "vec3 tint = TEXEL(glassColour, texel, view).bgr");
}

TEST_CASE("a missing light is found") {
  Glb glb = readGlb(TYNDALL_SCENES_DIR "/stage.glb");
  int lights = 0;
  for (nlohmann::json& node : glb.json.at("nodes"))
    if (node.contains("extensions") && node["extensions"].contains("KHR_lights_punctual") && ++lights == 3)
      node["extensions"].erase("KHR_lights_punctual");
  REQUIRE(lights >= 3);
  const SuiteFolder suite(nlohmann::json::array({{{"name", "stage"}, {"scene", "stage.glb"}}}));
  REQUIRE(suite.record().exitCode == 0);
  const fs::path scene = suite.folder().path("dark.glb");
  writeGlb(scene, glb);
  suite.writeCases(nlohmann::json::array({{{"name", "stage"}, {"scene", scene.string()}}}));
  const ToolResult result = suite.check();
  CAPTURE(result.err);
  CHECK(result.exitCode == 1);
  CHECK(suite.result("stage").at("verdict") == "different");
}

TEST_CASE("one slice more or less is found") {
  const auto of = [](int slices) {
    return nlohmann::json::array({{{"name", "nave"}, {"scene", "nave.glb"}, {"options", {{"slices", slices}}}}});
  };
  const SuiteFolder suite(of(128));
  REQUIRE(suite.record().exitCode == 0);
  suite.writeCases(of(129));
  CHECK(suite.check().exitCode == 1);
}
