#include "Architecture.h"

#include "Random.h"
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace scenes {
namespace {

/// The blocks stand this far before the wall's plain face, which closes the seams between them, metres.
constexpr double kBlockDepth = 0.006;

std::vector<Outline> piecesAround(const Panel& p, const Opening& hole) {
  const std::size_t last = hole.x.size() - 1;
  std::vector<Outline> pieces;
  pieces.push_back({{p.left, p.bottom},
                    {hole.x[0], p.bottom},
                    {hole.x[0], hole.low[0]},
                    {hole.x[0], hole.high[0]},
                    {hole.x[0], p.top},
                    {p.left, p.top}});
  pieces.push_back({{p.right, p.bottom},
                    {p.right, p.top},
                    {hole.x[last], p.top},
                    {hole.x[last], hole.high[last]},
                    {hole.x[last], hole.low[last]},
                    {hole.x[last], p.bottom}});
  for (std::size_t i = 0; i < last; ++i) {
    pieces.push_back(
        {{hole.x[i], p.bottom}, {hole.x[i + 1], p.bottom}, {hole.x[i + 1], hole.low[i + 1]}, {hole.x[i], hole.low[i]}});
    pieces.push_back(
        {{hole.x[i], hole.high[i]}, {hole.x[i + 1], hole.high[i + 1]}, {hole.x[i + 1], p.top}, {hole.x[i], p.top}});
  }
  return pieces;
}

void face(MeshBuilder& mesh, const std::vector<Outline>& pieces, double z, bool front) {
  for (const Outline& piece : pieces) {
    std::vector<glm::dvec3> corners = atDepth(piece, z);
    // The first corner stays first: the fan from it has no triangle along a straight side.
    if (!front) std::reverse(corners.begin() + 1, corners.end());
    mesh.polygon(corners);
  }
}

void blocks(MeshBuilder& mesh, const Masonry& stone, const Outline& piece, double z, int seed) {
  glm::dvec2 low = piece[0];
  glm::dvec2 high = piece[0];
  for (const glm::dvec2& p : piece) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const auto first = static_cast<int>(std::floor(low.y / stone.height));
  const auto last = static_cast<int>(std::ceil(high.y / stone.height));
  for (int row = first; row < last; ++row) {
    const Outline course = clip(clip(piece, {0, 1}, (row + 1) * stone.height), {0, -1}, -row * stone.height);
    const double shift = (hashOf(row, seed, 7) + 0.5 * (row & 1)) * stone.length;
    const auto from = static_cast<int>(std::floor((low.x - shift) / stone.length));
    const auto to = static_cast<int>(std::ceil((high.x - shift) / stone.length));
    for (int block = from; block < to; ++block) {
      const double x = shift + block * stone.length;
      const Outline cut = clip(clip(course, {1, 0}, x + stone.length), {-1, 0}, -x);
      if (cut.size() < 3) continue;
      mesh.material(stone.pick(block, row, seed)).polygon(atDepth(cut, z));
    }
  }
}

void reveals(MeshBuilder& mesh, const Opening& f, double zf, const Opening& b, double zb) {
  const std::size_t last = f.x.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const std::size_t j = i + 1;
    mesh.quad({f.x[i], f.low[i], zf}, {f.x[j], f.low[j], zf}, {b.x[j], b.low[j], zb}, {b.x[i], b.low[i], zb});
    mesh.quad({f.x[j], f.high[j], zf}, {f.x[i], f.high[i], zf}, {b.x[i], b.high[i], zb}, {b.x[j], b.high[j], zb});
  }
  mesh.quad({f.x[0], f.high[0], zf}, {f.x[0], f.low[0], zf}, {b.x[0], b.low[0], zb}, {b.x[0], b.high[0], zb});
  mesh.quad({f.x[last], f.low[last], zf}, {f.x[last], f.high[last], zf}, {b.x[last], b.high[last], zb},
            {b.x[last], b.low[last], zb});
}

} // namespace

