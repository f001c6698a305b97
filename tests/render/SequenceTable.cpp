// tyndall-sequence: the frames of an animation in full, with what moved told by the scene's nodes, and with it found by
// comparison; each frame's times, one after the other in one process, as CSV. Takes tyndall-render's options.
#include "render/CommandLine.h"
#include "render/Options.h"
#include "render/RenderFrame.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <gl/Gl.h>
#include <gl/ReadBack.h>
#include <scene/Error.h>
#include <scene/Tool.h>
#include <settings/Tables.h>

namespace {

using tyndall::Changes;

constexpr std::array<Changes, 3> kWays = {Changes::Unknown, Changes::Objects, Changes::Detect};

struct Way {
  std::unique_ptr<tyndall::Effect> effect;
  double milliseconds = 0, share = 0, error = 0;
};

std::unique_ptr<tyndall::Effect> makeEffect(const render::FrameRenderer& renderer, const tyndall::Tuning& tuning) {
  tyndall::CreateResult created = tyndall::Effect::create(
      {renderer.context().loader(), tyndall::PassTiming::Off, {}, tyndall::StateMode::Restore, tuning});
  if (!created.status) throw host::Error("effect: " + created.status.message);
  return std::move(created.effect);
}

void renderTimed(Way& way, const tyndall::Frame& frame) {
  host::gl().Finish();
  const auto start = std::chrono::steady_clock::now();
  const tyndall::Status status = way.effect->render(frame);
  host::gl().Finish();
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  if (!status) throw host::Error("effect: " + status.message);
  way.milliseconds = time.count();
  way.share = way.effect->statistics().redrawnShare;
}

// The frame's colour by one way: what was in the texture does not count.
std::vector<float> colourOf(const tyndall::Frame& frame) {
  return host::readColour(frame.colour, frame.viewport.width, frame.viewport.height);
}

void clearColour(const tyndall::Frame& frame) {
  const std::vector<float> grey(
      static_cast<std::size_t>(frame.viewport.width) * static_cast<std::size_t>(frame.viewport.height) * 4, 0.5F);
  host::gl().BindTexture(GL_TEXTURE_2D, frame.colour);
  host::gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, frame.viewport.width, frame.viewport.height, GL_RGBA, GL_FLOAT,
                           grey.data());
}

// The largest difference, as a part of the picture's mean.
double difference(const std::vector<float>& a, const std::vector<float>& b) {
  double most = 0, sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
    sum += std::abs(static_cast<double>(b[i]));
  }
  return sum > 0 ? most * static_cast<double>(a.size()) / sum : most;
}

int run(render::Options options) {
  if (!options.frames) throw render::UsageError("--frames is missing");
  options.reuse.changes = Changes::Objects; // the renderer tells what moved
  options.programs.reset();                 // a measurement depends on no earlier one
  options.debug = false;
  render::FrameRenderer renderer(options);
  std::array<Way, kWays.size()> ways;
  for (Way& way : ways)
    way.effect = makeEffect(renderer, options.tuning);
  host::print(fmt::format("# {}, {}x{}, shadow map {}, profile {}, {}\n", options.scene.filename().string(),
                          options.width, options.height, options.shadowSize, settings::nameOf(options.profile),
                          renderer.context().driver()));
  host::print("frame,full_ms,objects_ms,detect_ms,objects_share,detect_share,objects_error,detect_error\n");
  for (int number = options.frames->first; number <= options.frames->last; ++number) {
    renderer.draw(number);
    std::vector<float> full;
    for (std::size_t i = 0; i < kWays.size(); ++i) {
      tyndall::Frame frame = renderer.frame();
      frame.output = {};
      frame.reuse.changes = kWays[i];
      if (kWays[i] != Changes::Objects) frame.objects.clear();
      clearColour(frame);
      renderTimed(ways[i], frame);
      const std::vector<float> colour = colourOf(frame);
      if (i == 0) full = colour;
      ways[i].error = difference(colour, full);
    }
    host::print(fmt::format("{},{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.2e},{:.2e}\n", number, ways[0].milliseconds,
                            ways[1].milliseconds, ways[2].milliseconds, ways[1].share, ways[2].share, ways[1].error,
                            ways[2].error));
  }
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  return render::runCommand("tyndall-sequence", [&] { return run(render::parseOptions(argc, argv)); });
}
