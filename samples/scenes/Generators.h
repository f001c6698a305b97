// The sample scenes by name.
#pragma once

#include "Scene.h"

#include <functional>
#include <map>

namespace scenes {

const std::map<std::string, std::function<Scene()>>& generators();

} // namespace scenes
