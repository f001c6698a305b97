// What tyndall-render draws with where Mesa has no OSMesa any more. Files that are no libraries stand for its absence.
#include "RunTool.h"
#include "support/Catch.h"

#include <nlohmann/json.hpp>

namespace {

tests::ToolResult runWithoutOsmesa(const tests::ToolFolder& folder, const std::string& options) {
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
    folder.write(name, "");
  return folder.shell("LD_LIBRARY_PATH=. tyndall-render triangle.gltf --size 16x16 --shadow-size 16 --stats s.json " +
                      options);
}

} // namespace

TEST_CASE("without libOSMesa tyndall-render draws with EGL and says so") {
  const tests::ToolFolder folder;
  const tests::ToolResult result = runWithoutOsmesa(folder, "");
  CAPTURE(result.err);
  REQUIRE(result.exitCode == 0);
  CHECK(result.errLines().front() == "context egl is used: libOSMesa is not installed");
  CHECK(nlohmann::json::parse(folder.read("s.json")).at("context") == "egl");
}

TEST_CASE("a context that is asked for is not replaced") {
  const tests::ToolFolder folder;
  const tests::ToolResult osmesa = runWithoutOsmesa(folder, "--context osmesa");
  CHECK(osmesa.exitCode == 1);
  CHECK(osmesa.err == "tyndall-render: context osmesa: libOSMesa.so.8 cannot be opened; is libosmesa6 installed?\n");
  const tests::ToolResult egl = runWithoutOsmesa(folder, "--context egl");
  CHECK(egl.exitCode == 0);
  CHECK_THAT(egl.err, !Catch::Contains("libOSMesa"));
}
