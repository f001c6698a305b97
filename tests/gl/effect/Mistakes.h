// Mistakes that integrators make, and what is to name each of them.
#pragma once

#include "ShaftRig.h"

#include <functional>
#include <string>
#include <vector>

namespace tests {

/// How a mistake is answered: at once, by an error or a warning, or by a warning once pixels have been looked at.
enum class Answer { Error, Warning, Pixels };

struct Mistake {
  std::string name;
  tyndall::LightKind kind;
  std::function<void(ShaftRig&)> make;
  Answer answer;
  std::vector<std::string> words; ///< of the line
};

const std::vector<Mistake>& mistakes();

/// A rig whose depth and maps show one scene.
ShaftRig rightRig(tyndall::LightKind kind);

} // namespace tests
