#include "Recipe.h"

#include <array>
#include <stdexcept>

namespace stress {

namespace {

constexpr std::array<const char*, static_cast<std::size_t>(Ingredient::Count)> kNames = {
    "sizes",   "viewports",  "cameras",  "jitter",     "eyes",   "lights",   "light-moves", "maps",
    "glass",   "media",      "settings", "techniques", "modes",  "versions", "movers",      "meshes",
    "refresh", "full-share", "views",    "targets",    "depths", "textures", "failures",    "configs"};

} // namespace

const char* nameOf(Ingredient ingredient) { return kNames[static_cast<std::size_t>(ingredient)]; }

Ingredient ingredientNamed(std::string_view name) {
  std::string all;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i]) return static_cast<Ingredient>(i);
    all += (i == 0 ? "" : ", ") + std::string(kNames[i]);
  }
  throw std::invalid_argument("'" + std::string(name) + "' is none of " + all);
}

std::string commandOf(const Recipe& recipe) {
  std::string command =
      "tyndall-stress-sequences --seed " + std::to_string(recipe.seed) + " --frames " + std::to_string(recipe.frames);
  std::string separator = " --skip ";
  for (const int frame : recipe.skipped) {
    command += separator + std::to_string(frame);
    separator = ",";
  }
  separator = " --without ";
  for (const Ingredient ingredient : recipe.without) {
    command += separator + nameOf(ingredient);
    separator = ",";
  }
  return command;
}

} // namespace stress
