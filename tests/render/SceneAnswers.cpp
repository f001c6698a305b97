#include "render/SceneAnswers.h"

#include <cstdlib>
#include <gl/ReadBack.h>
#include <render/OptionRules.h>
#include <render/RenderFrame.h>
#include <scene/Error.h>
#include <scene/Places.h>

namespace tests {

namespace {

std::vector<float> withoutAlpha(const std::vector<float>& rgba) {
  std::vector<float> rgb;
  rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); ++i)
    if (i % 4 != 3) rgb.push_back(rgba[i]);
  return rgb;
}

void append(std::vector<float>& to, const std::vector<float>& from) { to.insert(to.end(), from.begin(), from.end()); }

reference::ShadowImage readShadow(const tyndall::Light& light, int size) {
  reference::ShadowImage image;
  if (light.shadow.texture == 0) return image;
  image.width = image.height = size;
  image.layers = static_cast<int>(light.shadow.views.size());
  for (int layer = 0; layer < image.layers; ++layer) {
    append(image.depth, host::readDepthArray(light.shadow.texture, size, size, layer));
    if (light.glass.colour == 0) continue;
    append(image.glassColour, host::readColourArray(light.glass.colour, size, size, layer, 3));
    append(image.glassDepth, host::readDepthArray(light.glass.depth, size, size, layer));
  }
  return image;
}

} // namespace

const std::vector<std::string>& sampleScenes() {
  static const std::vector<std::string> names = {"nave", "nave-glass", "forest",  "terrain",
                                                 "cage", "stage",      "concert", "projector"};
  return names;
}

render::Options sampleOptions(const std::string& scene, int width, int height, int shadowSize) {
  render::Options options;
  options.profile = tyndall::Profile::Reference;
  options.settings = tyndall::settingsOf(options.profile);
  options.scene = host::placeOf("scenes", TYNDALL_SCENES_DIR) / (scene + ".glb");
  options.width = width;
  options.height = height;
  options.shadowSize = shadowSize;
  if (const char* context = std::getenv("TYNDALL_TEST_CONTEXT")) options.context = host::parseContextKind(context);
  return options;
}

reference::Image inscatterOf(tyndall::Effect& effect, tyndall::Frame frame) {
  const int width = frame.viewport.width, height = frame.viewport.height;
  const host::GlTexture inscatter = host::makeTexture2D(GL_RGBA32F, width, height);
  frame.colour = 0;
  frame.output = {inscatter.name(), 0};
  if (const tyndall::Status status = effect.render(frame); !status) throw host::Error(status.message);
  return {width, height, host::readColour(inscatter.name(), width, height, 3)};
}

SceneAnswers renderScene(const render::Options& options) {
  render::FrameRenderer renderer(options);
  renderer.render(0);
  const render::Picture picture = renderer.readPicture();
  const tyndall::Frame& frame = renderer.frame();
  SceneAnswers answers;
  answers.driver = renderer.context().driver();
  answers.exact = {reference::Image(options.width, options.height, withoutAlpha(picture.inscatter)),
                   reference::Image(options.width, options.height, withoutAlpha(picture.transmittance))};
  reference::MapScene& maps = answers.maps;
  maps.camera = frame.camera;
  maps.lights = frame.lights;
  for (const tyndall::Light& light : frame.lights)
    maps.shadows.push_back(readShadow(light, options.shadowSize));
  maps.medium = frame.medium;
  maps.ambient = frame.ambient;
  maps.filter = frame.settings.shadowFilter;
  maps.width = options.width;
  maps.height = options.height;
  maps.depth = host::readDepth(frame.depth.texture, options.width, options.height);
  answers.view = {frame.camera, frame.lights, frame.medium, frame.ambient, options.width, options.height};
  answers.triangles = reference::trianglesOf(renderer.scene(), host::poseAt(renderer.scene(), 0));
  return answers;
}

std::vector<std::string> parseSceneNames(const std::string& description, int argc, const char* const* argv) {
  std::vector<std::string> names = sampleScenes();
  CLI::App app(description, std::filesystem::path(argv[0]).filename().string());
  app.add_option("SCENE", names, "a scene of the build folder, by name; all if none is named");
  render::parseArguments(app, argc, argv);
  return names;
}

} // namespace tests
