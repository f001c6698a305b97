// Two effects in two contexts in two threads, at once: each draws, bit for bit, what one draws alone. For
// ThreadSanitizer (tests/stress/tsan.sh), and by itself. Loaders of scenes load and are cancelled beside them.
//
//     tyndall-two-threads [--plant-race] [osmesa|egl] [SCENE.glb]
//
// --plant-race has both threads count in one variable without a lock, from within the effect: a sanitizer that does not
// find that finds nothing.
#include "gl/Context.h"
#include "gl/Objects.h"
#include "gl/ReadBack.h"
#include "viewer/core/SceneLoader.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <scene/Error.h>
#include <string>
#include <thread>
#include <tyndall/tyndall.h>
#include <vector>

namespace {

using namespace tyndall;

constexpr int kWidth = 40, kHeight = 24, kMapSize = 48, kFrames = 4;

int raced = 0; // by --plant-race, and by nothing else

glm::dmat4 lightView(double angle) {
  const glm::dvec3 eye(4 * std::sin(angle), 8, 3);
  return glm::ortho(-8.0, 8.0, -8.0, 8.0, 0.5, 30.0) * glm::lookAt(eye, glm::dvec3(0), glm::dvec3(0, 0, 1));
}

host::GlTexture depthTexture(int size, const std::vector<float>& depth, int height) {
  host::GlTexture texture = host::makeTexture2D(GL_R32F, size, height);
  host::gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size, height, GL_RED, GL_FLOAT, depth.data());
  return texture;
}

/// Bars that move on from frame to frame, before a ground.
std::vector<float> bars(int width, int height, int frame, float ground) {
  std::vector<float> depth;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      depth.push_back((x + frame) % 7 < 2 && y % 11 > 2 ? 0.4F + 0.01F * static_cast<float>(y % 5) : ground);
  return depth;
}

/// A context of one thread, an effect, and the textures of a frame.
class World {
public:
  World(host::ContextKind kind, int number, bool plantsRace)
      : context_(host::Context::create(kind)), number_(number), inscatter_(target()), transmittance_(target()) {
    Config config;
    config.loader = context_->loader();
    config.timing = PassTiming::TimerQuery;
    config.checkInputs = true;
    if (plantsRace) config.betweenDraws = [] { return ++raced > 0; };
    CreateResult created = Effect::create(config);
    if (!created.effect) throw host::Error(created.status.message);
    effect_ = std::move(created.effect);
  }

  /// All that the pictures of all techniques hold.
  std::vector<float> draw() {
    std::vector<float> all;
    for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank})
      for (const Changes changes : {Changes::Unknown, Changes::Detect})
        for (int frame = 0; frame < kFrames; ++frame)
          drawFrame(technique, changes, frame, all);
    const std::vector<std::string> errors = context_->takeErrors();
    if (!errors.empty()) throw host::Error("GL error: " + errors.front());
    return all;
  }

