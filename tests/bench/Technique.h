// What the benchmark compares, by the names that its command line takes.
#pragma once

#include "baselines/Baseline.h"

#include <functional>
#include <optional>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace bench {

/// Who a technique belongs to: the effect under test, what engines ship today, or what papers have.
enum class Group { Exact, Ours, Shipping, Research };

struct Technique {
  std::string name;            ///< as typed, e.g. "fixed:64"
  std::string family;          ///< what lies on one curve, e.g. "fixed"
  std::vector<int> parameters; ///< e.g. {64}
  Group group = Group::Shipping;
};

const char* nameOf(Group group);

/// Throws std::invalid_argument with the rule that the name breaks.
Technique parseTechnique(const std::string& name);

/// The technique names that --techniques explains, one line each.
std::string techniqueHelp();

/// Every technique at every quality that the report shows.
std::vector<std::string> allTechniques();

/// What a frame takes, in numbers that no machine changes.
struct Counts {
  std::uint64_t rays = 0;                        ///< integrated; up to two extra march samples count as one
  std::uint64_t fixupPixels = 0;                 ///< among them
  double packedRays = 0;                         ///< of extra march samples, about: the sides of a break share one
  std::uint64_t slices = 0;                      ///< of all lights
  double errorEstimate = 0, shareOverTarget = 0; ///< with an error target
  std::optional<double> visitsPerRay; ///< nodes and groups of texels that a pixel's ray looks at, of the first light

  /// Visits per ray times rays: march samples see what pixels see only about.
  std::optional<double> visitsEstimate() const;
};

/// Renders frames by one technique.
class Runner {
public:
  virtual ~Runner() = default;
  virtual std::string reasonAgainst(const tyndall::Frame& frame) const = 0;
  /// Throws host::Error.
  virtual void render(const tyndall::Frame& frame) = 0;
  /// Renders with each pass timed. The effect's are medians of runs with something else done between them.
  virtual std::vector<tyndall::PassStatistics> timedPasses(const tyndall::Frame& frame, int runs,
                                                           const std::function<void()>& between) = 0;
  virtual std::uint64_t bytes() = 0;
  /// Renders to count; none where nothing is counted.
  virtual std::optional<Counts> counts(const tyndall::Frame& /*frame*/) { return std::nullopt; }
};

/// The settings of a technique that is the effect's.
tyndall::Settings settingsFor(const Technique& technique);

/// Needs a current context, whose GL functions the loader resolves.
std::unique_ptr<Runner> makeRunner(const Technique& technique, tyndall::GlLoader loader, bool software);

} // namespace bench
