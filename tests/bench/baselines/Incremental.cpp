// Incremental integration on the CPU (Baran et al. 2010). The rays of an epipolar line run over the same row of shadow
// texels; at each texel the rays flatter than a critical slope are lit. From texel to texel only rays between the old
// and the new critical slope change: all work is done for those.
#include "baselines/DrawnBaseline.h"
#include "baselines/EpipolarLines.h"
#include "baselines/SharedPhysics.h"

#include "reference/Parallel.h"

#include <algorithm>
#include <cmath>
#include <gl/ReadBack.h>
#include <glm/gtc/constants.hpp>
#include <optional>

namespace bench {

namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::vec3;

struct Map {
  std::vector<float> depth; ///< grows away from the light; 3e38 without a caster
  int width = 0, height = 0;
};

/// The frame as the CPU needs it: matrices, distances, airlight of a directional light.
class CpuFrame {
public:
  CpuFrame(const tyndall::Frame& frame, const tyndall::Light& light, const glm::ivec2& shadowSize)
      : frame_(frame), cameraFromClip_(glm::inverse(clipFromCamera(frame))),
        texelFromCamera_(glm::inverse(cameraFromTexel(frame, light, shadowSize.x, shadowSize.y))),
        zeroToOne_(frame.camera.clipDepth == tyndall::ClipDepth::ZeroToOne),
        direction_(glm::normalize(dvec3(light.direction[0], light.direction[1], light.direction[2]))),
        colour_(light.colour[0], light.colour[1], light.colour[2]) {
    depth_ = readSceneDepth(frame);
    for (int c = 0; c < 3; ++c) {
      sigma_[c] = frame.medium.absorption[static_cast<std::size_t>(c)];
      for (const tyndall::Constituent& constituent : frame.medium.constituents)
        sigma_[c] += constituent.scattering[static_cast<std::size_t>(c)];
    }
    const double z0 = clipDepthOf(0), z1 = clipDepthOf(1);
    const dvec4 a = cameraFromClip_ * dvec4(0, 0, z0, 1), b = cameraFromClip_ * dvec4(0, 0, z1, 1);
    const double distance0 = glm::length(dvec3(a)) / std::abs(a.w), distance1 = glm::length(dvec3(b)) / std::abs(b.w);
    sky_ = !(distance0 > distance1) ? 1.0F : 0.0F; // an infinite far plane has w = 0
  }

  dvec3 rayThrough(const dvec2& p) const {
    const dvec4 q = cameraFromClip_ *
                    dvec4(2.0 * p / dvec2(frame_.viewport.width, frame_.viewport.height) - 1.0, clipDepthOf(0.5), 1);
    return glm::normalize(dvec3(q) / q.w);
  }

  /// Distance to the surface at a position, as its nearest pixel has it.
  double endAt(const dvec2& p) const {
    const int x = std::clamp(static_cast<int>(p.x), 0, frame_.viewport.width - 1);
    const int y = std::clamp(static_cast<int>(p.y), 0, frame_.viewport.height - 1);
    const float depth = depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.viewport.width) + x];
    if (depth == sky_) return std::min(frame_.medium.farDistance, 1e30);
    const dvec4 q = cameraFromClip_ *
                    dvec4(2.0 * p / dvec2(frame_.viewport.width, frame_.viewport.height) - 1.0, clipDepthOf(depth), 1);
    return glm::length(dvec3(q) / q.w);
  }

  /// Colour times the sum of sigma p, constant along a ray.
  vec3 sourceOf(const dvec3& ray) const {
    const double cosine = -glm::dot(direction_, ray), cosine2 = 1 + cosine * cosine, pi = glm::pi<double>();
    vec3 sum(0);
    for (const tyndall::Constituent& c : frame_.medium.constituents) {
      const double g = c.g, peak = std::pow(1 + g * g - 2 * g * cosine, -1.5);
      const double phase = c.phase == tyndall::Phase::Isotropic  ? 1 / (4 * pi)
                           : c.phase == tyndall::Phase::Rayleigh ? 3 / (16 * pi) * cosine2
                           : c.phase == tyndall::Phase::HenyeyGreenstein
                               ? (1 - g * g) / (4 * pi) * peak
                               : 3 * (1 - g * g) / (8 * pi * (2 + g * g)) * cosine2 * peak;
      sum += static_cast<float>(phase) * vec3(c.scattering[0], c.scattering[1], c.scattering[2]);
    }
    return sum * colour_;
  }

  /// Integral of exp(-sigma s) over [from, to].
  vec3 span(double from, double to) const {
    if (!(to > from)) return vec3(0);
    vec3 result(0);
    for (int c = 0; c < 3; ++c) {
      const auto begin = static_cast<float>(sigma_[c] * from), depth = static_cast<float>(sigma_[c] * (to - from));
      result[c] = std::exp(-begin) *
                  (depth > 1e-6F ? -std::expm1(-depth) / static_cast<float>(sigma_[c]) : static_cast<float>(to - from));
    }
    return result;
  }

  const glm::dmat4& texelFromCamera() const { return texelFromCamera_; }

