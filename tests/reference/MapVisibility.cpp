#include "MapVisibility.h"

#include "CameraRays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

namespace reference {
namespace {

/// A quantity linear along the ray: a + b s.
struct Linear {
  double a = 0;
  double b = 0;
  double at(double s) const { return a + b * s; }
};

Linear operator+(Linear l, Linear r) { return {l.a + r.a, l.b + r.b}; }
Linear operator-(Linear l, Linear r) { return {l.a - r.a, l.b - r.b}; }
Linear operator*(double k, Linear l) { return {k * l.a, k * l.b}; }

/// A ray in a view's clip space: every clip coordinate is linear along it.
struct ClipRay {
  Linear x, y, z, w;
  ClipRay(const PreparedView& view, const Ray& ray) {
    const glm::dvec4 origin = view.clipFromWorld * glm::dvec4(ray.origin, 1);
    const glm::dvec4 slope = view.clipFromWorld * glm::dvec4(ray.direction, 0);
    x = {origin.x, slope.x};
    y = {origin.y, slope.y};
    z = {origin.z, slope.z};
    w = {origin.w, slope.w};
  }
};

/// The linear quantities that are >= 0 on the inner side of a view's planes, and whether a point is in the view.
struct ViewVolume {
  std::array<Linear, 5> sides; ///< w itself and the four side planes
  Linear nearPlane, farPlane;
  bool hasFarPlane;

  ViewVolume(const PreparedView& view, const Ray& ray, tyndall::ClipDepth clipDepth) : hasFarPlane(view.hasFarPlane) {
    const ClipRay clip(view, ray);
    sides = {clip.w, clip.w + clip.x, clip.w - clip.x, clip.w + clip.y, clip.w - clip.y};
    const Linear low = clip.z - ndcFromDepth(clipDepth, 0) * clip.w;
    const Linear high = clip.w - clip.z;
    nearPlane = view.reversed ? high : low;
    farPlane = view.reversed ? low : high;
  }
  bool insideSides(double s) const {
    return std::all_of(sides.begin(), sides.end(), [&](const Linear& side) { return side.at(s) > 0; });
  }
  bool contains(double s) const {
    return insideSides(s) && nearPlane.at(s) >= 0 && !(hasFarPlane && farPlane.at(s) < 0);
  }
  /// Of a point inside: its distance to the nearest side, as a share of the view's width, or to the far plane, of its
  /// depth; over the fade, at most 1.
  double weight(double s, double fade) const {
    double least = 1;
    for (std::size_t i = 1; i < sides.size(); ++i)
      least = std::min(least, sides[i].at(s) / (2 * sides[0].at(s)));
    if (hasFarPlane) least = std::min(least, farPlane.at(s) / (nearPlane.at(s) + farPlane.at(s)));
    return std::clamp(least / fade, 0.0, 1.0);
  }
};

/// Adds up radiance along the ray; neighbouring spans of equal light are integrated as one.
class LightSum {
public:
  explicit LightSum(const Airlight& airlight) : airlight_(airlight) {}
  void constant(double s0, double s1, const Rgb& light) {
    if (s1 <= s0) return;
    if (s0 != end_ || light != light_) {
      flush();
      begin_ = s0;
      light_ = light;
    }
    end_ = s1;
  }
  template <class Weight>
  void varying(double s0, double s1, const Weight& weight) {
    sum_ += airlight_.weighted(s0, s1, weight);
  }
  Rgb total() {
    flush();
    return sum_;
  }

private:
  void flush() {
    if (end_ > begin_ && light_ != Rgb(0)) sum_ += light_ * airlight_.span(begin_, end_);
    begin_ = end_ = -1;
  }
  const Airlight& airlight_;
  Rgb sum_{0};
  Rgb light_{0};
  double begin_ = -1;
  double end_ = -1;
};

/// Where the ray crosses lines of the texel grid in one axis, in order. The texel coordinate is grid / w, so it meets
/// line k where grid = k w, which is linear.
class GridCrossings {
public:
  GridCrossings(Linear grid, Linear w, double s0, double s1) : grid_(grid), w_(w), end_(s1) {
    const double first = grid.at(s0) / w.at(s0);
    const double last = grid.at(s1) / w.at(s1);
    step_ = last >= first ? 1 : -1;
    line_ = step_ > 0 ? std::floor(first) + 1 : std::ceil(first) - 1;
    left_ = static_cast<int>(std::max(0.0, std::ceil(std::abs(last - first)) + 1));
    find();
  }
  double next() const { return next_; }
  void advancePast(double s) {
    while (next_ <= s) {
      line_ += step_;
      --left_;
      find();
    }
  }

private:
  void find() {
    next_ = kInfinity;
    if (left_ <= 0) return;
    const Linear difference = grid_ - line_ * w_;
    const double s = -difference.a / difference.b;
    if (s < end_) next_ = s; // false for the NaN of a ray that runs along the line
  }
  Linear grid_, w_;
  double end_;
  double step_ = 1;
  double line_ = 0;
  int left_ = 0;
  double next_ = kInfinity;
};

/// A texel as the ray meets it.
struct Corner {
  Linear light; ///< >= 0 where the texel's caster does not block the light
  Linear glass; ///< < 0 where the glass tints
  bool hasCaster = false;
  bool hasGlass = false;
  Rgb tint{1};
  Rgb at(double s) const {
    if (hasCaster && !(light.at(s) >= 0)) return Rgb(0);
    return hasGlass && glass.at(s) < 0 ? tint : Rgb(1);
  }
};

/// The walk along a ray through one shadow view. Texel coordinates are u / w and v / w; with bilinear filtering they
/// are shifted by half a texel so that a cell lies between four texel centres.
class ViewWalk {
public:
  ViewWalk(const PreparedLight& light, const PreparedView& view, const Ray& ray)
      : light_(light), image_(*light.image), view_(view), clip_(view, ray),
        bilinear_(light.filter == tyndall::ShadowFilter::Bilinear) {
    u_ = (0.5 * image_.width) * (clip_.x + clip_.w);
    v_ = (0.5 * image_.height) * (clip_.y + clip_.w);
    if (bilinear_) {
      u_ = u_ - 0.5 * clip_.w;
      v_ = v_ - 0.5 * clip_.w;
    }
  }

