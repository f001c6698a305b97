// Slow references (map-exact, scene-exact), kept in a folder by a hash of all that they depend on.
#pragma once

#include "render/SceneAnswers.h"

#include <filesystem>
#include <functional>
#include <string>

namespace bench {

class ReferenceCache {
public:
  /// No folder: nothing is kept. `say` gets a line for each file that could not be used.
  ReferenceCache(std::filesystem::path folder, std::function<void(const std::string&)> say);

  reference::Image mapExact(const reference::MapScene& scene) const;
  reference::Image sceneExact(const reference::SceneView& view,
                              const std::vector<reference::Triangle>& triangles) const;

private:
  reference::Image get(const std::string& name, int width, int height,
                       const std::function<reference::Image()>& make) const;

  std::filesystem::path folder_;
  std::function<void(const std::string&)> say_;
};

} // namespace bench
