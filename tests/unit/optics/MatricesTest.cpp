// What matrices tell about themselves (optics/Matrices.h).
#include "optics/Matrices.h"

#include "OpticsCases.h"
#include "support/Catch.h"

#include <cmath>
#include <limits>

using namespace tests;
using glm::dmat4;
using glm::dvec3;
using glm::dvec4;
using tyndall::ClipDepth;
using tyndall::optics::depthFromClip;
using tyndall::optics::DepthPlane;
using tyndall::optics::eyeOf;
using tyndall::optics::isInvertible;
using tyndall::optics::isOrthographic;
using tyndall::optics::isReversed;
using tyndall::optics::linearDepth;
using tyndall::optics::toGlm;

namespace {

const dvec3 kEye(3, -2, 7), kDirection(0.4, -0.2, -1);

dmat4 diagonal(const dvec4& d) {
  dmat4 m(0);
  for (int i = 0; i < 4; ++i)
    m[i][i] = d[i];
  return m;
}

dmat4 randomMatrix(Random& random) {
  dmat4 m;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      m[c][r] = random.within(-1, 1);
  return m;
}

dmat4 clipOf(const Projection& p, const dvec3& eye) {
  return depthFromClip(p.convention.clipDepth) * p.clipFromView * host::viewLooking(eye, kDirection);
}

} // namespace

TEST_CASE("a matrix of the header is column-major") {
  tyndall::Mat4 m{};
  m[4 * 3 + 1] = 5; // row 1, column 3
  CHECK((toGlm(m) * dvec4(0, 0, 0, 1)).y == 5);
}

TEST_CASE("depth runs from 0 to 1 over either clip depth, and x, y, w stay") {
  for (const double z : {0.0, 1.0})
    CHECK((depthFromClip(ClipDepth::ZeroToOne) * dvec4(2, 3, z, 1)) == dvec4(2, 3, z, 1));
  CHECK((depthFromClip(ClipDepth::NegativeOneToOne) * dvec4(2, 3, -4, 4)) == dvec4(2, 3, 0, 4));
  CHECK((depthFromClip(ClipDepth::NegativeOneToOne) * dvec4(2, 3, 4, 4)) == dvec4(2, 3, 4, 4));
}

TEST_CASE("a matrix can be inverted whatever the units of its rows and columns") {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const dmat4 m = randomMatrix(random);
    if (std::abs(glm::determinant(m)) < 1e-3) continue;
    dvec4 rows, columns;
    for (int k = 0; k < 4; ++k) {
      rows[k] = std::pow(10.0, random.within(-60, 60));
      columns[k] = std::pow(10.0, random.within(-60, 60));
    }
    CHECK(isInvertible(diagonal(rows) * m * diagonal(columns)));
  }
  dmat4 nearlySingular(1);
  nearlySingular[0] = dvec4(1, 1, 0, 0);
  nearlySingular[1] = dvec4(1, 1 + 1e-8, 0, 0);
  CHECK(isInvertible(nearlySingular));
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Projection& p : projections(scale)) {
      CAPTURE(p.name, scale);
      CHECK(isInvertible(p.clipFromView));
      CHECK(isInvertible(clipOf(p, scale * kEye)));
    }
}

TEST_CASE("a matrix of rank three, of zeros or of what is not finite cannot be inverted") {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    dmat4 m = randomMatrix(random);
    m[3] = random.within(-1, 1) * m[0] + random.within(-1, 1) * m[1] + random.within(-1, 1) * m[2];
    CHECK_FALSE(isInvertible(m));
    CHECK_FALSE(isInvertible(glm::transpose(m)));
    CHECK_FALSE(isInvertible(diagonal({1e-30, 1, 1e30, 1e9}) * m));
  }
  CHECK_FALSE(isInvertible(dmat4(0)));
  CHECK_FALSE(isInvertible(diagonal({1, 1, 0, 1})));
  for (const double broken : {std::nan(""), tyndall::kInfinity, -tyndall::kInfinity})
    for (int at = 0; at < 16; ++at) {
      dmat4 m(1);
      m[at / 4][at % 4] = broken;
      CHECK_FALSE(isInvertible(m));
    }
}