  void run(double s0, double s1, LightSum& sum) const {
    GridCrossings columns(u_, clip_.w, s0, s1);
    GridCrossings rows(v_, clip_.w, s0, s1);
    double s = s0;
    while (s < s1) {
      const double next = std::min({columns.next(), rows.next(), s1});
      if (next > s) {
        if (bilinear_)
          bilinearCell(s, next, sum);
        else
          nearestCell(s, next, sum);
        s = next;
      }
      columns.advancePast(s);
      rows.advancePast(s);
    }
  }

private:
  Corner corner(int x, int y) const {
    x = std::clamp(x, 0, image_.width - 1);
    y = std::clamp(y, 0, image_.height - 1);
    const std::size_t texel = view_.offset + static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                              static_cast<std::size_t>(x);
    Corner result;
    if (!image_.depth.empty()) {
      const double depth = image_.depth[texel];
      result.hasCaster = view_.reversed ? depth > 0 : depth < 1; // none at or beyond the far value, nor one that is NaN
      result.light = depthMargin(depth);
    }
    if (light_.hasGlass) {
      const float* colour = &image_.glassColour[3 * texel];
      for (int c = 0; c < 3; ++c) // NaN counts as black
        result.tint[c] = colour[c] > 0 ? std::min(colour[c], 1.0F) : 0.0F;
      const double depth = image_.glassDepth[texel];
      result.hasGlass = result.tint != Rgb(1) && !std::isnan(depth);
      result.glass = depthMargin(depth);
    }
    return result;
  }

  /// Stored depth minus receiver depth, times w, positive where the receiver is nearer to the light. Infinite depth is
  /// far from all others.
  Linear depthMargin(double depth) const {
    constexpr double kFarFromAll = 1e30;
    depth = std::clamp(depth, -kFarFromAll, kFarFromAll);
    const Linear margin = ndcFromDepth(light_.clipDepth, depth) * clip_.w - clip_.z;
    return view_.reversed ? -1 * margin : margin;
  }

