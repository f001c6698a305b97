#include "ViewerRig.h"

#include <fstream>

namespace {

viewer::SceneLoader::Result wait(viewer::SceneLoader& loader) {
  for (int i = 0; i < 60000; ++i) {
    if (auto result = loader.take()) return std::move(*result);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  FAIL("it is never loaded");
  return {};
}

} // namespace

TEST_CASE("a scene is loaded by a thread of its own, which says how far it is") {
  viewer::SceneLoader loader;
  CHECK_FALSE(loader.isLoading());
  CHECK_FALSE(loader.take());
  loader.start(tests::sceneFile("projector"));
  CHECK(loader.isLoading());
  CHECK_FALSE(loader.stage().empty());
  const viewer::SceneLoader::Result result = wait(loader);
  CHECK(result.error.empty());
  REQUIRE(result.scene);
  CHECK_FALSE(result.scene->meshes.empty());
  CHECK_FALSE(loader.isLoading());
  CHECK(loader.share() > 0.5);
}

TEST_CASE("what is no scene is one line") {
  const tests::TemporaryFolder folder;
  const std::filesystem::path broken = folder / "broken.glb";
  std::ofstream(broken) << "glTF, but no more";
  viewer::SceneLoader loader;
  for (const std::filesystem::path& file :
       {broken, std::filesystem::path("/nowhere/a.glb"), std::filesystem::path("/")}) {
    loader.start(file);
    const viewer::SceneLoader::Result result = wait(loader);
    CAPTURE(file.string(), result.error);
    CHECK_FALSE(result.scene);
    CHECK_FALSE(result.error.empty());
    CHECK(result.error.find('\n') == std::string::npos);
  }
}

TEST_CASE("loading is ended by another scene, and with the loader") {
  const auto start = std::chrono::steady_clock::now();
  {
    viewer::SceneLoader loader;
    for (int i = 0; i < 5; ++i)
      loader.start(tests::sceneFile("forest"));
    loader.start(tests::sceneFile("projector"));
    CHECK(wait(loader).file == tests::sceneFile("projector"));
    loader.start(tests::sceneFile("forest"));
  }
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));
}