private:
  double clipDepthOf(double depth) const { return zeroToOne_ ? depth : 2 * depth - 1; }

  static std::vector<float> readSceneDepth(const tyndall::Frame& frame) {
    GLint bits = 0;
    host::gl().ActiveTexture(GL_TEXTURE0 + kOwn);
    host::gl().BindTexture(GL_TEXTURE_2D, frame.depth.texture);
    host::gl().GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_DEPTH_SIZE, &bits);
    return bits > 0 ? host::readDepth(frame.depth.texture, frame.viewport.width, frame.viewport.height)
                    : host::readColour(frame.depth.texture, frame.viewport.width, frame.viewport.height, 1);
  }

  const tyndall::Frame& frame_;
  glm::dmat4 cameraFromClip_;
  glm::dmat4 texelFromCamera_;
  bool zeroToOne_;
  dvec3 direction_;
  vec3 colour_;
  dvec3 sigma_{0};
  std::vector<float> depth_;
  float sky_ = 1;
};

/// One line's rays by ascending slope in the light's depth, and the sweep over the texels that they share.
class LineSweep {
public:
  LineSweep(const CpuFrame& frame, const Map& map, const glm::vec4& ends, int samples)
      : frame_(frame), map_(map), rays_(static_cast<std::size_t>(samples)) {
    const dvec4 eye = frame.texelFromCamera() * dvec4(0, 0, 0, 1);
    eye_ = dvec3(eye) / eye.w;
    const auto last = static_cast<double>(samples - 1);
    const dvec4 along = frame.texelFromCamera() * dvec4(frame.rayThrough(dvec2(ends.z, ends.w)), 0);
    const double greater = std::max({std::abs(along.x), std::abs(along.y), 1e-300});
    step_ = dvec2(along) / greater;
    for (int i = 0; i < samples; ++i) {
      const dvec2 p = glm::mix(dvec2(ends.x, ends.y), dvec2(ends.z, ends.w), i / last);
      Ray& ray = rays_[static_cast<std::size_t>(i)];
      const dvec3 direction = frame.rayThrough(p);
      const dvec4 b = frame.texelFromCamera() * dvec4(direction, 0);
      // The ray at the epipole itself does not move: it gets the least speed that orders it.
      ray.speed = std::max(glm::dot(dvec2(b), step_) / glm::dot(step_, step_), 1e-12);
      ray.slope = b.z / ray.speed;
      ray.end = frame.endAt(p);
      ray.source = frame.sourceOf(direction);
      reach_ = std::max(reach_, ray.end * ray.speed);
      order_.push_back(i);
    }
    std::stable_sort(order_.begin(), order_.end(), [this](int a, int b) { return at(a).slope < at(b).slope; });
  }