  /// Calls visit(a, b) for the stretches of [s0, s1] in which no corner changes.
  template <std::size_t N, class Visit>
  static void forEachStretch(const std::array<Corner, N>& corners, double s0, double s1, const Visit& visit) {
    std::array<double, 2 * N + 1> ends;
    std::size_t count = 0;
    const auto add = [&](const Linear& margin) {
      const double m0 = margin.at(s0), m1 = margin.at(s1);
      if ((m0 < 0) == (m1 < 0)) return;
      const double s = std::clamp(s0 + (s1 - s0) * (m0 / (m0 - m1)), s0, s1);
      std::size_t place = count++;
      for (; place > 0 && ends[place - 1] > s; --place)
        ends[place] = ends[place - 1];
      ends[place] = s;
    };
    for (const Corner& c : corners) {
      if (c.hasCaster) add(c.light);
      if (c.hasGlass) add(c.glass);
    }
    ends[count++] = s1;
    double a = s0;
    for (std::size_t i = 0; i < count; a = ends[i++])
      if (ends[i] > a) visit(a, ends[i]);
  }

  void nearestCell(double s0, double s1, LightSum& sum) const {
    const double middle = 0.5 * (s0 + s1);
    const double w = clip_.w.at(middle);
    const std::array<Corner, 1> corners = {
        corner(static_cast<int>(u_.at(middle) / w), static_cast<int>(v_.at(middle) / w))};
    forEachStretch(corners, s0, s1, [&](double a, double b) { sum.constant(a, b, corners[0].at(0.5 * (a + b))); });
  }

  void bilinearCell(double s0, double s1, LightSum& sum) const {
    const double middle = 0.5 * (s0 + s1);
    const double w = clip_.w.at(middle);
    const int x = static_cast<int>(std::floor(u_.at(middle) / w));
    const int y = static_cast<int>(std::floor(v_.at(middle) / w));
    const std::array<Corner, 4> corners = {corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)};
    forEachStretch(corners, s0, s1, [&](double a, double b) {
      std::array<Rgb, 4> values;
      for (std::size_t i = 0; i < 4; ++i)
        values[i] = corners[i].at(0.5 * (a + b));
      if (std::all_of(values.begin(), values.end(), [&](const Rgb& value) { return value == values[0]; })) {
        sum.constant(a, b, values[0]);
        return;
      }
      blend(values, x, y, a, b, sum);
    });
  }

  /// Bilinear weights along [a, b]. They are quadratic in texel coordinates, and those are rational in s: short steps
  /// in w keep them close to quadratic in s, too.
  void blend(const std::array<Rgb, 4>& values, int x, int y, double a, double b, LightSum& sum) const {
    const auto weight = [&](double s) {
      const double w = clip_.w.at(s);
      const double fx = u_.at(s) / w - x;
      const double fy = v_.at(s) / w - y;
      return (1 - fy) * ((1 - fx) * values[0] + fx * values[1]) + fy * ((1 - fx) * values[2] + fx * values[3]);
    };
    constexpr double kStepRatio = 1.25;
    const double w0 = clip_.w.at(a), ratio = clip_.w.at(b) / w0;
    const int steps = 1 + static_cast<int>(std::abs(std::log(ratio)) / std::log(kStepRatio));
    double begin = a;
    for (int i = 1; i <= steps; ++i) {
      const double end =
          i == steps ? b : (w0 * std::pow(ratio, static_cast<double>(i) / steps) - clip_.w.a) / clip_.w.b;
      sum.varying(begin, end, weight);
      begin = end;
    }
  }

