// The factors of a matrix by singular values (optics/LowRank.h).
#include "optics/LowRank.h"
#include "support/Catch.h"

#include <cmath>
#include <limits>

using tyndall::optics::factorise;

namespace {

Eigen::VectorXd ones(int n) { return Eigen::VectorXd::Ones(n); }

// A smooth kernel, of full rank but with singular values that fall fast.
Eigen::MatrixXd kernel(int n) {
  Eigen::MatrixXd m(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      m(i, j) = std::exp(-3.0 * (i + 1) * (j + 1) / (n * n));
  return m;
}

} // namespace

TEST_CASE("a matrix of rank two is the product of two terms") {
  const Eigen::VectorXd a = Eigen::VectorXd::LinSpaced(12, 1, 4), b = Eigen::VectorXd::LinSpaced(9, -1, 2);
  const Eigen::MatrixXd matrix = a * b.transpose() + a.cwiseProduct(a) * ones(9).transpose();
  for (const int terms : {2, 5}) {
    const auto factors = factorise(matrix, Eigen::VectorXd::LinSpaced(12, 0.1, 3), ones(9), terms);
    REQUIRE(factors);
    CHECK(factors->rays.cols() == terms);
    CHECK(factors->lights.rows() == terms);
    CHECK((factors->rays * factors->lights - matrix).norm() <= 1e-12 * matrix.norm());
  }
  const auto one = factorise(matrix, ones(12), ones(9), 1);
  REQUIRE(one);
  CHECK((one->rays * one->lights - matrix).norm() > 1e-3 * matrix.norm());
}

TEST_CASE("each term of a smooth kernel brings its product nearer") {
  const Eigen::MatrixXd matrix = kernel(64);
  double before = matrix.norm();
  for (int terms = 1; terms <= 5; ++terms) {
    const auto factors = factorise(matrix, ones(64), ones(64), terms);
    REQUIRE(factors);
    const double error = (factors->rays * factors->lights - matrix).norm();
    CHECK(error < 0.3 * before);
    before = error;
  }
}

TEST_CASE("rows of more weight are nearer") {
  const Eigen::MatrixXd matrix = kernel(16);
  Eigen::VectorXd weights = ones(16);
  weights[3] = 1e3;
  const auto even = factorise(matrix, ones(16), ones(16), 1), uneven = factorise(matrix, weights, ones(16), 1);
  REQUIRE((even && uneven));
  const auto errorOf = [&](const tyndall::optics::LowRankFactors& f) {
    return (f.rays * f.lights - matrix).row(3).norm();
  };
  CHECK(errorOf(*uneven) < 0.1 * errorOf(*even));
}

TEST_CASE("the zero matrix has factors of zero, one that is not finite has none") {
  const auto zero = factorise(Eigen::MatrixXd::Zero(64, 64), ones(64), ones(64), 4);
  REQUIRE(zero);
  CHECK((zero->rays * zero->lights).isZero(0));
  CHECK(zero->rays.allFinite());
  CHECK(zero->lights.allFinite());
  for (const double broken : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    Eigen::MatrixXd matrix = kernel(8);
    matrix(2, 5) = broken;
    CHECK_FALSE(factorise(matrix, ones(8), ones(8), 4));
  }
}