  /// Inscatter and distance of each sample.
  void run(float* inscatter, float* ends) {
    sweep();
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      Ray& ray = rays_[i];
      const vec3 light = ray.source * (ray.sum + frame_.span(ray.begin, ray.end));
      for (int c = 0; c < 3; ++c)
        inscatter[4 * i + static_cast<std::size_t>(c)] = light[c];
      inscatter[4 * i + 3] = 1;
      ends[i] = static_cast<float>(ray.end);
    }
  }

private:
  struct Ray {
    double speed = 0; ///< texels along the row per unit of distance
    double slope = 0; ///< light depth per texel
    double end = 0, begin = 0;
    vec3 source{0}, sum{0};
  };

  Ray& at(int i) { return rays_[static_cast<std::size_t>(i)]; }

  /// Rays order_[0 .. count) are lit from the row position t on, the others dark.
  void setLit(int count, double t) {
    for (; lit_ < count; ++lit_) {
      Ray& ray = at(order_[static_cast<std::size_t>(lit_)]);
      ray.begin = std::min(t / ray.speed, ray.end);
    }
    for (; lit_ > count; --lit_) {
      Ray& ray = at(order_[static_cast<std::size_t>(lit_ - 1)]);
      ray.sum += frame_.span(ray.begin, std::min(t / ray.speed, ray.end));
    }
  }

  /// Leaves every ray lit, from where it last became so.
  void sweep() {
    const auto all = static_cast<int>(order_.size());
    lit_ = all;
    double low = 0, high = reach_;
    const dvec2 size(map_.width, map_.height);
    for (int axis = 0; axis < 2; ++axis) {
      if (std::abs(step_[axis]) < 1e-12) {
        if (eye_[axis] < 0 || eye_[axis] >= size[axis]) return;
        continue;
      }
      const double t0 = -eye_[axis] / step_[axis], t1 = (size[axis] - eye_[axis]) / step_[axis];
      low = std::max(low, std::min(t0, t1));
      high = std::min(high, std::max(t0, t1));
    }
    // Texel borders along the axis that the row moves faster on.
    const int axis = std::abs(step_.x) >= std::abs(step_.y) ? 0 : 1;
    for (double t = low; t < high;) {
      const double position = eye_[axis] + t * step_[axis];
      const double border = step_[axis] > 0 ? std::floor(position + 1e-9) + 1 : std::ceil(position - 1e-9) - 1;
      const double next = std::min(std::max((border - eye_[axis]) / step_[axis], t + 1e-6), high);
      const double middle = 0.5 * (t + next);
      const int x = std::clamp(static_cast<int>(eye_.x + middle * step_.x), 0, map_.width - 1);
      const int y = std::clamp(static_cast<int>(eye_.y + middle * step_.y), 0, map_.height - 1);
      const double depth = map_.depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(map_.width) + x];
      const double critical = (depth - eye_.z) / middle;
      int count = lit_;
      while (count < all && at(order_[static_cast<std::size_t>(count)]).slope <= critical)
        ++count;
      while (count > 0 && at(order_[static_cast<std::size_t>(count - 1)]).slope > critical)
        --count;
      if (count != lit_) setLit(count, std::max(t, 1e-9));
      t = next;
    }
    setLit(all, std::max(high, 1e-9));
  }

  const CpuFrame& frame_;
  const Map& map_;
  dvec3 eye_{0};
  dvec2 step_{0};
  double reach_ = 0;
  std::vector<Ray> rays_;
  std::vector<int> order_;
  int lit_ = 0;
};

class Incremental : public DrawnBaseline {
public:
  Incremental(int lines, int samples) : lines_(lines), samples_(samples) {}

