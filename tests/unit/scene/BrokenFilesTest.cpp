// A good file, broken in thousands of ways, each the same in every run: it either loads to a scene whose parts fit
// together, or is refused with host::Error. Anything else fails here or under the sanitizers.
#include "GltfFile.h"
#include "SceneRules.h"
#include "support/Catch.h"

#include <random>
#include <scene/Error.h>
#include <scene/GltfLoader.h>

namespace tests {

namespace {

void require(bool holds, const char* rule) {
  if (!holds) FAIL(rule);
}

void checkScene(const host::Scene& scene) {
  const std::string broken = brokenRuleOf(scene);
  if (!broken.empty()) FAIL(broken);
}

class Tally {
public:
  /// Loads a file and counts what becomes of it.
  void load(const std::filesystem::path& file) {
    try {
      checkScene(host::loadScene(file));
      ++loaded;
    } catch (const host::Error& error) {
      require(std::string(error.what()).find('\n') == std::string::npos, "a message is one line");
      ++refused;
    }
  }

  int loaded = 0;
  int refused = 0;
};

/// All paths in a document, leaves and containers.
void collect(const nlohmann::json& json, const nlohmann::json::json_pointer& path,
             std::vector<nlohmann::json::json_pointer>& paths) {
  paths.push_back(path);
  if (json.is_object()) {
    for (const auto& member : json.items()) {
      collect(member.value(), path / member.key(), paths);
    }
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      collect(json[i], path / i, paths);
    }
  }
}

} // namespace

TEST_CASE("The good file is good", "[scene][gltf][broken]") {
  const host::Scene scene = everything().load();
  checkScene(scene);
  CHECK(scene.notes.empty());
  CHECK(scene.nodes.size() == 6);
  CHECK(scene.animation.size() == 3);
}

TEST_CASE("A truncated file is refused wherever it ends", "[scene][gltf][broken]") {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> glb = everything().glb();
  for (std::size_t size = 0; size < glb.size(); size += 3) {
    writeBytes(folder / "cut.glb", {glb.begin(), glb.begin() + static_cast<std::ptrdiff_t>(size)});
    INFO(size);
    CHECK_THROWS_AS(host::loadScene(folder / "cut.glb"), host::Error);
  }

  GltfFile file = everything();
  file.json["buffers"][0]["uri"] = "data.bin";
  const std::string text = file.json.dump();
  writeBytes(folder / "data.bin", file.bytes);
  writeBytes(folder / "whole.gltf", {text.begin(), text.end()});
  checkScene(host::loadScene(folder / "whole.gltf"));
  for (std::size_t size = 0; size < text.size(); size += 3) {
    writeBytes(folder / "cut.gltf", {text.begin(), text.begin() + static_cast<std::ptrdiff_t>(size)});
    INFO(size);
    CHECK_THROWS_AS(host::loadScene(folder / "cut.gltf"), host::Error);
  }
  for (std::size_t size = 0; size < file.bytes.size(); size += 3) {
    writeBytes(folder / "data.bin", {file.bytes.begin(), file.bytes.begin() + static_cast<std::ptrdiff_t>(size)});
    CHECK_THROWS_AS(host::loadScene(folder / "whole.gltf"), host::Error);
  }
}

TEST_CASE("Flipped bits are survived", "[scene][gltf][broken]") {
  constexpr int kRuns = 6000;
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> glb = everything().glb();
  std::mt19937 random(20240229);
  Tally tally;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<std::uint8_t> broken = glb;
    const std::uint32_t flips = 1 + random() % 4;
    for (std::uint32_t i = 0; i < flips; ++i) {
      broken[random() % broken.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
    }
    writeBytes(folder / "broken.glb", broken);
    INFO(run);
    tally.load(folder / "broken.glb");
  }
  CHECK(tally.loaded > kRuns / 20);
  CHECK(tally.refused > kRuns / 20);
}

TEST_CASE("Flipped bits in text and embedded data are survived", "[scene][gltf][broken]") {
  constexpr int kRuns = 3000;
  const TemporaryFolder folder;
  GltfFile file = everything();
  file.json["images"][0] = {
      {"uri", "data:image/png;base64,"
              "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="}};
  file.json["buffers"][0]["uri"] = "data.bin";
  writeBytes(folder / "data.bin", file.bytes);
  const std::string text = file.json.dump();
  std::mt19937 random(42);
  Tally tally;
  for (int run = 0; run < kRuns; ++run) {
    std::string broken = text;
    const std::size_t place = random() % broken.size();
    broken[place] = static_cast<char>(broken[place] ^ static_cast<char>(1U << random() % 8));
    writeBytes(folder / "broken.gltf", {broken.begin(), broken.end()});
    INFO(run);
    tally.load(folder / "broken.gltf");
  }
  CHECK(tally.loaded > kRuns / 20);
  CHECK(tally.refused > kRuns / 20);
}

