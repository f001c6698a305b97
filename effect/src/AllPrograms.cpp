#include "AllPrograms.h"

#include "avsm/Curves.h"
#include "passes/Epipolar.h"
#include "passes/Exact.h"
#include "passes/View.h"

namespace tyndall {

std::vector<gl::Variant> effectPrograms() {
  std::vector<gl::Variant> all;
  for (const passes::exact::Variant& variant : passes::exact::allVariants())
    all.push_back({"passes/exact.frag", passes::exact::definitionsOf(variant)});
  for (const auto& variants : {passes::epipolar::allVariants(), passes::view::allVariants()})
    all.insert(all.end(), variants.begin(), variants.end());
  all.push_back({"passes/composite.frag", {}});
  all.push_back({"passes/copyTexels.frag", {{"CAPPED", 1}}});
  for (const char* fragment : {"passes/copyTexels.frag", "passes/viewFixup.frag"})
    for (const char* vertex : {gl::kFullScreen, "passes/tiles.vert"})
      all.push_back({fragment, {}, vertex});
  return all;
}

std::vector<gl::Variant> avsmPrograms() {
  std::vector<gl::Variant> all;
  for (const int exits : {0, 1})
    all.push_back({"passes/avsmSort.comp", {{"EXITS", exits}}, {}});
  for (const char* pass :
       {"passes/avsmEmpty.comp", "passes/avsmInsert.comp", "passes/avsmParticles.comp", "passes/avsmReduce.comp"})
    for (int nodes = 4; nodes <= avsm::kMaxNodes; nodes += 4)
      for (const bool packed : {false, true})
        all.push_back({pass, avsm::curveDefinitions(nodes, packed), {}});
  return all;
}

} // namespace tyndall
