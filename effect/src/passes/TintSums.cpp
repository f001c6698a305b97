#include "passes/TintSums.h"

#include <array>

namespace tyndall::passes::tint_sums {

namespace {

constexpr int kFewGroups = 16; // that are summed one by one: no level above them

using Level = std::array<gl::Uint, 3>; // a texture a channel
constexpr std::array<Resource, 3> kGroups = {Resource::TintRed, Resource::TintGreen, Resource::TintBlue};

Level levelOn(const Board& board) { return {board[kGroups[0]], board[kGroups[1]], board[kGroups[2]]}; }

} // namespace

// Up: every level the sums of four of the one below; down: the sums up to each group.
void plan(LightPlanner& light) {
  int& level = light.extent.tintLevel;
  std::vector<Level> groups;
  level = 0;
  light.draw(Pass::TintGroups);
  groups.push_back(levelOn(light.board));
  for (level = 1; light.extent.rowTexels >> (2 * level) > kFewGroups; ++level) {
    light.draw(Pass::TintFold);
    groups.push_back(levelOn(light.board));
  }
  const int top = static_cast<int>(groups.size()) - 1;
  for (level = top; level >= 0; --level) {
    for (std::size_t i = 0; i < kGroups.size(); ++i)
      light.board[kGroups[i]] = groups[static_cast<std::size_t>(level)][i];
    light.draw(Pass::TintSums, {level < top ? gl::Definitions{{"COARSER", 1}} : gl::Definitions{}});
  }
  level = 0;
}

} // namespace tyndall::passes::tint_sums