Outline clip(const Outline& polygon, const glm::dvec2& normal, double offset) {
  Outline kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2& a = polygon[i];
    const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(a, normal) - offset;
    const double db = glm::dot(b, normal) - offset;
    if (da <= 0) kept.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

double pointedArch(double u, double ratio) {
  const double radius = 0.5 * (1 + ratio * ratio);
  const double x = std::min(std::abs(u), 1.0) + radius - 1;
  return std::sqrt(std::max(0.0, radius * radius - x * x)) / ratio;
}

Outline archCurve(double centre, double halfSpan, double spring, double rise, int segments) {
  const double radius = (halfSpan * halfSpan + rise * rise) / (2 * halfSpan);
  const double opposite = halfSpan - radius;
  const double crown = std::acos(-opposite / radius);
  Outline right;
  for (int i = 0; i < segments; ++i) {
    const double angle = crown * i / segments;
    right.emplace_back(opposite + radius * std::cos(angle), spring + radius * std::sin(angle));
  }
  Outline curve;
  for (const glm::dvec2& p : right)
    curve.emplace_back(centre - p.x, p.y);
  curve.emplace_back(centre, spring + rise);
  for (auto p = right.rbegin(); p != right.rend(); ++p)
    curve.emplace_back(centre + p->x, p->y);
  return curve;
}

Outline circleCurve(const glm::dvec2& centre, double radius, int segments) {
  Outline curve;
  for (int i = 0; i < segments; ++i) {
    const double angle = glm::two_pi<double>() * i / segments;
    curve.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return curve;
}

std::vector<glm::dvec3> atDepth(const Outline& curve, double z) {
  std::vector<glm::dvec3> points;
  points.reserve(curve.size());
  for (const glm::dvec2& p : curve)
    points.emplace_back(p, z);
  return points;
}

Outline Opening::outline() const {
  Outline points;
  const bool flat = low.front() == low[low.size() / 2];
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!flat || i == 0 || i + 1 == x.size()) points.emplace_back(x[i], low[i]);
  for (std::size_t i = x.size(); i-- > 0;)
    if (high[i] > low[i]) points.emplace_back(x[i], high[i]);
  return points;
}

Opening lancet(double centre, double halfSpan, double sill, double spring, double rise, int segments) {
  Opening opening;
  for (const glm::dvec2& p : archCurve(centre, halfSpan, spring, rise, segments)) {
    opening.x.push_back(p.x);
    opening.low.push_back(sill);
    opening.high.push_back(p.y);
  }
  return opening;
}

Opening roundOpening(const glm::dvec2& centre, double radius, int segments) {
  Opening opening;
  for (int i = 0; i <= segments / 2; ++i) {
    const double angle = glm::pi<double>() * (1 - 2.0 * i / segments);
    const double half = i == 0 || 2 * i == segments ? 0 : radius * std::sin(angle);
    opening.x.push_back(centre.x + radius * std::cos(angle));
    opening.low.push_back(centre.y - half);
    opening.high.push_back(centre.y + half);
  }
  return opening;
}

Opening between(const Opening& a, const Opening& b, double weight) {
  Opening mixed = a;
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    mixed.x[i] += weight * (b.x[i] - a.x[i]);
    mixed.low[i] += weight * (b.low[i] - a.low[i]);
    mixed.high[i] += weight * (b.high[i] - a.high[i]);
  }
  return mixed;
}

int Masonry::pick(int column, int row, int seed) const {
  return tones[static_cast<std::size_t>(hashOf(column, row, seed) * static_cast<double>(tones.size()))];
}

void wall(MeshBuilder& mesh, const Masonry& stone, const Panel& panel, const Opening& front, const Opening& back,
          int seed) {
  const std::vector<Outline> pieces = piecesAround(panel, front);
  mesh.material(stone.tones[0]);
  face(mesh, pieces, panel.front, true);
  face(mesh, piecesAround(panel, back), panel.back, false);
  reveals(mesh, front, panel.front, back, panel.back);
  for (const Outline& piece : pieces)
    blocks(mesh, stone, piece, panel.front + kBlockDepth, seed);
}

void wall(MeshBuilder& mesh, const Masonry& stone, const Panel& p, int seed) {
  mesh.material(stone.tones[0]).box({p.left, p.bottom, p.back}, {p.right, p.top, p.front});
  blocks(mesh, stone, {{p.left, p.bottom}, {p.right, p.bottom}, {p.right, p.top}, {p.left, p.top}},
         p.front + kBlockDepth, seed);
}

