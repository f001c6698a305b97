#include "Generators.h"

namespace scenes {

const std::map<std::string, std::function<Scene()>>& generators() {
  static const std::map<std::string, std::function<Scene()>> kGenerators = {
      {"nave", [] { return makeNave(false); }},
      {"nave-glass", [] { return makeNave(true); }},
      {"forest", makeForest},
      {"terrain", makeTerrain},
      {"cage", makeCage},
      {"stage", [] { return makeStage(false); }},
      {"concert", [] { return makeStage(true); }},
      {"sweep", makeSweep},
      {"projector", makeProjector},
      {"orrery", makeOrrery},
      {"pendulum", makePendulum},
      {"smoke", makeSmoke},
      {"hair", makeHair},
      {"censer", makeCenser},
      {"valley", makeValley},
      {"harbour", makeHarbour},
  };
  return kGenerators;
}

} // namespace scenes
