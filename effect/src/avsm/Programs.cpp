#include "avsm/Programs.h"

#include "avsm/Curves.h"

namespace tyndall::avsm {

std::vector<gl::Variant> allVariants() {
  std::vector<gl::Variant> all;
  for (const int exits : {0, 1})
    all.push_back({"passes/avsmSort.comp", {{"EXITS", exits}}, {}});
  all.push_back({"passes/avsmEmpty.comp", {}, {}});
  for (const int finest : {0, 1})
    all.push_back({"passes/avsmRanges.comp", {{"FINEST", finest}}, {}});
  all.push_back({"passes/avsmVolumes.comp", volumeDefinitions(0, false, false), {}});
  for (const char* pass : {"passes/avsmParticles.comp", "passes/avsmReduce.comp"})
    for (int nodes = 4; nodes <= kMaxNodes; nodes += 4)
      for (const bool packed : {false, true})
        all.push_back({pass, curveDefinitions(nodes, packed), {}});
  for (int nodes = 4; nodes <= kMaxNodes; nodes += 4)
    for (const bool packed : {false, true})
      for (const bool spare : {false, true})
        all.push_back({"passes/avsmInsert.comp", insertDefinitions(nodes, packed, spare), {}});
  for (int nodes = 4; nodes <= kMaxNodes; nodes += 4)
    for (const bool packed : {false, true})
      all.push_back({"passes/avsmVolumes.comp", volumeDefinitions(nodes, packed, true), {}});
  return all;
}

} // namespace tyndall::avsm
