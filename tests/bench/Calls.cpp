#include "Calls.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <gl/Gl.h>
#include <scene/Error.h>
#include <vector>

namespace bench {

namespace {

double processorMilliseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times.at(times.size() / 2);
}

void render(tyndall::Effect& effect, const tyndall::Frame& frame) {
  const tyndall::Status status = effect.render(frame);
  if (!status) throw host::Error("effect: " + status.message);
}

CallTime timeOf(tyndall::StateMode mode, tyndall::GlLoader loader, const tyndall::Frame& frame, int runs) {
  constexpr int kWarmUps = 2; // the first compiles
  tyndall::Config config;
  config.loader = loader;
  config.state = mode;
  const tyndall::CreateResult created = tyndall::Effect::create(config);
  if (!created.effect) throw host::Error("effect: " + created.status.message);
  for (int i = 0; i < kWarmUps; ++i)
    render(*created.effect, frame);
  std::vector<double> wall, processor;
  for (int run = 0; run < runs; ++run) {
    host::gl().Finish();
    const auto start = std::chrono::steady_clock::now();
    const double startOfProcessor = processorMilliseconds();
    render(*created.effect, frame);
    processor.push_back(processorMilliseconds() - startOfProcessor);
    wall.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  host::gl().Finish();
  return {median(wall), median(processor)};
}

} // namespace

CallTimes callTimes(const tyndall::Settings& settings, tyndall::GlLoader loader, tyndall::Frame frame, int runs) {
  frame.settings = settings;
  return {timeOf(tyndall::StateMode::Restore, loader, frame, runs),
          timeOf(tyndall::StateMode::Leave, loader, frame, runs)};
}

} // namespace bench