TEST_CASE("the eye of a camera is where it was put, at every scale and in every convention") {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Projection& p : projections(scale)) {
      CAPTURE(p.name, scale);
      const dmat4 clip = clipOf(p, scale * kEye);
      CHECK(isOrthographic(clip) == p.orthographic);
      const dvec3 forward = glm::normalize(kDirection);
      const dvec3 expected =
          scale * kEye + (p.orthographic ? 0.5 * (p.nearPlane + p.farPlane) : 0.0) * forward; // centre of the volume
      CHECK(glm::distance(eyeOf(clip), expected) < 1e-9 * scale * 30);
      CHECK(isReversed(clip, forward) == p.convention.reversed);
      CHECK(isReversed(clip, -forward) != p.convention.reversed);
    }
}

// All conventions, and a sun, a spot and the faces of a lamp.
TEST_CASE("linear depth is 0 at the near plane, 1 at the far one and even between them") {
  Random random(5);
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Projection& p : projections(scale)) {
      CAPTURE(p.name, scale);
      tyndall::Light light = p.orthographic ? sun(kDirection) : spot(scale * kEye, kDirection, 0.5);
      const dmat4 viewFromWorld = host::viewLooking(scale * kEye, kDirection);
      light.shadow.clipDepth = p.convention.clipDepth;
      light.shadow.views = {{}, {host::toMat4(p.clipFromView * viewFromWorld), 0}};
      const DepthPlane plane = linearDepth(light, 1);
      CHECK(plane.exists == std::isfinite(p.farPlane));
      if (!plane.exists) continue;
      for (const double share : {0.0, 0.25, 0.5, 1.0})
        for (int i = 0; i < 5; ++i) {
          const double along = p.nearPlane + share * (p.farPlane - p.nearPlane);
          const dvec4 view(random.within(-9, 9) * scale, random.within(-9, 9) * scale, -along, 1);
          const dvec4 point = glm::inverse(viewFromWorld) * view;
          CHECK(glm::dot(plane.coefficients, point) == Approx(share).margin(1e-9));
        }
    }
}

TEST_CASE("a far plane at infinity is told from one that is only far") {
  for (const host::ClipConvention& convention : kConventions)
    for (const double far : {1e2, 1e5, 1e7}) {
      CAPTURE(convention.reversed, far);
      tyndall::Light light = spot({0, 0, 0}, {0, 0, -1}, 0.5);
      light.shadow.clipDepth = convention.clipDepth;
      light.shadow.views = {{host::toMat4(host::perspective(1, 1, 1, far, convention)), 0}};
      const DepthPlane plane = linearDepth(light, 0);
      REQUIRE(plane.exists);
      CHECK(glm::dot(plane.coefficients, dvec4(0, 0, -1, 1)) == Approx(0).margin(1e-6));
      CHECK(glm::dot(plane.coefficients, dvec4(0, 0, -far, 1)) == Approx(1).epsilon(1e-6));
    }
  tyndall::Light endless = spot({0, 0, 0}, {0, 0, -1}, 0.5); // farther than floats tell from infinity
  endless.shadow.views = {{host::toMat4(host::perspective(1, 1, 1, 1e10, {})), 0}};
  CHECK_FALSE(linearDepth(endless, 0).exists);
  Random random(6); // matrices are rounded
  for (const host::ClipConvention& convention : kConventions)
    for (int i = 0; i < 100; ++i) {
      const dvec3 position = random.inCube(1e4), direction = random.direction();
      tyndall::Light light = spot(position, direction, 0.5);
      light.shadow.clipDepth = convention.clipDepth;
      const dmat4 infinite = host::perspective(0.7, 1.1, 0.3, tyndall::kInfinity, convention);
      light.shadow.views = {{host::toMat4(infinite * host::viewLooking(position, direction)), 0}};
      CAPTURE(convention.reversed, i);
      CHECK_FALSE(linearDepth(light, 0).exists);
    }
}
