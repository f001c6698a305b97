// The report in a real browser, and its JUnit twin.
#include "SuiteFolder.h"
#include "support/Catch.h"

#include <png.h>
#include <set>

namespace {

using tests::SuiteFolder;
using tests::ToolResult;

/// A picture that is the same, one that differs, one that failed.
void checkAllKinds(const SuiteFolder& suite) {
  nlohmann::json cases = tests::twoCases();
  REQUIRE(suite.record().exitCode == 0);
  cases[1]["options"] = {"--slices", "65"};
  cases.push_back({{"name", "lost"}, {"scene", "a&b<c>.glb"}});
  suite.writeCases(cases);
  REQUIRE(suite.check().exitCode == 1);
}

std::string browser() {
  return tests::ToolFolder()
      .shell("command -v chromium || command -v chromium-browser || command -v google-chrome")
      .out;
}

ToolResult browse(const SuiteFolder& suite, const std::string& arguments) {
  const std::string program = browser().substr(0, browser().find('\n'));
  return suite.folder().shell(program +
                              " --headless --no-sandbox --disable-gpu --hide-scrollbars"
                              " --user-data-dir=profile --virtual-time-budget=2000 " +
                              arguments);
}

/// RGB, as the browser shot it.
std::vector<std::uint8_t> pixelsOf(const std::filesystem::path& file, int& width) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_file(&image, file.c_str()) != 0);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  REQUIRE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) != 0);
  width = static_cast<int>(image.width);
  return pixels;
}

std::size_t colourCount(const std::vector<std::uint8_t>& pixels) {
  std::set<std::uint32_t> colours;
  for (std::size_t i = 0; i + 2 < pixels.size(); i += 3)
    colours.insert(pixels[i] << 16U | pixels[i + 1] << 8U | pixels[i + 2]);
  return colours.size();
}

/// The page with a script that runs after its own.
void writeWith(const SuiteFolder& suite, const std::string& name, const std::string& script) {
  std::string page = suite.folder().read("out/report.html");
  page.replace(page.rfind("</body>"), 7, "<script>" + script + "</script></body>");
  suite.folder().write(name, page);
}

} // namespace

TEST_CASE("junit.xml is well formed and says what the check said") {
  const SuiteFolder suite(tests::twoCases());
  checkAllKinds(suite);
  const ToolResult parsed = suite.folder().shell(R"(python3 -c '
import xml.etree.ElementTree as tree
root = tree.parse("out/junit.xml").getroot()
suite = root.find("testsuite")
print(root.tag, suite.get("tests"), suite.get("failures"), suite.get("errors"), suite.get("skipped"))
for case in suite:
  print(case.get("name"), *[child.tag for child in case], float(case.get("time")) >= 0, case.get("classname"))
print(suite.find("testcase[@name=\"lost\"]/error").get("message"))
')");
  CAPTURE(parsed.err);
  REQUIRE(parsed.exitCode == 0);
  CHECK(parsed.out.rfind("testsuites 3 1 1 0\ncage True tyndall.regress\nprojector failure True tyndall.regress\n"
                         "lost error True tyndall.regress\nfailed: ",
                         0) == 0);
  CHECK(parsed.out.find("a&b<c>.glb: cannot be read: no such file") != std::string::npos);
}

TEST_CASE("the report needs no other file and begins with the worst") {
  const SuiteFolder suite(tests::twoCases());
  checkAllKinds(suite);
  const std::string page = suite.folder().read("out/report.html");
  for (const char* outside : {"http://", "https://", "src=\"/", "src=\"p", "url(", "@import", "<link"})
    CHECK(page.find(outside) == std::string::npos);
  const auto lost = page.find("id=\"lost\""), projector = page.find("id=\"projector\""),
             cage = page.find("id=\"cage\"");
  CHECK((lost < projector && projector < cage && cage != std::string::npos));
  CHECK(page.find("2 of 3 cases are not the same") != std::string::npos);
  CHECK(page.find("a&amp;b&lt;c&gt;.glb") != std::string::npos);
  CHECK(page.find("commit test") != std::string::npos);
}

TEST_CASE("a browser shows the report, and its wipe uncovers what was got") {
  if (browser().empty()) {
    WARN("skipped: no chromium");
    return;
  }
  const SuiteFolder suite(tests::twoCases());
  checkAllKinds(suite);
  const auto wipeAt = [&](const std::string& value) {
    writeWith(suite, "wipe" + value + ".html",
              "const s = document.querySelector('.stack input'); s.value = " + value +
                  "; s.dispatchEvent(new Event('input')); s.scrollIntoView({block: 'center'});"
                  "document.title = getComputedStyle(document.querySelector('.stack .over')).clipPath;");
    REQUIRE(
        browse(suite, "--window-size=1280,900 --screenshot=wipe" + value + ".png wipe" + value + ".html").exitCode ==
        0);
    int width = 0;
    return pixelsOf(suite.folder().path("wipe" + value + ".png"), width);
  };
  const auto got = wipeAt("0"), wanted = wipeAt("100");
  CHECK(colourCount(got) > 1000); // pictures, not a blank page
  REQUIRE(got.size() == wanted.size());
  CHECK(got != wanted);
  const ToolResult dom = browse(suite, "--dump-dom wipe100.html");
  CHECK(dom.out.find("<title>inset(0px 0% 0px 0px)") != std::string::npos);
  CHECK(dom.out.find("type=\"range\"") != std::string::npos); // arrow keys move it
}
