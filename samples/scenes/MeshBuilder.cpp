#include "MeshBuilder.h"

#include "Noise.h"
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace scenes {
namespace {

constexpr double kTwoPi = glm::two_pi<double>();
/// Squared lengths below this, in square metres, have no direction.
constexpr double kTiny = 1e-18;

glm::dvec3 directionOr(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double squared = glm::dot(v, v);
  return squared > kTiny ? v / std::sqrt(squared) : fallback;
}

/// Twice the area of a polygon, as a vector along its normal (Newell).
glm::dvec3 areaVector(const std::vector<glm::dvec3>& corners) {
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  return sum;
}

/// The direction of a path at one of its points.
glm::dvec3 tangentAt(const std::vector<glm::dvec3>& path, std::size_t i) {
  const glm::dvec3& before = path[i == 0 ? 0 : i - 1];
  const glm::dvec3& after = path[i + 1 == path.size() ? i : i + 1];
  return directionOr(after - before, {0, 1, 0});
}

glm::dvec3 anyAcross(const glm::dvec3& v) {
  return glm::normalize(glm::cross(v, std::abs(v.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
}

} // namespace

MeshBuilder& MeshBuilder::material(int index) {
  material_ = index;
  return *this;
}

MeshBuilder& MeshBuilder::frame(const glm::dmat4& worldFromLocal) {
  worldFromLocal_ = worldFromLocal;
  worldFromLocalNormal_ = glm::transpose(glm::inverse(glm::dmat3(worldFromLocal)));
  mirrored_ = glm::determinant(glm::dmat3(worldFromLocal)) < 0;
  return *this;
}

std::uint32_t MeshBuilder::vertex(const glm::dvec3& position, const glm::dvec3& normal) {
  Surface& surface = surfaces_[static_cast<std::size_t>(material_)];
  const glm::dvec3 world(worldFromLocal_ * glm::dvec4(position, 1));
  surface.positions.push_back(glm::round(world / grid_) * grid_);
  surface.normals.push_back(directionOr(worldFromLocalNormal_ * normal, {0, 1, 0}));
  return static_cast<std::uint32_t>(surface.positions.size()) - 1;
}

std::uint32_t MeshBuilder::vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& colour) {
  surfaces_[static_cast<std::size_t>(material_)].colours.push_back(colour);
  return vertex(position, normal);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  Surface& surface = surfaces_[static_cast<std::size_t>(material_)];
  const auto& p = surface.positions;
  const glm::dvec3 across = glm::cross(p[b] - p[a], p[c] - p[a]);
  if (glm::dot(across, across) <= 0) return;
  if (mirrored_) std::swap(b, c);
  surface.indices.insert(surface.indices.end(), {a, b, c});
}

void MeshBuilder::polygon(const std::vector<glm::dvec3>& corners) {
  const glm::dvec3 area = areaVector(corners);
  if (glm::dot(area, area) <= kTiny) return;
  std::vector<std::uint32_t> at;
  at.reserve(corners.size());
  for (const glm::dvec3& corner : corners)
    at.push_back(vertex(corner, area));
  for (std::size_t i = 1; i + 1 < at.size(); ++i)
    triangle(at[0], at[i], at[i + 1]);
}

void MeshBuilder::quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  polygon({a, b, c, d});
}

void MeshBuilder::box(const glm::dvec3& l, const glm::dvec3& h) {
  prism({{l.x, l.y}, {h.x, l.y}, {h.x, h.y}, {l.x, h.y}}, l.z, h.z);
}

void MeshBuilder::prism(const std::vector<glm::dvec2>& outline, double low, double high) {
  std::vector<glm::dvec3> front;
  std::vector<glm::dvec3> back;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i];
    const glm::dvec2 b = outline[(i + 1) % outline.size()];
    front.emplace_back(a, high);
    back.emplace_back(outline[outline.size() - 1 - i], low);
    quad({a, low}, {b, low}, {b, high}, {a, high});
  }
  polygon(front);
  polygon(back);
}

