// Times passes and keeps the statistics of a frame.
#pragma once

#include "gl/Objects.h"

#include <array>
#include <chrono>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

/// What the fragments that a pass writes say, to be read in later frames.
enum class Count {
  None,
  Marched,    ///< each marches one ray
  Served,     ///< those of the image that are not among them are marched by themselves
  FixedUp,    ///< each is one of those
  Slices,     ///< each is a slice that was drawn
  Estimate,   ///< as many as stand for the error expected for want of slices (glsl/passes/sliceEstimate.frag)
  OverTarget, ///< likewise for the share of the area that is off by more than the target
  Into,       ///< what its caller makes of them
};

struct Counting {
  Count what = Count::None;
  std::uint64_t pixels = 0;         ///< Served: of the image. Marched: rays of a fragment; 0: one
  const gl::Query* query = nullptr; ///< Into: the caller's
};

/// Nothing in it waits for the GPU but what says so, and it makes GL objects only while frames have more passes than
/// those before.
class PassRecorder {
public:
  PassRecorder(const gl::Functions& gl, PassTiming timing) : gl_(gl), timing_(timing) {}

  void beginFrame();
  void skip(const std::string& pass, const std::string& why);
  void add(std::uint64_t marched, std::uint64_t slices) {
    counts_.marched += marched;
    counts_.slices += slices;
  }

  /// False in a frame during which a query of the engine's own is under way: GL has but one at a time.
  bool canCount() const { return canCount_; }

  /// Runs a pass: times it, counts its fragments if the frame canCount() and, where the context has debug groups, names
  /// it for GL debuggers.
  template <typename Pass>
  bool run(const std::string& name, Pass&& pass, const Counting& counting = {}) {
    begin(name, counting);
    const bool ok = pass();
    end(counting);
    return ok;
  }

  /// Between two bands of the pass that runs, each of which is timed by itself, too.
  void nextBand();
  /// The band after nextBand() begins here, by PassTiming::Finish: what was done between adds nothing to it.
  void resume();

  /// Of the frame; waits for its queries.
  struct Counts {
    std::uint64_t fixupPixels = 0, marched = 0, slices = 0;
    double errorEstimate = 0, shareOverTarget = 0; // the largest of all lights
  };
  const Counts& counts();
  /// Passes of the frame in order; waits for timer queries.
  std::vector<PassStatistics> collect();

private:
  struct Timed {
    PassStatistics statistics;
    std::vector<gl::Uint> stamps{}; // queries, one more than bands
    void add(double band);          // milliseconds
  };
  struct Counted {
    Counting counting;
    gl::Uint query = 0;
  };
  /// Queries of one frame; used again when the GPU is done with them, some frames later.
  struct Pool {
    std::vector<gl::Query> queries;
    std::size_t used = 0;
  };
  struct Pools {
    Pool counts, times; // a query stays of the kind that it was first used as
  };

  void begin(const std::string& name, const Counting& counting);
  void end(const Counting& counting);
  void endBand();
  void stamp();
  gl::Uint nextQuery(Pool& pool);
  Pools& pools() { return pools_[frame_ % pools_.size()]; }
  std::uint64_t resultOf(gl::Uint query) const;
  void add(const Counting& counting, std::uint64_t written);

  const gl::Functions& gl_;
  PassTiming timing_;
  std::chrono::steady_clock::time_point start_;
  std::array<Pools, 3> pools_; // of the last frames: as many as an engine has under way
  std::size_t frame_ = 0;
  bool canCount_ = true;
  std::vector<Timed> passes_;
  std::vector<Counted> counted_; // not read yet
  Counts counts_;
};

} // namespace tyndall
