// tyndall-render: a glTF scene with volumetric shadows, to EXR and PNG.

#include "CommandLine.h"
#include "Options.h"
#include "OutputNames.h"
#include "Outputs.h"
#include "Progress.h"
#include "RenderFrame.h"

#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Tool.h>

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
                            options.height, renderer.lightCount(), options.technique, frame.measurement.median(),
                            renderer.context().driver()));
}

std::vector<FrameStatistics> renderFrames(const Options& options, const FrameRange& range, FrameRenderer& renderer) {
  Progress progress(range.count());
  std::vector<FrameStatistics> statistics;
  std::size_t printed = 0;
  std::optional<float> exposure;
  if (options.exposureStops) exposure = static_cast<float>(std::exp2(*options.exposureStops));
  for (int frame = range.first; frame <= range.last; ++frame) {
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

int run(const Options& options) {
  const FrameRange range = options.frames.value_or(FrameRange{});
  const OutputNames names(options);
  FrameRenderer renderer(options);
  names.requireOthersThan(renderer.scene().files);
  const std::vector<FrameStatistics> statistics = renderFrames(options, range, renderer);
  if (options.stats) writeStatistics(*options.stats, options, renderer.context(), statistics);
  if (options.out.empty() && !options.stats) printSummary(options, renderer, statistics);
  return 0;
}

} // namespace

} // namespace render

int main(int argc, char** argv) {
  return render::runCommand("tyndall-render", [&] { return render::run(render::parseOptions(argc, argv)); });
}
