// A scene as the effect renders it, with all that the references need to answer the same question.
#pragma once

#include "reference/MapExact.h"
#include "reference/SceneExact.h"

#include <render/Options.h>

namespace tests {

/// The sample scenes, by name.
const std::vector<std::string>& sampleScenes();

/// Options for a sample scene at the given image and shadow-map size, in the kind of context that TYNDALL_TEST_CONTEXT
/// names.
render::Options sampleOptions(const std::string& scene, int width, int height, int shadowSize);

struct SceneAnswers {
  std::string driver;
  reference::ImageAnswer exact;               ///< what the effect rendered
  reference::MapScene maps;                   ///< the depth and shadow maps that it read
  reference::SceneView view;                  ///< the same camera, lights and medium without maps
  std::vector<reference::Triangle> triangles; ///< of the scene, in world space
};

/// Renders frame 0.
SceneAnswers renderScene(const render::Options& options);

/// Inscatter alone that an effect draws of a frame, in the size of its viewport. Throws host::Error if it refuses.
reference::Image inscatterOf(tyndall::Effect& effect, tyndall::Frame frame);

/// The scenes that a command line names, all if it names none. Throws as render::parseArguments() does.
std::vector<std::string> parseSceneNames(const std::string& description, int argc, const char* const* argv);

} // namespace tests
