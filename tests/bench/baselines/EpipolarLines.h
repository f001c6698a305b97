// The epipolar lines of one directional light: where they run in the image.
#pragma once

#include <glm/glm.hpp>
#include <tyndall/tyndall.h>
#include <vector>

namespace host {
class Program;
}

namespace bench {

struct EpipolarLines {
  std::vector<glm::vec4> ends; ///< entry xy, exit xy of each line, pixels
  glm::vec4 epipole{0};        ///< homogeneous pixel position of what the light comes from; w: sign of its w
  glm::vec4 border{0};         ///< low x, low y, high x, high y
  glm::vec4 arc{0};            ///< begin, length per line, perimeter; w: 1 if the epipole is in the image
  int samples = 0;

  EpipolarLines(const tyndall::Frame& frame, const tyndall::Light& light, int lines, int samplesPerLine);

  /// Sets the uniforms of common/epipolar.glsl.
  void set(host::Program& program) const;
};

} // namespace bench