private:
  static host::GlTexture target() { return host::makeTexture2D(GL_RGBA32F, kWidth, kHeight); }

  Frame frameOf(Technique technique, Changes changes, int frame) const {
    Frame result;
    result.viewport = {0, 0, kWidth, kHeight};
    result.output.inscatter = inscatter_.name();
    result.output.transmittance = transmittance_.name();
    result.camera.clipFromView = mat4(glm::perspective(0.9, double(kWidth) / kHeight, 0.1, 60.0));
    result.camera.viewFromWorld = mat4(glm::lookAt(glm::dvec3(0, 2, 7), glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0)));
    result.medium.constituents = {{{0.05F, 0.06F, 0.07F}, Phase::HenyeyGreenstein, 0.4F}};
    result.settings.technique = technique;
    result.settings.samples = 64;
    result.reuse.changes = changes;
    result.reuse.eye = static_cast<std::uint64_t>(technique) + 1;
    Light sun;
    sun.direction = {-4 * std::sin(number_ * 0.3), -8, -3};
    sun.shadow.views = {{mat4(lightView(number_ * 0.3))}};
    result.lights = {sun};
    result.reuse.frame = static_cast<std::uint64_t>(frame);
    return result;
  }

  void drawFrame(Technique technique, Changes changes, int number, std::vector<float>& all) {
    const host::GlTexture depth = depthTexture(kWidth, bars(kWidth, kHeight, number, 0.97F), kHeight);
    const host::GlTexture map = depthTexture(kMapSize, bars(kMapSize, kMapSize, number, 1), kMapSize);
    Frame frame = frameOf(technique, changes, number);
    frame.depth.texture = depth.name();
    frame.lights[0].shadow.texture = map.name();
    while (!effect_->prepare(frame).ready())
      if (const PrepareStatus prepared = effect_->prepare(frame); !prepared.status)
        throw host::Error(prepared.status.message);
    if (const Status status = effect_->render(frame); !status) throw host::Error(status.message);
    effect_->statistics();
    for (const host::GlTexture* texture : {&inscatter_, &transmittance_}) {
      const std::vector<float> picture = host::readColour(texture->name(), kWidth, kHeight, 3);
      all.insert(all.end(), picture.begin(), picture.end());
    }
  }

  std::unique_ptr<host::Context> context_; // goes last
  int number_;                             // of the thread, whose sun stands elsewhere
  host::GlTexture inscatter_, transmittance_;
  std::unique_ptr<Effect> effect_;
};

struct Outcome {
  std::vector<float> pictures;
  std::string error;
};

Outcome drawAll(host::ContextKind kind, int number, bool plantsRace) {
  Outcome outcome;
  try {
    outcome.pictures = World(kind, number, plantsRace).draw();
  } catch (const std::exception& error) {
    outcome.error = error.what();
  }
  return outcome;
}

/// As the viewer does: one scene, another instead, none.
void loadScenes(const std::string& file) {
  viewer::SceneLoader loader;
  for (int i = 0; i < 4; ++i) {
    loader.start(file);
    while (i % 2 == 0 && !loader.isDone())
      std::this_thread::yield(), loader.stage(), loader.share();
    if (i % 2 == 0 && !loader.take()->scene) throw host::Error(file + " is not loaded");
  }
}

struct Arguments {
  bool plantsRace = false;
  host::ContextKind kind = host::defaultContextKind();
  std::string scene;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--plant-race")
      arguments.plantsRace = true;
    else if (word == "osmesa" || word == "egl")
      arguments.kind = host::parseContextKind(word);
    else
      arguments.scene = word;
  }
  return arguments;
}

bool tell(const Outcome& outcome, const Outcome& expected, int number) {
  const bool isLit = std::any_of(expected.pictures.begin(), expected.pictures.end(), [](float x) { return x > 0; });
  const bool isSame = outcome.error.empty() && isLit && outcome.pictures == expected.pictures;
  std::printf("thread %d: %zu numbers, %s\n", number, outcome.pictures.size(),
              isSame ? "those of one alone" : ("NOT those of one alone " + outcome.error).c_str());
  return isSame;
}

} // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  std::array<Outcome, 2> alone, together;
  for (int i = 0; i < 2; ++i)
    alone[i] = drawAll(arguments.kind, i, false);
  for (const Outcome& outcome : alone)
    if (!outcome.error.empty()) return std::fprintf(stderr, "%s\n", outcome.error.c_str()), 2;
  bool areSame = true;
  for (int round = 0; round < 2; ++round) {
    std::array<std::thread, 2> threads;
    for (int i = 0; i < 2; ++i)
      threads[i] = std::thread([&, i] { together[i] = drawAll(arguments.kind, i, arguments.plantsRace); });
    if (!arguments.scene.empty()) loadScenes(arguments.scene);
    for (std::thread& thread : threads)
      thread.join();
    for (int i = 0; i < 2; ++i)
      areSame = tell(together[i], alone[i], i) && areSame;
  }
  return areSame ? 0 : 1;
}