  const PreparedLight& light_;
  const ShadowImage& image_;
  const PreparedView& view_;
  ClipRay clip_;
  bool bilinear_;
  Linear u_, v_;
};

/// Where [s0, s1] is cut: evenly, and by sixteenths of octaves towards both ends, next to one of which a thick medium
/// has all of its light.
std::vector<double> piecesOf(double s0, double s1) {
  constexpr int kPieces = 128, kOctaves = 20, kOfOctave = 16;
  std::vector<double> ends;
  for (int i = 0; i <= kPieces; ++i)
    ends.push_back(i == kPieces ? s1 : s0 + (s1 - s0) * i / kPieces);
  for (int i = 1; i <= kOctaves * kOfOctave; ++i) {
    const double share = std::exp2(-static_cast<double>(i) / kOfOctave) / kPieces;
    ends.push_back(s0 + (s1 - s0) * share);
    ends.push_back(s1 - (s1 - s0) * share);
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

/// Two views' light of [s0, s1], in so many pieces that the weight of the first is even in each.
Rgb fadedLight(const Airlight& airlight, const ViewWalk& first, const ViewWalk& second, double s0, double s1,
               const std::function<double(double)>& weightAt) {
  const std::vector<double> ends = piecesOf(s0, s1);
  Rgb light(0);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double a = ends[i], b = ends[i + 1];
    if (b <= a) continue;
    const double weight = weightAt(0.5 * (a + b));
    LightSum one(airlight), other(airlight);
    if (weight > 0) first.run(a, b, one);
    if (weight < 1) second.run(a, b, other);
    light += weight * one.total() + (1 - weight) * other.total();
  }
  return light;
}

/// Whether depth falls along the light's travel at the centre of the view.
bool depthFallsWithDistance(const tyndall::Light& light, const glm::dmat4& clipFromWorld) {
  const double middle = ndcFromDepth(light.shadow.clipDepth, 0.5);
  glm::dvec4 centre = glm::inverse(clipFromWorld) * glm::dvec4(0, 0, middle, 1);
  centre /= centre.w;
  const bool directional = light.kind == tyndall::LightKind::Directional;
  const glm::dvec3 travel = directional ? toVec3(light.direction) : glm::dvec3(centre) - toVec3(light.position);
  const glm::dvec4 clip = clipFromWorld * centre;
  const glm::dvec4 slope = clipFromWorld * glm::dvec4(travel, 0);
  return slope.z * clip.w - clip.z * slope.w < 0;
}

} // namespace

PreparedLight prepareLight(const tyndall::Light& light, const ShadowImage& image, tyndall::ShadowFilter filter) {
  PreparedLight result;
  result.image = &image;
  result.filter = filter;
  result.clipDepth = light.shadow.clipDepth;
  result.litOutsideViews = light.litOutsideViews;
  result.fade = light.cascadeFade;
  result.hasGlass = !image.glassColour.empty();
  if (image.width == 0) return result;
  const auto texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const bool directional = light.kind == tyndall::LightKind::Directional;
  for (std::size_t i = 0; i < light.shadow.views.size(); ++i) {
    const tyndall::ShadowView& view = light.shadow.views[i];
    const glm::dmat4 clipFromWorld = toMat4(view.clipFromWorld);
    result.views.push_back({clipFromWorld, depthFallsWithDistance(light, clipFromWorld),
                            directional && i + 1 < light.shadow.views.size(),
                            static_cast<std::size_t>(view.layer) * texels});
  }
  return result;
}

Rgb shadowedInscatter(const PreparedLight& light, const Airlight& airlight, const Ray& ray, double s0, double s1) {
  const Interval reach = {std::max(s0, airlight.support().begin), std::min(s1, airlight.support().end)};
  if (light.views.empty()) return airlight.span(reach.begin, reach.end);
  std::vector<ViewVolume> volumes;
  std::vector<double> ends = {reach.begin, reach.end};
  for (const PreparedView& view : light.views) {
    const ViewVolume& volume = volumes.emplace_back(view, ray, light.clipDepth);
    const auto add = [&](const Linear& plane) {
      const double s = -plane.a / plane.b;
      if (s > reach.begin && s < reach.end) ends.push_back(s);
    };
    std::for_each(volume.sides.begin(), volume.sides.end(), add);
    add(volume.nearPlane);
    if (volume.hasFarPlane) add(volume.farPlane);
  }
  std::sort(ends.begin(), ends.end());
  LightSum sum(airlight);
  Rgb faded(0);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double a = ends[i], b = ends[i + 1], middle = 0.5 * (a + b);
    if (b <= a) continue;
    const auto owner =
        std::find_if(volumes.begin(), volumes.end(), [&](const ViewVolume& v) { return v.contains(middle); });
    if (owner != volumes.end()) {
      const auto next = std::find_if(owner + 1, volumes.end(), [&](const ViewVolume& v) { return v.contains(middle); });
      const auto walkOf = [&](const std::vector<ViewVolume>::iterator& volume) {
        return ViewWalk(light, light.views[static_cast<std::size_t>(volume - volumes.begin())], ray);
      };
      if (light.fade > 0 && next != volumes.end())
        faded += fadedLight(airlight, walkOf(owner), walkOf(next), a, b,
                            [&](double s) { return owner->weight(s, light.fade); });
      else
        walkOf(owner).run(a, b, sum);
      continue;
    }
    const bool lit = light.litOutsideViews || std::any_of(volumes.begin(), volumes.end(), [&](const ViewVolume& v) {
                       return v.insideSides(middle) && v.nearPlane.at(middle) < 0;
                     });
    sum.constant(a, b, Rgb(lit ? 1 : 0));
  }
  return sum.total() + faded;
}

} // namespace reference