void MeshBuilder::sheet(int columns, int rows, const std::function<glm::dvec3(double, double)>& point) {
  const auto width = static_cast<std::size_t>(columns) + 1;
  const auto height = static_cast<std::size_t>(rows) + 1;
  std::vector<glm::dvec3> points(width * height);
  std::vector<glm::dvec3> normals(width * height, glm::dvec3(0));
  for (std::size_t j = 0; j < height; ++j)
    for (std::size_t i = 0; i < width; ++i)
      points[j * width + i] = point(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
  for (std::size_t j = 0; j + 1 < height; ++j)
    for (std::size_t i = 0; i + 1 < width; ++i) {
      const std::size_t a = j * width + i;
      const glm::dvec3 n = glm::cross(points[a + width + 1] - points[a], points[a + width] - points[a + 1]);
      for (const std::size_t corner : {a, a + 1, a + width, a + width + 1})
        normals[corner] += n;
    }
  const auto first = vertex(points[0], normals[0]);
  for (std::size_t k = 1; k < points.size(); ++k)
    vertex(points[k], normals[k]);
  for (std::size_t j = 0; j + 1 < height; ++j)
    for (std::size_t i = 0; i + 1 < width; ++i) {
      const auto a = static_cast<std::uint32_t>(first + j * width + i);
      const auto c = static_cast<std::uint32_t>(a + width);
      triangle(a, a + 1, c + 1);
      triangle(a, c + 1, c);
    }
}

void MeshBuilder::lathe(const std::vector<glm::dvec2>& profile, int sides) {
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const glm::dvec2 low = profile[i];
    const glm::dvec2 high = profile[i + 1];
    const glm::dvec2 out = glm::dvec2(high.y - low.y, low.x - high.x);
    std::vector<std::uint32_t> at;
    for (int k = 0; k <= sides; ++k) {
      const double angle = kTwoPi * (k % sides) / sides;
      const double c = std::cos(angle);
      const double s = -std::sin(angle);
      const glm::dvec3 normal(out.x * c, out.y, out.x * s);
      at.push_back(vertex({low.x * c, low.y, low.x * s}, normal));
      at.push_back(vertex({high.x * c, high.y, high.x * s}, normal));
    }
    for (std::size_t k = 0; k + 3 < at.size(); k += 2) {
      triangle(at[k], at[k + 2], at[k + 3]);
      triangle(at[k], at[k + 3], at[k + 1]);
    }
  }
}

void MeshBuilder::tube(const std::vector<glm::dvec3>& path, double radius, int sides) {
  tube(path, std::vector<double>(path.size(), radius), sides);
}

void MeshBuilder::tube(const std::vector<glm::dvec3>& path, const std::vector<double>& radii, int sides) {
  std::vector<std::vector<std::uint32_t>> rings;
  std::vector<glm::dvec3> caps[2];
  glm::dvec3 side = anyAcross(tangentAt(path, 0));
  for (std::size_t i = 0; i < path.size(); ++i) {
    const glm::dvec3 along = tangentAt(path, i);
    side = directionOr(side - along * glm::dot(side, along), anyAcross(along));
    const glm::dvec3 other = glm::cross(along, side);
    rings.emplace_back();
    for (int k = 0; k <= sides; ++k) {
      const double angle = kTwoPi * (k % sides) / sides;
      const glm::dvec3 out = side * std::cos(angle) + other * std::sin(angle);
      rings.back().push_back(vertex(path[i] + out * radii[i], out));
      if (k < sides && i == 0) caps[0].insert(caps[0].begin(), path[i] + out * radii[i]);
      if (k < sides && i + 1 == path.size()) caps[1].push_back(path[i] + out * radii[i]);
    }
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    for (std::size_t k = 0; k + 1 < rings[i].size(); ++k) {
      triangle(rings[i][k], rings[i][k + 1], rings[i + 1][k + 1]);
      triangle(rings[i][k], rings[i + 1][k + 1], rings[i + 1][k]);
    }
  for (const auto& cap : caps)
    polygon(cap);
}

void MeshBuilder::bar(const std::vector<glm::dvec3>& path, const glm::dvec3& axis, double width, double depth,
                      bool closed) {
  const std::size_t count = path.size();
  if (count < 2) return;
  const glm::dvec3 normal = glm::normalize(axis);
  std::vector<std::vector<glm::dvec3>> sections;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3& before = path[i > 0 ? i - 1 : (closed ? count - 1 : 0)];
    const glm::dvec3& after = path[i + 1 < count ? i + 1 : (closed ? 0 : i)];
    const glm::dvec3 in = directionOr(path[i] - before, directionOr(after - path[i], {1, 0, 0}));
    const glm::dvec3 out = directionOr(after - path[i], in);
    const glm::dvec3 along = directionOr(in + out, in);
    const glm::dvec3 side = glm::normalize(glm::cross(normal, along));
    const double mitre = std::max(0.5, glm::dot(along, in));
    const glm::dvec3 w = side * (0.5 * width / mitre);
    const glm::dvec3 d = normal * (0.5 * depth);
    sections.push_back({path[i] - w - d, path[i] + w - d, path[i] + w + d, path[i] - w + d});
  }
  const std::size_t segments = closed ? count : count - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const auto& a = sections[i];
    const auto& b = sections[(i + 1) % count];
    for (std::size_t k = 0; k < 4; ++k)
      quad(a[k], a[(k + 1) % 4], b[(k + 1) % 4], b[k]);
  }
  if (closed) return;
  const auto& first = sections.front();
  polygon({first[3], first[2], first[1], first[0]});
  polygon(sections.back());
}

