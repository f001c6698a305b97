#include "Stage.h"

#include <cmath>
#include <gl/ReadBack.h>
#include <scene/Error.h>

namespace avsmbench {

namespace {

using host::gl;

constexpr GLuint kDrawn = 3, kQueries = 6, kResults = 7; // storage bindings
constexpr const char* kMapSize = "uniform int mapSize;\n";

std::vector<std::string> with(std::vector<std::string> files, const char* file) {
  files.emplace_back(file);
  return files;
}

Defines with(Defines defines, bool ownFilter) {
  defines.emplace_back("OWN_FILTER", ownFilter ? 1 : 0);
  return defines;
}

/// Of an image's pixels as a camera sees surfaces: smooth, over the whole map and all depths, turned
/// against the map's axes, with edges where the depth jumps.
std::vector<Position> makePositions() {
  std::vector<Position> all;
  all.reserve(std::size_t{LookUps::kWidth} * LookUps::kHeight);
  for (int y = 0; y < LookUps::kHeight; ++y)
    for (int x = 0; x < LookUps::kWidth; ++x) {
      const double u = (x + 0.5) / LookUps::kWidth, v = (y + 0.5) / LookUps::kHeight;
      const double placeX = 0.5 + 0.9 * (u - 0.5) - 0.15 * (v - 0.5), placeY = 0.5 + 0.9 * (v - 0.5) + 0.15 * (u - 0.5);
      const double bands = 5 * u + 2 * v, band = std::floor(bands);
      const double depth = 0.5 + 0.5 * std::sin(2.4 * band + 1.5 * (bands - band) + 2 * v);
      all.emplace_back(placeX, placeY, depth);
    }
  return all;
}

} // namespace

Stage::Stage(const MapScene& scene)
    : size_(scene.size), count_(scene.segments.size()), segments_(host::makeBuffer()), capture_({"capture.comp"}) {
  fillStorage(segments_, kDrawn, count_ * sizeof(DrawnSegment), scene.segments.data());
}

void Stage::capture(tyndall::Avsm& lists) {
  if (const tyndall::Status status = lists.begin(); !status) throw host::Error(status.message);
  if (count_ == 0) return;
  gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, kDrawn, segments_.name());
  capture_.use();
  ComputeProgram::dispatch((count_ + 255) / 256);
}

void Stage::captureAll(tyndall::Avsm& lists) {
  avsmbench::captureAll(lists, [&] { capture(lists); });
}

void captureAll(tyndall::Avsm& lists, const std::function<void()>& draw) {
  std::uint64_t lost = 0;
  for (int frame = 0; frame < 2; ++frame) { // the first one tells how much room is needed
    draw();
    if (const tyndall::Status status = lists.resolve(); !status) throw host::Error(status.message);
    lost = lists.statistics().lost;
  }
  if (lost > 0) throw host::Error("segments were lost");
  draw();
}

std::vector<float> Stage::answers(const Method& method, const std::vector<Query>& queries) const {
  const ComputeProgram program(with(method.lookUpFiles(), "judge.comp"), method.lookUpDefines(), kMapSize);
  const host::GlBuffer input = host::makeBuffer(), output = host::makeBuffer();
  fillStorage(input, kQueries, queries.size() * sizeof(Query), queries.data());
  fillStorage(output, kResults, queries.size() * sizeof(float), nullptr);
  program.use();
  program.set("mapSize", size_);
  method.bindForLookUp();
  ComputeProgram::dispatch((queries.size() + 255) / 256);
  std::vector<float> results(queries.size());
  gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, output.name());
  gl().GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(results.size() * sizeof(float)),
                        results.data());
  return results;
}

LookUps::LookUps(const Method& method, int mapSize, bool byMethod)
    : LookUps(method, mapSize, byMethod, makePositions(), kWidth, kHeight) {}

LookUps::LookUps(const Method& method, int mapSize, bool byMethod, const std::vector<Position>& positions, int width,
                 int height)
    : method_(method), mapSize_(mapSize), width_(width), height_(height),
      program_(with(method.lookUpFiles(), "lookUp.comp"), with(method.lookUpDefines(), byMethod), kMapSize) {
  gl().ActiveTexture(GL_TEXTURE1);
  positions_ = host::makeTexture2D(GL_RGBA32F, width, height);
  gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_FLOAT, positions.data());
  result_ = host::makeTexture2D(GL_R32F, width, height);
}

void LookUps::run() const {
  program_.use();
  program_.set("mapSize", mapSize_);
  gl().ActiveTexture(GL_TEXTURE1);
  gl().BindTexture(GL_TEXTURE_2D, positions_.name());
  gl().BindImageTexture(1, result_.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  method_.bindForLookUp();
  ComputeProgram::dispatch(static_cast<std::size_t>((width_ + 7) / 8), static_cast<std::size_t>((height_ + 7) / 8));
}

std::vector<float> LookUps::image() const { return host::readColour(result_.name(), width_, height_, 1); }

} // namespace avsmbench
