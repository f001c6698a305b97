// Every variant of the AVSM's shaders builds, and what engines include does in the shaders that it says it is for.
#include "AvsmRig.h"
#include "support/Catch.h"
#include "support/PublicShaders.h"

using namespace tyndall;
using host::gl;

namespace {

void checkCompiles(GLenum kind, const std::string& source) {
  const GLuint shader = gl().CreateShader(kind);
  const char* text = source.c_str();
  gl().ShaderSource(shader, 1, &text, nullptr);
  gl().CompileShader(shader);
  char log[4096] = "";
  gl().GetShaderInfoLog(shader, sizeof log, nullptr, log);
  GLint ok = 0;
  gl().GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  INFO(log);
  CHECK(ok);
  CHECK(std::string(log).find("warning") == std::string::npos);
  gl().DeleteShader(shader);
}

void checkCompile(const std::vector<tests::PublicShader>& shaders) {
  for (const tests::PublicShader& shader : shaders) {
    if (tests::testContext().glVersion() < shader.version) continue;
    if (!shader.needs.empty() && !tests::hasExtension(shader.needs)) continue;
    CAPTURE(shader.name, shader.extension);
    checkCompiles(shader.extension == "comp"   ? GL_COMPUTE_SHADER
                  : shader.extension == "vert" ? GL_VERTEX_SHADER
                                               : GL_FRAGMENT_SHADER,
                  shader.text);
  }
}

} // namespace

TEST_CASE("avsm: every variant of the passes builds", "[slow]") {
  if (!tests::hasAvsm()) return;
  for (const CurveReduction reduction :
       {CurveReduction::Fitted, CurveReduction::WholeCurve, CurveReduction::Sorted, CurveReduction::InOrder})
    for (const int nodes : {4, 8, 12, 16})
      for (const bool packed : {false, true}) {
        AvsmConfig config;
        config.size = 1;
        config.nodes = nodes;
        config.packed = packed;
        config.reduction = reduction;
        tests::AvsmRig rig(config);
        rig.capture({{{0, 0, 0}, 0.25F, 0.5F, 0.5F}});
        CAPTURE(static_cast<int>(reduction), nodes, packed);
        CHECK(rig.curve({0, 0, 0}).back().y == Approx(0.5).margin(1e-4));
        const auto passes = rig.avsm().statistics().passes;
        CHECK(passes.size() == (reduction == CurveReduction::WholeCurve ? 3
                                : reduction == CurveReduction::Sorted   ? 2
                                                                        : 1));
      }
}

TEST_CASE("avsm: capture compiles in fragment and compute shaders, at any binding") {
  if (tests::hasAvsm()) checkCompile(tests::captureShaders());
}

TEST_CASE("avsm: insertion compiles for all curves, beside capture and look-up") {
  if (tests::hasAvsm()) checkCompile(tests::insertShaders());
}

TEST_CASE("avsm: look-up compiles from #version 330 on, for all curves") { checkCompile(tests::lookupShaders()); }
