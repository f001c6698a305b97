// Prints what a look-up of light along camera rays (Frame::lookup) costs beside the frame without it, and how far what
// a shader looks up is from exact that is cut there: at the distances that a quarter, a half and three quarters of the
// surfaces lie within, over the pixels that see farther. Layers lie between a tenth of the surfaces' median distance
// and the farthest one. tyndall-look-up [SCENE…]
#include "reference/CameraRays.h"
#include "render/SceneAnswers.h"
#include "support/ShaftsLookup.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <gl/Gl.h>
#include <gl/ReadBack.h>
#include <render/CommandLine.h>
#include <render/RenderFrame.h>
#include <scene/Error.h>
#include <scene/Tool.h>

namespace {

using tyndall::Frame;

constexpr int kRuns = 7;

struct Size {
  int width, height, depths;
};
constexpr Size kSizes[] = {{80, 45, 24}, {160, 90, 32}, {160, 90, 64}, {320, 180, 32}};

std::string percentOf(double share) {
  return share < 1 ? fmt::format(" {:.2g} % |", 100 * share) : fmt::format(" {:.0f} % |", 100 * share);
}

class Table {
public:
  explicit Table(const render::Options& options) : renderer_(options) {
    renderer_.draw(0);
    frame_ = renderer_.frame();
    frame_.settings = tyndall::settingsOf(tyndall::Profile::High);
    tyndall::Config config;
    config.loader = renderer_.context().loader();
    tyndall::CreateResult created = tyndall::Effect::create(config);
    if (!created.status) throw host::Error(created.status.message);
    effect_ = std::move(created.effect);
    // Along each pixel's ray, as the look-up's distances are.
    distances_ = raysOf(renderer_.frame());
  }

  void print(const std::string& scene) {
    std::vector<double> surfaces;
    for (const double distance : distances_)
      if (std::isfinite(distance)) surfaces.push_back(distance);
    if (surfaces.empty()) throw host::Error(scene + " has no surfaces in view");
    std::sort(surfaces.begin(), surfaces.end());
    const double far = surfaces.back(), near = 0.1 * surfaces[surfaces.size() / 2];
    std::vector<double> cuts;
    std::vector<reference::Image> truths;
    for (const double share : {0.25, 0.5, 0.75}) {
      cuts.push_back(surfaces[static_cast<std::size_t>(share * static_cast<double>(surfaces.size() - 1))]);
      truths.push_back(cutAt(cuts.back()));
    }
    for (const Size& size : kSizes) {
      tests::ShaftsLookup lookup(size.width, size.height, size.depths, {near, far}, GL_RGBA16F);
      Frame with = frame_;
      lookup.enter(with);
      std::string row =
          fmt::format("| {} | {} × {} × {} | {:.2f}× |", scene, size.width, size.height, size.depths, ratio(with));
      for (std::size_t i = 0; i < cuts.size(); ++i) {
        const reference::Image got = lookup.at(cuts[i], frame_.viewport.width, frame_.viewport.height).inscatter;
        row += percentOf(error(got, truths[i], cuts[i]));
      }
      host::print(row + "\n");
    }
  }

private:
  static std::vector<double> raysOf(const Frame& frame) {
    const int width = frame.viewport.width, height = frame.viewport.height;
    const std::vector<float> depth = host::readDepth(frame.depth.texture, width, height);
    const reference::CameraRays rays(frame.camera, width, height);
    std::vector<double> distances;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        distances.push_back(rays.distance(x, y, depth[static_cast<std::size_t>(y * width + x)]));
    return distances;
  }

  void render(const Frame& frame) {
    if (const tyndall::Status status = effect_->render(frame); !status) throw host::Error(status.message);
  }

  double timeOf(const Frame& frame) {
    host::gl().Finish();
    const auto start = std::chrono::steady_clock::now();
    render(frame);
    host::gl().Finish();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  /// Of medians, one after the other in turn.
  double ratio(const Frame& with) {
    std::vector<double> plain, looked;
    render(with);
    render(frame_);
    for (int i = 0; i < kRuns; ++i) {
      plain.push_back(timeOf(frame_));
      looked.push_back(timeOf(with));
    }
    for (std::vector<double>* times : {&plain, &looked})
      std::nth_element(times->begin(), times->begin() + kRuns / 2, times->end());
    return looked[kRuns / 2] / plain[kRuns / 2];
  }

  /// Exact's inscatter, as if all surfaces were at that distance.
  reference::Image cutAt(double distance) {
    const int width = frame_.viewport.width, height = frame_.viewport.height;
    const host::GlTexture depth = host::makeTexture2D(GL_R32F, width, height);
    const std::vector<float> values(static_cast<std::size_t>(width * height), static_cast<float>(distance));
    host::gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RED, GL_FLOAT, values.data());
    Frame cut = frame_;
    cut.depth = {};
    cut.depth.texture = depth.name();
    cut.depth.encoding = tyndall::DepthEncoding::Radial;
    cut.settings = tyndall::settingsOf(tyndall::Profile::Reference);
    render(cut);
    return {width, height, host::readColour(frame_.output.inscatter, width, height, 3)};
  }

  /// Root mean square over the pixels that see farther, as a part of the mean there.
  double error(const reference::Image& got, const reference::Image& truth, double distance) const {
    double squares = 0, sum = 0, count = 0;
    for (std::size_t i = 0; i < distances_.size(); ++i) {
      if (distances_[i] < distance) continue;
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
        squares += (got.rgb[c] - truth.rgb[c]) * (got.rgb[c] - truth.rgb[c]);
        sum += truth.rgb[c];
        ++count;
      }
    }
    return sum > 0 ? std::sqrt(squares / count) / (sum / count) : 0;
  }

  render::FrameRenderer renderer_;
  Frame frame_;
  std::unique_ptr<tyndall::Effect> effect_;
  std::vector<double> distances_;
};

} // namespace

int main(int argc, char** argv) {
  return render::runCommand("tyndall-look-up", [&] {
    const std::vector<std::string> scenes = tests::parseSceneNames(
        "Prints what a look-up of light along camera rays costs, and how far off it is.", argc, argv);
    host::print(
        "| scene | texels, layers | time | rRMSE, a quarter | half | three quarters |\n|---|---|---|---|---|---|\n");
    for (const std::string& scene : scenes)
      Table(tests::sampleOptions(scene, 1280, 720, 4096)).print(scene);
    return 0;
  });
}
