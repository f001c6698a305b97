#include "support/Catch.h"

#include <cmath>
#include <limits>
#include <reference/Metrics.h>

using namespace reference;

TEST_CASE("metrics of known errors", "[reference][metrics]") {
  Image truth(10, 10), image(10, 10);
  truth.rgb.assign(300, 2.0);
  image = truth;
  const ErrorMetrics same = compare(image, truth);
  CHECK(same.rRmse == 0);
  CHECK(same.p99 == 0);
  CHECK(same.max == 0);
  CHECK(same.mean == 2);

  // Four values off by 0.2, -0.4, 0.6 and 1: the 297th of 300 in order, the 99th percentile, is 0.2.
  image.rgb[0] += 0.2;
  image.rgb[7] -= 0.4;
  image.rgb[100] += 0.6;
  image.rgb[299] += 1;
  const ErrorMetrics off = compare(image, truth);
  CHECK(off.rRmse == Approx(std::sqrt((0.04 + 0.16 + 0.36 + 1) / 300) / 2));
  CHECK(off.p99 == Approx(0.1));
  CHECK(off.max == Approx(0.5));
  CHECK(off.nonFinite == 0);
  CHECK(differenceImage(image, truth).rgb[100] == Approx(0.3));
}

TEST_CASE("NaN, infinity and a black reference are failures", "[reference][metrics]") {
  Image truth(2, 2), image(2, 2);
  truth.rgb.assign(12, 1.0);
  image = truth;
  image.rgb[3] = std::numeric_limits<double>::quiet_NaN();
  image.rgb[5] = kInfinity;
  const ErrorMetrics broken = compare(image, truth);
  CHECK(broken.nonFinite == 2);
  CHECK(std::isinf(broken.rRmse));
  CHECK(std::isinf(broken.max));

  const Image black(2, 2);
  CHECK(compare(black, black).rRmse == 0);
  CHECK(std::isinf(compare(truth, black).rRmse));
  CHECK_THROWS_AS(compare(Image(2, 3), truth), std::invalid_argument);
}
