// One sequence: frame by frame through one effect, each picture beside that of an effect that keeps nothing, and each
// redrawn share beside the model's.
#pragma once

#include "Engine.h"
#include "Pictures.h"
#include "gl/effect/FaultyContext.h"

#include <memory>
#include <optional>
#include <string>

namespace stress {

/// What was seen of many sequences.
struct Tally {
  long sequences = 0, frames = 0;
  std::array<long, 3> shares{};           ///< frames that redrew nothing, a part, all
  std::array<long, 3> predicted{};        ///< by Share
  std::array<long, kFailures> failures{}; ///< by Failure, those that came to be
  long last = 0, mixed = 0;               ///< pictures that had to be the last one; that may mix jitters
  double most = 0;                        ///< largest difference of a frame that does not
  double mixedRms = 0; ///< largest root mean square difference of one that does, relative to the mean
  void add(const Tally& other);
};

class Sequence {
public:
  /// The reference draws every frame in full; null: a fresh one each time.
  Sequence(tests::FaultyContext& context, tyndall::Effect* reference, const Recipe& recipe);

  /// What is wrong, with its frame; none if all is right.
  std::optional<std::string> run();

  const Tally& tally() const { return tally_; }

  bool describes = false; ///< prints each frame

private:
  struct LastPicture {
    Contents contents;
    std::array<int, 4> margins;
    std::array<Format, 2> formats;
  };
  void makeEffect();
  std::optional<std::string> step(const ScriptState& state);
  std::optional<std::string> failFirst(const ScriptState& state, const tyndall::Frame& frame, bool& drawn);
  tyndall::Status renderFailing(const ScriptState& state, const tyndall::Frame& frame);
  std::optional<std::string> draw(const ScriptState& state, const tyndall::Frame& frame);
  std::optional<std::string> check(const ScriptState& state, const tyndall::Frame& frame,
                                   const ReuseModel::Prediction& prediction);
  std::optional<std::string> checkShare(Share predicted, double share);
  std::optional<std::string> checkPicture(const ScriptState& state, const Contents& got, const Contents& wanted,
                                          const ReuseModel::Prediction& prediction);
  std::optional<std::string> checkKept(const ScriptState& state, const Contents& got,
                                       const ReuseModel::Prediction& prediction);
  std::optional<std::string> checkFull(const ScriptState& state, const Contents& got, const Contents& wanted,
                                       bool mixesJitters);
  std::optional<Contents> drawReference(const tyndall::Frame& frame, bool rests = false);
  bool mayRest(const ScriptState& state);

  tests::FaultyContext& context_;
  tyndall::Effect* reference_;
  Recipe recipe_;
  Engine engine_;
  ReuseModel model_;
  int drawsLeft_ = -1; ///< until betweenDraws gives up; negative: never
  std::unique_ptr<tyndall::Effect> effect_;
  std::map<int, LastPicture> last_;              ///< by eye
  std::map<int, std::vector<Contents>> jitters_; ///< by eye: the pictures in full since it was drawn so
  std::map<int, std::uint64_t> jittered_;        ///< by eye: the camera whose last frames were jittered
  Tally tally_;
};

} // namespace stress
