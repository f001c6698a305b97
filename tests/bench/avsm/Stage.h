// A scene's segments on the GPU: captures them, and looks up what methods keep.
#pragma once

#include "MapScenes.h"
#include "Method.h"

namespace avsmbench {

/// A depth of a texel that a method is asked for.
struct Query {
  std::uint32_t texel = 0;
  float depth = 0;
};

class Stage {
public:
  explicit Stage(const MapScene& scene);

  /// begin(), and every segment captured.
  void capture(tyndall::Avsm& lists);
  /// Twice if the lists had not room for all. Throws host::Error if even then some were lost.
  void captureAll(tyndall::Avsm& lists);

  std::vector<float> answers(const Method& method, const std::vector<Query>& queries) const;

  int size() const { return size_; }

private:
  int size_;
  std::size_t count_;
  host::GlBuffer segments_;
  ComputeProgram capture_;
};

/// Look-ups for every pixel of an image, bilinear in the map.
class LookUps {
public:
  /// byMethod: by the method's own filter, else by the same for all.
  LookUps(const Method& method, int mapSize, bool byMethod);

  void run() const;
  std::vector<float> image() const;

  static constexpr int kWidth = 1280, kHeight = 720;

private:
  const Method& method_;
  int mapSize_;
  ComputeProgram program_;
  host::GlTexture positions_, result_;
};

} // namespace avsmbench
