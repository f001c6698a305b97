// tyndall-render: a glTF scene with volumetric shadows, to EXR and PNG.

#include "CommandLine.h"
#include "Options.h"
#include "OutputNames.h"
#include "Outputs.h"
#include "Progress.h"
#include "RenderFrame.h"
#include "Resume.h"

#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Tool.h>
#include <settings/Tables.h>

namespace render {

namespace {

/// Prints the notes from `printed` on.
void printNotes(const host::Notes& notes, std::size_t& printed) {
  for (; printed < notes.size(); ++printed)
    host::say("note: " + notes[printed]);
}

void printSummary(const Options& options, const FrameRenderer& renderer, const std::vector<FrameStatistics>& frames) {
  for (const FrameStatistics& frame : frames)
    host::print(fmt::format("{} frame {}: {}x{}, {} lights, technique {}: effect {:.1f} ms ({})\n",
                            host::printable(options.scene.filename().string()), frame.frame, options.width,
                            options.height, renderer.lightCount(), settings::nameOf(options.settings.technique),
                            frame.measurement.median(), renderer.context().driver()));
}

/// What is given, or by the first of all frames, also where another run draws that one.
std::optional<float> exposureBefore(int frame, const Options& options, FrameRenderer& renderer) {
  if (options.exposureStops) return static_cast<float>(std::exp2(*options.exposureStops));
  const int first = options.frames.value_or(FrameRange{}).first;
  if (frame == first || !needsExposure(options)) return std::nullopt;
  renderer.render(first);
  return exposureOf(renderer.readPicture());
}

std::vector<FrameStatistics> renderFrames(const Options& options, const std::vector<int>& frames,
                                          FrameRenderer& renderer) {
  Progress progress(static_cast<int>(frames.size()));
  std::vector<FrameStatistics> statistics;
  std::size_t printed = 0;
  std::optional<float> exposure = exposureBefore(frames.front(), options, renderer);
  for (const int frame : frames) {
    statistics.push_back({frame, renderer.render(frame)});
    printNotes(renderer.notes(), printed);
    if (options.strict && printed > 0)
      throw host::Error(fmt::format("{}: --strict allows no notes, there are {}", options.scene.string(), printed));
    if (!options.out.empty()) {
      const Picture picture = renderer.readPicture();
      if (!exposure) exposure = exposureOf(picture);
      for (const std::filesystem::path& file : options.out)
        writePicture(nameOfFrame(file, frame), picture, options, *exposure);
    }
    progress.step(statistics.back().measurement.median());
  }
  return statistics;
}

/// The frames that are to be drawn, fewer than all where it resumes.
std::vector<int> framesToDraw(const Options& options) {
  if (!options.resume) return framesOf(options);
  std::vector<int> missing = missingFrames(options);
  const std::size_t count = framesOf(options).size();
  host::say(fmt::format("{} of {} frames are whole and stay", count - missing.size(), count));
  return missing;
}

int printMissing(const Options& options) {
  const std::vector<int> missing = missingFrames(options);
  if (missing.empty()) return 0;
  host::print(rangesOf(missing) + "\n");
  return 1;
}

int run(const Options& options) {
  if (options.missing) return printMissing(options);
  const OutputNames names(options);
  const std::vector<int> frames = framesToDraw(options);
  if (frames.empty()) return 0;
  FrameRenderer renderer(options);
  names.requireOthersThan(renderer.scene().files);
  const std::vector<FrameStatistics> statistics = renderFrames(options, frames, renderer);
  if (options.stats) writeStatistics(*options.stats, options, renderer.context(), statistics);
  if (options.out.empty() && !options.stats) printSummary(options, renderer, statistics);
  return 0;
}

} // namespace

} // namespace render

int main(int argc, char** argv) {
  return render::runCommand("tyndall-render", [&] { return render::run(render::parseOptions(argc, argv)); });
}
