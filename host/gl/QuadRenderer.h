// What the renderers of smoke and strands share: quads, one for each ball or segment, about an origin of their own,
// that are captured from lights and blended into the picture.
#pragma once

#include "gl/CameraView.h"
#include "gl/LightTexture.h"
#include "gl/RenderTargets.h"

#include <optional>

namespace host {

/// Sources without #version lines. `picture` and `capture` are fragment shaders and go behind `shared`.
struct QuadShaders {
  const char* name;
  const char* vertex;
  const char* shared;
  const char* picture;
  const char* capture;
  const char* light; ///< LightTexture's
  GLenum lightFilter;
};

class QuadRenderer {
protected:
  static constexpr GLuint kLightUnit = kFirstFreeUnit, kFirstOwnUnit = kFirstFreeUnit + 1;

  explicit QuadRenderer(const QuadShaders& shaders);

  /// The middle of all becomes the origin.
  template <typename Point>
  void centreOn(const std::vector<Point>& points) {
    if (points.empty()) return;
    glm::dvec3 low = points.front().position, high = low;
    for (const Point& point : points) {
      low = glm::min(low, point.position);
      high = glm::max(high, point.position);
    }
    origin_ = 0.5 * (low + high);
  }

  /// The capture's program in use, for the Avsm whose lists are bound; what depends on the buffers is the caller's.
  Program& beginCapture(const CaptureView& view);

  /// The picture's program in use, the targets bound, blending on and the light's texture set.
  Program& beginPicture(const CameraView& camera, const RenderTargets& targets);

  /// With the program in use.
  void drawQuads(Program& program, std::size_t count) const;

  /// Rows of `across` that hold so many.
  static int rowsOf(std::size_t count, int across) { return (static_cast<int>(count) + across - 1) / across; }

  const glm::dvec3& origin() const { return origin_; }
  LightTexture& light() { return light_; }

private:
  void begin(Program& program, const glm::dmat4& clipFromWorld, const glm::vec4& eye) const;

  QuadShaders shaders_;
  glm::dvec3 origin_{0}; ///< of relative positions
  LightTexture light_;
  Program picture_;
  std::optional<Program> capture_; ///< needs OpenGL 4.3
  GlVertexArray empty_;
};

} // namespace host
