// What changes a picture without being an error is a note of tyndall-render.
#include "RunTool.h"
#include "support/Catch.h"
#include "unit/scene/GltfFile.h"

#include <algorithm>
#include <scene/ImageFile.h>

namespace {

/// A block on a floor in a haze under a sun; names of meshes are those of their nodes.
class SunnyScene {
public:
  SunnyScene() {
    file_.json["scenes"] = {
        {{"nodes", nlohmann::json::array()},
         {"extras",
          {{"tyndall",
            {{"medium", {{"constituents", {{{"scattering", {0.02, 0.02, 0.02}}}}}}}, {"sky", {0.1, 0.1, 0.1}}}}}}}};
    file_.json["scene"] = 0;
    file_.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"intensity", 3.0}}};
    add({{"rotation", {-0.6, 0.2, 0.1, 0.76811}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file_.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_unlit"};
    file_.json["materials"] = {{{"name", "plain"}},
                               {{"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}}};
    addBox("floor", {-20, -1, -20}, {20, 0, 20}, 0);
    addBox("block", {-1, 0, -1}, {1, 2, 1}, 0);
  }

  void addBox(const std::string& name, const std::array<float, 3>& low, const std::array<float, 3>& high,
              int material) {
    std::vector<float> corners;
    for (int corner = 0; corner < 8; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        corners.push_back(((corner >> axis) & 1) != 0 ? high[axis] : low[axis]);
    const std::vector<std::uint16_t> faces = {0, 3, 1, 0, 2, 3, 4, 7, 6, 4, 5, 7, 0, 5, 4, 0, 1, 5,
                                              2, 7, 3, 2, 6, 7, 0, 6, 2, 0, 4, 6, 1, 7, 5, 1, 3, 7};
    const int positions = file_.floats(corners, "VEC3", 3);
    const int indices = file_.accessor(file_.view(faces), tests::kUnsignedShort, "SCALAR", faces.size());
    file_.json["meshes"].push_back(
        {{"name", name},
         {"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", material}}}}});
    add({{"name", name}, {"mesh", file_.json["meshes"].size() - 1}});
  }

  void addCamera(double nearPlane) {
    file_.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", nearPlane}}}}};
    add({{"camera", 0}, {"translation", {0, 2, 8}}});
  }

  /// Puts all that there is below a node.
  void scaleBy(double scale) {
    nlohmann::json& roots = file_.json["scenes"][0]["nodes"];
    const nlohmann::json children = roots;
    roots = nlohmann::json::array();
    add({{"scale", {scale, scale, scale}}, {"children", children}});
  }

  tests::ToolResult render(const tests::ToolFolder& folder, std::vector<std::string> more) const {
    tests::writeBytes(folder.path("scene.glb"), file_.glb());
    const std::vector<std::string> rest = {"scene.glb",  "--size", "48x27", "--shadow-size", "128",
                                           "--exposure", "0",      "--out", "a.exr"};
    more.insert(more.end(), rest.begin(), rest.end());
    return folder.run(more);
  }

private:
  void add(const nlohmann::json& node) {
    file_.json["nodes"].push_back(node);
    file_.json["scenes"][0]["nodes"].push_back(file_.json["nodes"].size() - 1);
  }

  tests::GltfFile file_;
};

float greatest(const tests::ToolFolder& folder, const std::string& channel) {
  const host::Image image = host::readExr(folder.path("a.exr"));
  return *std::max_element(image.find(channel)->begin(), image.find(channel)->end());
}

} // namespace

TEST_CASE("a dome that keeps the sun out is a note that names it") {
  const tests::ToolFolder folder;
  const std::vector<std::string> view = {"--eye", "0,2,8", "--target", "0,1,0"};
  SunnyScene open, closed, unlit, lampInside;
  CHECK(open.render(folder, view).err.empty());
  const float lit = greatest(folder, "inscatter.G");
  CHECK(lit > 0);

  closed.addBox("sky", {-50, -50, -50}, {50, 50, 50}, 0);
  const tests::ToolResult result = closed.render(folder, view);
  CHECK(result.exitCode == 0);
  CHECK(
      result.err.find("note: mesh \"sky\" of node 3 \"sky\" encloses the camera and all that it sees: light 0 is kept "
                      "out") == 0);
  CHECK(greatest(folder, "inscatter.G") == 0);

  unlit.addBox("sky", {-50, -50, -50}, {50, 50, 50}, 1);
  CHECK(unlit.render(folder, view).err.empty());
  CHECK(greatest(folder, "inscatter.G") > 0.5F * lit);
}

TEST_CASE("what is unlit shows its base colour, whatever the light") {
  const tests::ToolFolder folder;
  SunnyScene scene;
  scene.addBox("sky", {-50, -50, -50}, {50, 50, 50}, 1);
  const std::vector<std::string> up = {"--eye", "0,2,8", "--target", "0,9,8.1", "--medium", "m.json"};
  folder.write("m.json", "{}");
  CHECK(scene.render(folder, up).exitCode == 0);
  CHECK(greatest(folder, "G") == 1);
}

TEST_CASE("a near plane that leaves depth no precision is a note") {
  const tests::ToolFolder folder;
  SunnyScene fine, close;
  fine.addCamera(0.01);
  CHECK(fine.render(folder, {}).err.empty());
  close.addCamera(1e-5);
  CHECK(close.render(folder, {}).err.find("note: camera: with its near plane at 1e-05 the depth buffer holds") == 0);
  CHECK(close.render(folder, {"--reversed-depth"}).err.empty());
}

TEST_CASE("a scene beyond what 32-bit floats hold is refused") {
  const tests::ToolFolder folder;
  SunnyScene scene;
  scene.scaleBy(1e19);
  const tests::ToolResult result = scene.render(folder, {"--eye", "0,2e19,8e19", "--target", "0,0,0"});
  CHECK(result.exitCode == 1);
  CHECK(result.err.find("tyndall-render: scene: reaches") != std::string::npos);
  CHECK(folder.files() == std::vector<std::string>{"scene.glb", "triangle.gltf"});
}

TEST_CASE("radiance of surfaces is what the light makes it, and a cut is a note") {
  const tests::ToolFolder folder;
  const SunnyScene scene;
  const auto render = [&](const std::string& sun) {
    return scene.render(folder, {"--eye", "0,2,8", "--target", "0,1,0", "--sun", "0.3,-1,-0.5," + sun});
  };
  CHECK(render("1e3,1e3,1e3").err.find("radiance") == std::string::npos);
  const float dim = greatest(folder, "G");
  CHECK(render("1e7,1e7,1e7").err.find("radiance") == std::string::npos);
  CHECK(greatest(folder, "G") == Approx(1e4 * dim).epsilon(1e-3)); // but for the sky's light
  CHECK(greatest(folder, "G") > 6e4F);
}
