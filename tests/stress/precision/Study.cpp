#include "Study.h"

#include "RoundingContext.h"
#include "Scenes.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <ostream>
#include <set>

namespace precision {

namespace {

constexpr Format kFormats[] = {Format::Half, Format::Unorm16, Format::Float24, Format::Unorm24, Format::Packed11};

// An effect for each tuning, which keeps its programs.
class Effects {
public:
  explicit Effects(tyndall::GlLoader loader) : loader_(loader) {}

  tyndall::Effect& of(const tyndall::Tuning& tuning) {
    std::unique_ptr<tyndall::Effect>& effect = effects_[{int(tuning.reuse), int(tuning.compositing)}];
    if (!effect) {
      tyndall::Config config;
      config.loader = loader_;
      config.tuning = tuning;
      effect = tests::newEffect(config);
    }
    return *effect;
  }

private:
  tyndall::GlLoader loader_;
  std::map<std::pair<int, int>, std::unique_ptr<tyndall::Effect>> effects_;
};

struct Drawn {
  reference::Image picture;
  std::set<Target> targets;
};

bool uses(const Drawn& drawn, const Line& line) {
  return std::any_of(line.targets.begin(), line.targets.end(),
                     [&](const std::string& target) { return drawn.targets.count({target, line.format}) != 0; });
}

class Runner {
public:
  explicit Runner(std::ostream& csv) : csv_(csv), effects_(context_.loader()), scenes_(studyScenes()) {
    csv_ << "line,stored,format,scene,rRMSE,p99,max\n";
  }

  Study run() {
    Study study;
    for (const Line& line : studyLines()) {
      study.lines.emplace_back();
      study.lines.back().line = line;
    }
    drawWide(study);
    for (LineResult& result : study.lines)
      measure(result);
    return study;
  }

private:
  // All in 32 bits, what each scene uses, and beside it what the effect makes of it.
  void drawWide(Study& study) {
    Effects plain(tests::testContext().loader());
    context_.watch(true);
    for (const Scene& scene : scenes_) {
      context_.takeSeen();
      Drawn drawn{scene.draw(effects_.of(scene.tuning)), {}};
      for (const auto& [target, seen] : context_.takeSeen()) {
        drawn.targets.insert(target);
        note(study, target, seen);
      }
      const reference::Image stored = scene.draw(plain.of(scene.tuning));
      SceneResult result{scene.name, static_cast<bool>(scene.truth), {}, {}, reference::compare(stored, drawn.picture)};
      if (result.hasTruth) {
        const reference::Image truth = scene.truth();
        result.wide = reference::compare(drawn.picture, truth);
        result.stored = reference::compare(stored, truth);
      }
      study.scenes.push_back(result);
      drawn_.push_back(std::move(drawn));
    }
    context_.watch(false);
  }

  static void note(Study& study, const Target& target, const Seen& seen) {
    for (LineResult& result : study.lines) {
      const std::vector<std::string>& targets = result.line.targets;
      if (result.line.format != target.format) continue;
      if (std::find(targets.begin(), targets.end(), target.name) == targets.end()) continue;
      result.least = result.scenes == 0 ? seen.least : std::min(result.least, seen.least);
      result.greatest = result.scenes == 0 ? seen.greatest : std::max(result.greatest, seen.greatest);
      ++result.scenes;
    }
  }

  void measure(LineResult& result) {
    const Line& line = result.line;
    result.scenes = 0;
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      if (!uses(drawn_[i], line) || (!scenes_[i].line.empty() && scenes_[i].line != line.name)) continue;
      ++result.scenes;
      for (const Format format : kFormats) {
        std::map<Target, Rounding> roundings;
        for (const std::string& target : line.targets)
          roundings[{target, line.format}] = {format, line.isBound, Direction::Nearest};
        context_.round(roundings);
        const reference::ErrorMetrics error =
            reference::compare(scenes_[i].draw(effects_.of(scenes_[i].tuning)), drawn_[i].picture);
        csv_ << fmt::format("{},{},{},\"{}\",{:.4g},{:.4g},{:.4g}\n", line.name, line.format, nameOf(format),
                            scenes_[i].name, error.rRmse, error.p99, error.max);
        Loss& loss = result.losses[format];
        if (loss.scene.empty() || error.rRmse > loss.worst.rRmse) loss = {error, scenes_[i].name};
      }
    }
    context_.round({});
  }

  std::ostream& csv_;
  RoundingContext context_;
  Effects effects_;
  std::vector<Scene> scenes_;
  std::vector<Drawn> drawn_;
};

std::string percent(double share) {
  if (!std::isfinite(share)) return "fails";
  if (share == 0) return "0";
  return fmt::format("{:.1g}", 100 * share);
}

std::string cellOf(const LineResult& result, Format format) {
  const auto found = result.losses.find(format);
  if (found == result.losses.end()) return "";
  const Loss& loss = found->second;
  if (!std::isfinite(loss.worst.rRmse)) return "fails, " + loss.scene;
  if (loss.worst.max == 0) return "0";
  return fmt::format("{} · {} · {}, {}", percent(loss.worst.rRmse), percent(loss.worst.p99), percent(loss.worst.max),
                     loss.scene);
}

} // namespace

Study runStudy(std::ostream& csv) { return Runner(csv).run(); }

std::string markdown(const Study& study) {
  std::string text = "| line | stored in | least … greatest | scenes |";
  for (const Format format : kFormats)
    text += fmt::format(" {} |", nameOf(format));
  text += "\n|---|---|---|---|---|---|---|---|---|\n";
  for (const LineResult& result : study.lines) {
    text += fmt::format("| {} | {} | {:.3g} … {:.3g} | {} |", result.line.name, result.line.format, result.least,
                        result.greatest, result.scenes);
    for (const Format format : kFormats)
      text += " " + cellOf(result, format) + " |";
    text += "\n";
  }
  text += "\n| scene | 32 bits, against map-exact | as stored, against map-exact | as stored, against 32 bits |\n"
          "|---|---|---|---|\n";
  for (const SceneResult& scene : study.scenes) {
    const auto errors = [&](const reference::ErrorMetrics& e) {
      return fmt::format("{:.2g} · {:.2g} · {:.2g}", 100 * e.rRmse, 100 * e.p99, 100 * e.max);
    };
    text += fmt::format("| {} | {} | {} | {} |\n", scene.scene, scene.hasTruth ? errors(scene.wide) : "",
                        scene.hasTruth ? errors(scene.stored) : "", errors(scene.difference));
  }
  return text;
}

} // namespace precision