TEST_CASE("Every value of the document may be anything", "[scene][gltf][broken]") {
  const TemporaryFolder folder;
  const GltfFile file = everything();
  std::vector<nlohmann::json::json_pointer> paths;
  collect(file.json, nlohmann::json::json_pointer(), paths);
  const std::vector<nlohmann::json> values = {nullptr,
                                              true,
                                              -1,
                                              0,
                                              1,
                                              3.5,
                                              255,
                                              2147483647,
                                              4294967295U,
                                              std::numeric_limits<std::int64_t>::min(),
                                              std::numeric_limits<std::uint64_t>::max(),
                                              1e300,
                                              "",
                                              "\n\x01",
                                              nlohmann::json::array(),
                                              nlohmann::json::array({0, 0, 0}),
                                              nlohmann::json::object()};
  Tally tally;
  for (const nlohmann::json::json_pointer& path : paths) {
    for (const nlohmann::json& value : values) {
      GltfFile broken = file;
      broken.json[path] = value;
      writeBytes(folder / "broken.glb", broken.glb());
      INFO(path.to_string() << " = " << value.dump());
      tally.load(folder / "broken.glb");
    }
    if (path.empty()) continue;
    GltfFile broken = file;
    nlohmann::json& parent = broken.json[path.parent_pointer()];
    if (parent.is_object()) parent.erase(path.back());
    writeBytes(folder / "broken.glb", broken.glb());
    INFO(path.to_string() << " is missing");
    tally.load(folder / "broken.glb");
  }
  CHECK(tally.loaded > 200);
  CHECK(tally.refused > 1000);
}

TEST_CASE("Deep, long and strange documents are refused", "[scene][gltf][broken]") {
  using Catch::Contains;
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) -> std::string {
    writeBytes(folder / "odd.gltf", {text.begin(), text.end()});
    try {
      host::loadScene(folder / "odd.gltf");
    } catch (const host::Error& error) {
      return error.what();
    }
    FAIL("not refused");
    return {};
  };
  constexpr std::size_t kDepth = 1000000;
  CHECK_THAT(refusal(std::string(kDepth, '[')), Contains("nested deeper"));
  CHECK_THAT(refusal("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(kDepth, '[') +
                     std::string(kDepth, ']') + "}"),
             Contains("nested deeper"));
  std::string many = "{\"extras\":[0";
  for (int i = 0; i < 4000000; ++i) {
    many += ",0";
  }
  CHECK_THAT(refusal(many + "]}"), Contains("values"));
  // Many siblings must not take quadratic time.
  std::string wide = "{\"extras\":[{}";
  for (int i = 0; i < 1000000; ++i) {
    wide += ",{}";
  }
  CHECK_THAT(refusal(wide + "]}"), Contains("asset: is missing"));
  CHECK_THAT(refusal("{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"\\u0000\\nEXT\"]}"),
             Contains("??EXT"));
  CHECK_THAT(refusal("{\"asset\":{\"version\":\"2.0\xff\"}}"), Contains("JSON"));
}

TEST_CASE("What is no file is refused by name", "[scene][gltf][broken]") {
  using Catch::Contains;
  const TemporaryFolder folder;
  const auto refusal = [](const std::filesystem::path& file) -> std::string {
    try {
      host::loadScene(file);
    } catch (const host::Error& error) {
      return error.what();
    }
    FAIL("not refused");
    return {};
  };
  CHECK_THAT(refusal(folder / "none.glb"), Contains("none.glb: cannot be read: no such file"));
  CHECK_THAT(refusal(folder.path()), Contains("not a regular file"));
  CHECK_THAT(refusal("/dev/zero"), Contains("not a regular file"));
  CHECK_THAT(refusal(""), Contains("no such file"));
  writeBytes(folder / "empty.gltf", {});
  CHECK_THAT(refusal(folder / "empty.gltf"), Contains("empty.gltf: the file is empty"));
}

} // namespace tests
