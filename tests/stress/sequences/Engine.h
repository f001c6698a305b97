// An engine that shows a script: its textures, and frames that tell the effect the truth, as tyndall.h defines it.
#pragma once

#include "ReuseModel.h"
#include "Scenery.h"
#include "Sheet.h"

#include <optional>

namespace stress {

/// Colour, inscatter and transmittance, RGBA, as they are in whole; empty where the frame has none.
using Contents = std::array<std::vector<float>, 3>;

class Engine {
public:
  /// The frame in which the script's state is shown. Textures live as long as the engine, or until the next call.
  const tyndall::Frame& show(const ScriptState& state);

  const FrameFacts& facts() const { return facts_; }
  const Contents& empty() const { return empty_; } ///< what targets hold before the effect draws

  void fillTargets();
  Contents readTargets() const;

  /// The eye has shown the frame, or is taken to have.
  void shown();

private:
  struct LightSheets {
    Sheet depth, glassColour, glassDepth;
  };
  struct MeshBuffer {
    host::GlBuffer buffer;
    double shape = 0;
    std::uint64_t version = 0;
  };
  /// What an eye has shown last.
  struct Shown {
    std::array<MoverState, 3> movers;
    std::map<int, Format> maps; ///< by light
    Format depth = 0;
    std::uint64_t frame = 0;
  };

  void makeTargets();
  void showDepth();
  void showLight(const LightState& light);
  void showGlass(const LightState& light, tyndall::Light& out, LightSheets& sheets);
  void fillMeshes();
  void tellReuse();
  void tellFacts();
  bool isExplainedByObjects(const Shown& last) const;
  void nameObjects(const Shown& last);
  tyndall::MeshVertices meshOf(std::size_t mover) const;
  std::uint64_t versionOf(std::uint64_t holds);

  ScriptState state_;
  tyndall::Frame frame_;
  FrameFacts facts_;
  Sheet depth_, colour_, inscatter_, transmittance_;
  std::map<int, LightSheets> lights_;
  std::array<MeshBuffer, 3> meshes_;
  std::array<std::optional<Shown>, kEyes> shown_;
  std::array<std::uint64_t, kEyes> counters_{};
  Contents empty_;
  std::uint64_t versions_ = 0;
  int renewals_ = 0;
};

} // namespace stress