void MeshBuilder::torus(const glm::dvec3& centre, double radius, double thickness, int sides, int sections) {
  std::vector<std::vector<std::uint32_t>> rings;
  for (int i = 0; i <= sections; ++i) {
    const double turn = kTwoPi * (i % sections) / sections;
    const glm::dvec3 outward(std::cos(turn), 0, -std::sin(turn));
    rings.emplace_back();
    for (int k = 0; k <= sides; ++k) {
      const double angle = kTwoPi * (k % sides) / sides;
      const glm::dvec3 normal = outward * std::cos(angle) + glm::dvec3(0, std::sin(angle), 0);
      rings.back().push_back(vertex(centre + outward * radius + normal * thickness, normal));
    }
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    for (std::size_t k = 0; k + 1 < rings[i].size(); ++k) {
      triangle(rings[i][k], rings[i + 1][k], rings[i + 1][k + 1]);
      triangle(rings[i][k], rings[i + 1][k + 1], rings[i][k + 1]);
    }
}

void MeshBuilder::sphere(const glm::dvec3& centre, double radius, int sides) {
  boulder(centre, glm::dvec3(radius), 0, 0, sides);
}

void MeshBuilder::boulder(const glm::dvec3& centre, const glm::dvec3& radii, double roughness, double seed, int sides) {
  sheet(sides, sides / 2, [&](double u, double v) {
    const double turn = u < 1 ? kTwoPi * u : 0;
    const double tilt = glm::pi<double>() * v;
    const double ring = v > 0 && v < 1 ? std::sin(tilt) : 0;
    const glm::dvec3 out(ring * std::cos(turn), -std::cos(tilt), -ring * std::sin(turn));
    const double dent = roughness > 0 ? roughness * (noise(out * 1.3 + seed) + 0.4 * noise(out * 3.1 - seed)) : 0;
    return centre + out * radii * (1 + dent);
  });
}

std::size_t triangleCount(const Scene& scene) {
  std::size_t count = 0;
  const auto add = [&](const std::vector<Surface>& surfaces) {
    for (const Surface& surface : surfaces)
      count += surface.indices.size() / 3;
  };
  add(scene.surfaces);
  for (const Body& body : scene.bodies)
    add(body.surfaces);
  return count;
}

glm::dmat4 frameAt(const glm::dvec3& origin, const glm::dvec3& up, const glm::dvec3& front) {
  const glm::dvec3 y = glm::normalize(up);
  const glm::dvec3 x = glm::normalize(glm::cross(y, front));
  return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(glm::cross(x, y), 0), glm::dvec4(origin, 1)};
}

} // namespace scenes
