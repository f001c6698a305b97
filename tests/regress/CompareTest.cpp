// The figures of a comparison, against numbers worked out by hand.
#include "support/Catch.h"

#include <limits>
#include <regress/Compare.h>
#include <regress/Escape.h>

namespace {

constexpr int kWidth = 20, kHeight = 10;

regress::HdrPicture flat(float value) {
  return {kWidth, kHeight, std::vector<float>(std::size_t{3} * kWidth * kHeight, value)};
}

regress::Difference compared(const regress::HdrPicture& wanted, const regress::HdrPicture& got, double pixel = 0.02) {
  render::Options options;
  options.width = kWidth;
  options.height = kHeight;
  return regress::compare(wanted, got, pixel, options, 1);
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

} // namespace

TEST_CASE("differences are relative to the mean of the reference") {
  regress::HdrPicture got = flat(2);
  got.rgb[0] = 3; // one channel of one of 200 pixels, by half the mean
  const regress::Difference d = compared(flat(2), got);
  CHECK(d.rRmse == Approx(std::sqrt(0.25 / 600)));
  CHECK(d.max == Approx(0.5));
  CHECK(d.p99 == 0);
  CHECK(d.over == Approx(1.0 / 200));
  CHECK(d.notFinite == 0);
  CHECK(d.flip > 0);
  CHECK(compared(flat(2), got, 0.5).over == 0); // from beyond the tolerance on
  got.rgb[3] = got.rgb[6] = 2.5;
  CHECK(compared(flat(2), got).p99 == Approx(0.25)); // the third largest of 200
}

TEST_CASE("differences from a black reference are absolute") {
  const regress::Difference d = compared(flat(0), flat(0.25));
  CHECK(d.rRmse == Approx(0.25));
  CHECK(d.max == Approx(0.25));
  CHECK(d.over == 1);
  CHECK(compared(flat(0), flat(0)).max == 0);
}

TEST_CASE("a NaN or an infinity in only one of the pictures breaks every tolerance") {
  for (const float odd : {kNan, kInfinity, -kInfinity}) {
    regress::HdrPicture wanted = flat(1), got = flat(1);
    got.rgb[5] = odd;
    regress::Tolerance wide{1e9, 1e9, 1e9, 1e9, 1, 1.0};
    for (const auto& d : {compared(wanted, got), compared(got, wanted)}) {
      CHECK(d.notFinite == 1);
      CHECK(d.max == 0);
      const auto judgements = regress::judge(d, wide);
      CHECK(judgements.back().name == "pixels not finite in only one");
      CHECK_FALSE(judgements.back().isKept());
    }
    wanted.rgb[5] = odd; // in both alike: the same
    CHECK(compared(wanted, got).notFinite == 0);
    CHECK(compared(wanted, got).max == 0);
  }
}

TEST_CASE("the difference's picture is grey where nothing differs, red where it is brighter and blue where darker") {
  regress::HdrPicture got = flat(1);
  for (int c = 0; c < 3; ++c) {
    got.rgb[c] = 2;
    got.rgb[3 + c] = 0;
  }
  got.rgb[6] = kNan;
  const std::vector<std::uint8_t> colours = regress::differenceColours(flat(1), got, 0.5);
  const auto is = [&](int pixel, int r, int g, int b) {
    return colours[3 * pixel] == r && colours[3 * pixel + 1] == g && colours[3 * pixel + 2] == b;
  };
  CHECK((colours[0] == 255 && colours[2] < 60));
  CHECK((colours[5] == 255 && colours[3] < 60));
  CHECK(is(2, 255, 0, 255));
  CHECK((colours[9] == colours[10] && colours[10] == colours[11]));
}

TEST_CASE("what cannot stand in XML is escaped or replaced") {
  CHECK(regress::escaped("a<b> & \"c\"") == "a&lt;b&gt; &amp; &quot;c&quot;");
  CHECK(regress::escaped("gr\xc3\xbc\xc3\x9f\x65") == "gr\xc3\xbc\xc3\x9f\x65");
  CHECK(regress::escaped(std::string("\x01\xff\xc3", 3)) == "???");
  CHECK(regress::escaped("\xed\xa0\x80") == "???"); // half a surrogate pair
  CHECK(regress::escaped("\xc0\xaf") == "??");      // written too long
  CHECK(regress::escaped("\xef\xbf\xbf") == "???"); // U+FFFF
  CHECK(regress::escaped(std::string(1, '\0')) == "?");
}

TEST_CASE("base64 has the answers of RFC 4648") {
  CHECK(regress::base64("").empty());
  CHECK(regress::base64("f") == "Zg==");
  CHECK(regress::base64("fo") == "Zm8=");
  CHECK(regress::base64("foo") == "Zm9v");
  CHECK(regress::base64("foobar") == "Zm9vYmFy");
}
