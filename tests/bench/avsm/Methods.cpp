#include "Methods.h"

#include <scene/Error.h>

namespace avsmbench {

namespace {

using tyndall::Avsm;
using tyndall::AvsmConfig;
using tyndall::CurveReduction;

std::vector<MethodEntry> makeEntries() {
  std::vector<MethodEntry> all;
  for (const auto& [text, reduction] :
       {std::pair("fitted", CurveReduction::Fitted), std::pair("whole", CurveReduction::WholeCurve),
        std::pair("sorted", CurveReduction::Sorted), std::pair("in order", CurveReduction::InOrder)})
    for (const int nodes : {4, 8, 12, 16})
      for (const bool packed : {false, true})
        all.push_back({std::string("avsm ") + text + " " + std::to_string(nodes) + (packed ? " packed" : ""),
                       [nodes = nodes, packed = packed, how = reduction](Avsm&, const AvsmConfig& config) {
                         AvsmConfig own = config;
                         own.nodes = nodes;
                         own.packed = packed;
                         own.reduction = how;
                         return makeAvsm(own);
                       }});
  all.push_back({"lists", [](Avsm& lists, const AvsmConfig& c) { return makeLists(lists, c.size); }});
  all.push_back({"deep 0.002", [](Avsm& lists, const AvsmConfig& c) { return makeDeep(lists, c.size, 0.002F); }});
  all.push_back({"deep 0.01", [](Avsm& lists, const AvsmConfig& c) { return makeDeep(lists, c.size, 0.01F); }});
  all.push_back({"opacity 32", [](Avsm& lists, const AvsmConfig& c) { return makeOpacity(lists, c.size, 32); }});
  all.push_back({kBaseline, [](Avsm& lists, const AvsmConfig& c) { return makeFourier(lists, c.size, 16); }});
  all.push_back({"moments 4", [](Avsm& lists, const AvsmConfig& c) { return makeMoments(lists, c.size, 4); }});
  all.push_back({"moments 6", [](Avsm& lists, const AvsmConfig& c) { return makeMoments(lists, c.size, 6); }});
  return all;
}

} // namespace

const std::vector<MethodEntry>& allMethods() {
  static const std::vector<MethodEntry> all = makeEntries();
  return all;
}

const MethodEntry& methodNamed(const std::string& name) {
  for (const MethodEntry& entry : allMethods())
    if (entry.name == name) return entry;
  throw host::Error("method " + name + ": unknown");
}

} // namespace avsmbench
