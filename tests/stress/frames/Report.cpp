#include "Report.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace stress {

void Report::add(std::uint64_t seed, const Outcome& outcome, double seconds) {
  ++frames_;
  pictures_ += static_cast<std::uint64_t>(outcome.pictures);
  if (seconds > longest_) longest_ = seconds, longestSeed_ = seed;
  for (const auto& [run, error] : outcome.errors) {
    std::size_t i = 0;
    while (i < kErrorClasses.size() && !(error <= kErrorClasses[i]))
      ++i;
    ++errors_[run][i];
    addWorst(run, std::isfinite(error) ? error : std::numeric_limits<double>::max(), seed);
  }
  for (const std::string& run : outcome.illConditioned)
    ++illConditioned_[run];
}

void Report::addWorst(const std::string& run, double error, std::uint64_t seed) {
  auto& worst = worst_[run];
  if (error > worst.first) worst = {error, seed};
}

void Report::addFinding(std::uint64_t seed, const Finding& finding, const std::string& simple) {
  findings_.push_back({{"seed", seed},
                       {"check", finding.check},
                       {"value", finding.value},
                       {"limit", finding.limit},
                       {"detail", finding.detail},
                       {"simple", simple}});
}

void Report::addLoops(std::uint64_t seed, const std::map<std::string, std::uint32_t>& turns) {
  for (const auto& [name, most] : turns)
    if (auto& known = loops_[name]; most > known.first) known = {most, seed};
}

void Report::merge(const nlohmann::json& other) {
  frames_ += other.at("frames").get<std::uint64_t>();
  pictures_ += other.at("pictures").get<std::uint64_t>();
  if (const double seconds = other.at("longest_seconds"); seconds > longest_)
    longest_ = seconds, longestSeed_ = other.at("longest_seed");
  for (const auto& [run, counts] : other.at("errors").items())
    for (std::size_t i = 0; i < counts.size(); ++i)
      errors_[run][i] += counts[i].get<std::uint64_t>();
  for (const auto& [run, worst] : other.at("worst").items())
    addWorst(run, worst.at(0), worst.at(1));
  for (const auto& [run, count] : other.at("ill_conditioned").items())
    illConditioned_[run] += count.get<std::uint64_t>();
  for (const auto& [name, most] : other.at("loops").items())
    addLoops(most.at(1), {{name, most.at(0)}});
  for (const nlohmann::json& finding : other.at("findings"))
    findings_.push_back(finding);
}

nlohmann::json Report::json() const {
  return {{"frames", frames_},
          {"pictures", pictures_},
          {"longest_seconds", longest_},
          {"longest_seed", longestSeed_},
          {"errors", errors_},
          {"worst", worst_},
          {"ill_conditioned", illConditioned_},
          {"loops", loops_},
          {"findings", findings_}};
}

std::string Report::text() const {
  std::string text =
      fmt::format("{} frames, {} pictures, {} findings; the longest frame (seed {}) took {:.2f} s\n\n| rRMSE |",
                  frames_, pictures_, findings_.size(), longestSeed_, longest_);
  for (const double end : kErrorClasses)
    text += fmt::format(" <= {:g} |", end);
  text += " more | ill-conditioned | worst, of seed |\n|---|";
  for (std::size_t i = 0; i < kErrorClasses.size() + 3; ++i)
    text += "---|";
  text += '\n';
  for (const auto& [run, counts] : errors_) {
    text += "| " + run + " |";
    for (const std::uint64_t count : counts)
      text += fmt::format(" {} |", count);
    const auto ill = illConditioned_.find(run);
    text += fmt::format(" {} |", ill == illConditioned_.end() ? 0 : ill->second);
    const auto worst = worst_.find(run);
    text += worst == worst_.end() ? " |\n" : fmt::format(" {:.2g}, {} |\n", worst->second.first, worst->second.second);
  }
  if (!loops_.empty()) text += "\n| loop, or all loops of a pass | most turns | seed |\n|---|---|---|\n";
  for (const auto& [name, most] : loops_)
    text += fmt::format("| `{}` | {} | {} |\n", name, most.first, most.second);
  return text;
}

} // namespace stress
