#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <scene/Projection.h>

namespace {

using tyndall::ClipDepth;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const host::ClipConvention kConventions[] = {{false, ClipDepth::NegativeOneToOne},
                                             {false, ClipDepth::ZeroToOne},
                                             {true, ClipDepth::NegativeOneToOne},
                                             {true, ClipDepth::ZeroToOne}};

double largestDifference(const glm::dmat4& a, const glm::dmat4& b) {
  double largest = 0;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
  return largest;
}

double ndcZ(const glm::dmat4& clipFromView, double viewDepth) {
  const glm::dvec4 clip = clipFromView * glm::dvec4(0, 0, -viewDepth, 1);
  return clip.z / clip.w;
}

} // namespace

TEST_CASE("perspective projections agree with GLM") {
  const double fov = 0.9;
  const double aspect = 1.7;
  const double tangent = std::tan(fov / 2);
  const auto ours = [&](double farPlane, ClipDepth clipDepth) {
    return host::perspective(tangent * aspect, tangent, 0.25, farPlane, {false, clipDepth});
  };
  CHECK(largestDifference(ours(80, ClipDepth::NegativeOneToOne), glm::perspectiveRH_NO(fov, aspect, 0.25, 80.0)) <
        1e-13);
  CHECK(largestDifference(ours(80, ClipDepth::ZeroToOne), glm::perspectiveRH_ZO(fov, aspect, 0.25, 80.0)) < 1e-13);
  CHECK(largestDifference(ours(kInfinity, ClipDepth::NegativeOneToOne), glm::infinitePerspectiveRH(fov, aspect, 0.25)) <
        1e-13);
}

TEST_CASE("orthographic projections agree with GLM") {
  const auto ours = [](ClipDepth clipDepth) { return host::orthographic(3, 2, -4, 9, {false, clipDepth}); };
  CHECK(largestDifference(ours(ClipDepth::NegativeOneToOne), glm::orthoRH_NO(-3.0, 3.0, -2.0, 2.0, -4.0, 9.0)) < 1e-13);
  CHECK(largestDifference(ours(ClipDepth::ZeroToOne), glm::orthoRH_ZO(-3.0, 3.0, -2.0, 2.0, -4.0, 9.0)) < 1e-13);
}

TEST_CASE("near and far plane map to the ends that the depth convention names") {
  const double expectedNear[] = {-1, 0, 1, 1};
  const double expectedFar[] = {1, 1, -1, 0};
  for (int i = 0; i < 4; ++i) {
    CAPTURE(i);
    for (const double farPlane : {7.0, 1e6, kInfinity}) {
      const glm::dmat4 clipFromView = host::perspective(1, 1, 0.5, farPlane, kConventions[i]);
      CHECK(ndcZ(clipFromView, 0.5) == Approx(expectedNear[i]).margin(1e-12));
      CHECK(ndcZ(clipFromView, std::min(farPlane, 1e14)) == Approx(expectedFar[i]).margin(1e-12));
    }
    const glm::dmat4 box = host::orthographic(1, 1, -2, 5, kConventions[i]);
    CHECK(ndcZ(box, -2) == Approx(expectedNear[i]).margin(1e-12));
    CHECK(ndcZ(box, 5) == Approx(expectedFar[i]).margin(1e-12));
  }
}

TEST_CASE("a view matrix agrees with GLM") {
  const glm::dvec3 eye(3, -2, 5);
  const glm::dvec3 target(-1, 4, 2);
  const glm::dvec3 up(0.1, 1, -0.3);
  CHECK(largestDifference(host::viewLooking(eye, target - eye, up), glm::lookAt(eye, target, up)) < 1e-13);
}

TEST_CASE("a view matrix is rigid for every direction") {
  for (const glm::dvec3 direction : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, -5, 1e-9),
                                     glm::dvec3(1e-4, -1, 0), glm::dvec3(0, 0, 1e-20), glm::dvec3(1e20, 0, 0)}) {
    CAPTURE(direction.x, direction.y, direction.z);
    const glm::dmat4 view = host::viewLooking({1, 2, 3}, direction);
    const glm::dmat3 rotation(view);
    CHECK(largestDifference(glm::dmat4(rotation * glm::transpose(rotation)), glm::dmat4(1)) < 1e-12);
    CHECK(glm::determinant(rotation) == Approx(1));
    CHECK(glm::length(rotation * glm::normalize(direction) - glm::dvec3(0, 0, -1)) < 1e-12);
    CHECK(glm::length(glm::dvec3(view * glm::dvec4(1, 2, 3, 1))) < 1e-12);
  }
}

TEST_CASE("matrices keep their columns on the way to the effect and back") {
  const glm::dmat4 matrix = glm::lookAt(glm::dvec3(1, 2, 3), glm::dvec3(0), glm::dvec3(0, 1, 0));
  const tyndall::Mat4 packed = host::toMat4(matrix);
  CHECK(packed[12] == matrix[3][0]);
  CHECK(packed[1] == matrix[0][1]);
  CHECK(largestDifference(host::fromMat4(packed), matrix) == 0);
}
