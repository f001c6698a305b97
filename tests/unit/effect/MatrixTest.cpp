// The public mat4 functions: by column and by row, of floats, doubles and GLM.
#include "support/Catch.h"

#include <array>
#include <glm/glm.hpp>
#include <tyndall/tyndall.h>

using namespace tyndall;

namespace {

// Element (row r, column c) is 10 r + c.
constexpr double element(int row, int column) { return 10.0 * row + column; }

template <typename Number>
std::array<Number, 16> stored(bool byRow) {
  std::array<Number, 16> numbers{};
  for (int i = 0; i < 16; ++i)
    numbers[static_cast<std::size_t>(i)] = static_cast<Number>(byRow ? element(i / 4, i % 4) : element(i % 4, i / 4));
  return numbers;
}

template <typename Matrix>
Matrix filled() {
  Matrix m(0);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      m[column][row] = static_cast<typename Matrix::value_type>(element(row, column));
  return m;
}

} // namespace

TEST_CASE("a matrix is the same however it is stored") {
  Mat4 expected{};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      expected[static_cast<std::size_t>(4 * column + row)] = element(row, column);
  CHECK(mat4(stored<float>(false).data()) == expected);
  CHECK(mat4(stored<double>(false).data()) == expected);
  CHECK(mat4RowMajor(stored<float>(true).data()) == expected);
  CHECK(mat4RowMajor(stored<double>(true).data()) == expected);
  CHECK(mat4(filled<glm::mat4>()) == expected);
  CHECK(mat4(filled<glm::dmat4>()) == expected);
}

TEST_CASE("doubles are not rounded") {
  std::array<double, 16> numbers{};
  numbers.fill(1.0 / 3);
  CHECK(mat4(numbers.data())[5] == 1.0 / 3);
  CHECK(mat4RowMajor(numbers.data())[5] == 1.0 / 3);
  CHECK(mat4(glm::dmat4(1.0 / 3))[5] == 1.0 / 3);
}

TEST_CASE("vectors of any kind that has x, y and z") {
  const glm::vec3 v(1, -2, 0.5F);
  CHECK(tyndall::vec3(v) == Vec3{1, -2, 0.5});
  CHECK(tyndall::vec3(glm::dvec3(1.0 / 3, 0, 0))[0] == 1.0 / 3);
  CHECK(tyndall::rgb(v) == Rgb{1, -2, 0.5F});
}