  std::string reasonAgainst(const tyndall::Frame& frame) const override {
    const std::string reason = DrawnBaseline::reasonAgainst(frame);
    if (!reason.empty()) return reason;
    if (hasGlass(frame)) return "takes no glass";
    for (const tyndall::Light& light : frame.lights)
      if (light.boundary.enabled || !light.litOutsideViews)
        return "takes light that is lit outside, without a boundary";
    return reasonAgainstManyViews(frame);
  }

private:
  void draw(const tyndall::Frame& frame) override {
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
      drawer().selectLight(frame, frame.lights[i]);
      drawLight(frame, frame.lights[i], i);
    }
  }

  Map readMap(const tyndall::Frame& frame, const tyndall::Light& light) const {
    Map map;
    map.width = drawer().shadowSize().x;
    map.height = drawer().shadowSize().y;
    const tyndall::ShadowView& view = light.shadow.views.front();
    map.depth = light.shadow.array ? host::readDepthArray(light.shadow.texture, map.width, map.height, view.layer)
                                   : host::readDepth(light.shadow.texture, map.width, map.height);
    const bool reversed = isReversedMap(frame, light);
    for (float& depth : map.depth) {
      if (reversed) depth = -depth;
      if (depth >= (reversed ? 0.0F : 1.0F)) depth = 3e38F;
    }
    return map;
  }

  void drawLight(const tyndall::Frame& frame, const tyndall::Light& light, std::size_t i) {
    const std::string suffix = lightSuffix(i);
    std::optional<CpuFrame> cpu;
    Map map;
    drawer().pass("read back" + suffix, [&] {
      cpu.emplace(frame, light, drawer().shadowSize());
      map = readMap(frame, light);
    });
    const EpipolarLines geometry(frame, light, lines_, samples_);
    const auto count = static_cast<std::size_t>(lines_) * static_cast<std::size_t>(samples_);
    std::vector<float> inscatter(4 * count), ends(count);
    drawer().pass("integrate" + suffix, [&] {
      reference::parallelFor(lines_, [&](int line) {
        const auto at = static_cast<std::size_t>(line) * static_cast<std::size_t>(samples_);
        LineSweep(*cpu, map, geometry.ends[static_cast<std::size_t>(line)], samples_)
            .run(inscatter.data() + 4 * at, ends.data() + at);
      });
    });
    drawer().pass("unwarp" + suffix, [&] { unwarp(frame, light, i, geometry, inscatter, ends); });
  }

  /// The CPU's rows are lines; the shader's columns are.
  void unwarp(const tyndall::Frame& frame, const tyndall::Light& light, std::size_t i, const EpipolarLines& geometry,
              const std::vector<float>& inscatter, const std::vector<float>& ends) {
    const GLuint table = drawer().target("lines", GL_RGBA32F, lines_, 1);
    const GLuint endTexture = drawer().target("ends", GL_R32F, samples_, lines_);
    const GLuint lightTexture = drawer().target("inscatter", GL_RGBA16F, samples_, lines_);
    const auto upload = [&](GLuint texture, int width, int height, GLenum format, const void* data) {
      drawer().bind(kOwn, texture);
      host::gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, format, GL_FLOAT, data);
    };
    upload(table, lines_, 1, GL_RGBA, geometry.ends.data());
    upload(endTexture, samples_, lines_, GL_RED, ends.data());
    upload(lightTexture, samples_, lines_, GL_RGBA, inscatter.data());
    drawer().attachFinal(frame, i == 0);
    drawer().bind(kOwn, table);
    drawer().bind(kOwn + 1, endTexture);
    drawer().bind(kOwn + 2, lightTexture);
    Defines defines = drawer().definesFor(frame, &light);
    defines.emplace_back("LINES_ARE_ROWS 1");
    geometry.set(drawer().use("epipolarUnwarp.frag", defines, {"lines", "sampleEnds", "sampleInscatter"}));
    drawer().drawFullScreen();
  }

  int lines_, samples_;
};

} // namespace

std::unique_ptr<Baseline> makeIncremental(int slices, int samples) {
  return std::make_unique<Incremental>(slices, samples);
}

} // namespace bench
