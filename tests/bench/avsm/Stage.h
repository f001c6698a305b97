// A scene's segments on the GPU: captures them, and looks up what methods keep.
#pragma once

#include "MapScenes.h"
#include "Method.h"

#include <functional>

namespace avsmbench {

/// A depth of a texel that a method is asked for.
struct Query {
  std::uint32_t texel = 0;
  float depth = 0;
};

/// Draws into lists that have begun. Twice if they had not room for all. Throws host::Error if even then some were
/// lost.
void captureAll(tyndall::Avsm& lists, const std::function<void()>& draw);

class Stage {
public:
  explicit Stage(const MapScene& scene);

  /// begin(), and every segment captured.
  void capture(tyndall::Avsm& lists);
  /// The same by avsmbench::captureAll().
  void captureAll(tyndall::Avsm& lists);

  std::vector<float> answers(const Method& method, const std::vector<Query>& queries) const;

  int size() const { return size_; }

private:
  int size_;
  std::size_t count_;
  host::GlBuffer segments_;
  ComputeProgram capture_;
};

/// Place in the map, 0 to 1, and depth.
using Position = glm::vec3;

/// Look-ups for every pixel of an image, bilinear in the map.
class LookUps {
public:
  /// byMethod: by the method's own filter, else by the same for all.
  LookUps(const Method& method, int mapSize, bool byMethod);
  /// Of these positions in place of those of an image of surfaces, row by row.
  LookUps(const Method& method, int mapSize, bool byMethod, const std::vector<Position>& positions, int width,
          int height);

  void run() const;
  std::vector<float> image() const;

  static constexpr int kWidth = 1280, kHeight = 720;

private:
  const Method& method_;
  int mapSize_, width_, height_;
  ComputeProgram program_;
  host::GlTexture positions_, result_;
};

} // namespace avsmbench