void vault(MeshBuilder& mesh, const Masonry& stone, int ribs, const Vault& v, int seed) {
  constexpr int kCourses = 20;
  constexpr double kRatio = 1.2;
  const auto height = [&](double u) { return v.spring + v.rise * pointedArch(u, kRatio); };
  for (int web = 0; web < 4; ++web)
    for (int i = 0; i < kCourses; ++i) {
      const double a = 2.0 * i / kCourses - 1;
      const double b = 2.0 * (i + 1) / kCourses - 1;
      const double sign = web % 2 == 0 ? 1 : -1;
      const auto at = [&](double along, double across) {
        return web < 2 ? glm::dvec3(sign * across * v.halfX, height(along), along * v.halfZ)
                       : glm::dvec3(along * v.halfX, height(along), sign * across * v.halfZ);
      };
      std::vector<glm::dvec3> course{at(a, std::abs(a)), at(a, 1), at(b, 1), at(b, std::abs(b))};
      if (glm::cross(course[2] - course[0], course[3] - course[1]).y > 0) std::reverse(course.begin(), course.end());
      mesh.material(stone.pick(i, web, seed)).polygon(course);
    }
  mesh.material(ribs);
  for (const double sign : {-1.0, 1.0}) {
    std::vector<glm::dvec3> path;
    for (int i = 0; i <= kCourses; ++i) {
      const double u = 2.0 * i / kCourses - 1;
      path.emplace_back(u * v.halfX, height(u) - 0.3 * v.rib, sign * u * v.halfZ);
    }
    mesh.bar(path, {-sign * v.halfZ, 0, v.halfX}, v.rib, v.rib);
  }
  mesh.lathe({{0, height(0) - 1.3 * v.rib}, {1.2 * v.rib, height(0) - 0.9 * v.rib}, {1.2 * v.rib, height(0)}}, 12);
}

void transverseArch(MeshBuilder& mesh, const Vault& v, double width, double depth) {
  std::vector<glm::dvec3> path;
  for (int i = 0; i <= 24; ++i) {
    const double u = i / 12.0 - 1;
    path.emplace_back(u * v.halfX, v.spring + v.rise * pointedArch(u, 1.2) - 0.3 * width, 0);
  }
  mesh.bar(path, {0, 0, 1}, width, depth);
}

void column(MeshBuilder& mesh, const Masonry& stone, double radius, double top, int sides, int seed) {
  const double r = radius;
  const double abacus = top - 0.18;
  const double neck = abacus - 0.55;
  mesh.material(stone.tones[0]);
  mesh.box({-1.5 * r, 0, -1.5 * r}, {1.5 * r, 0.22, 1.5 * r});
  mesh.lathe({{1.42 * r, 0.2},
              {1.48 * r, 0.27},
              {1.48 * r, 0.33},
              {1.4 * r, 0.4},
              {1.2 * r, 0.42},
              {1.15 * r, 0.48},
              {1.2 * r, 0.54},
              {1.25 * r, 0.58},
              {1.2 * r, 0.63},
              {r, 0.66}},
             sides);
  const int drums = std::max(1, static_cast<int>(std::lround((neck - 0.6) / 0.62)));
  for (int i = 0; i < drums; ++i) {
    const double low = 0.6 + (neck - 0.6) * i / drums;
    const double high = 0.6 + (neck - 0.6) * (i + 1) / drums;
    mesh.material(stone.pick(i, 0, seed)).lathe({{r, low}, {r, high}}, sides);
  }
  mesh.material(stone.tones.back());
  mesh.lathe({{r, neck - 0.06},
              {1.12 * r, neck - 0.04},
              {1.14 * r, neck},
              {1.1 * r, neck + 0.04},
              {1.0 * r, neck + 0.06},
              {1.06 * r, neck + 0.2},
              {1.2 * r, neck + 0.36},
              {1.42 * r, neck + 0.5},
              {1.42 * r, abacus + 0.02}},
             sides);
  for (int i = 0; i < 8; ++i) {
    const double angle = glm::two_pi<double>() * (i + 0.5) / 8;
    const glm::dvec3 out(std::cos(angle), 0, std::sin(angle));
    mesh.tube({out * (1.02 * r) + glm::dvec3(0, neck + 0.05, 0), out * (1.12 * r) + glm::dvec3(0, neck + 0.25, 0),
               out * (1.36 * r) + glm::dvec3(0, neck + 0.40, 0), out * (1.62 * r) + glm::dvec3(0, neck + 0.42, 0)},
              {0.10 * r, 0.12 * r, 0.10 * r, 0.04 * r}, 6);
  }
  mesh.box({-1.45 * r, abacus, -1.45 * r}, {1.45 * r, top, 1.45 * r});
}

} // namespace scenes
