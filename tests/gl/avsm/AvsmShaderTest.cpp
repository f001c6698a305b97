// Every variant of the AVSM's shaders builds, and what engines include does in the shaders that it says it is for.
#include "AvsmRig.h"

#include <catch2/catch.hpp>

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

std::string define(const std::string& name, int value) {
  return "#define " + name + " " + std::to_string(value) + "\n";
}

} // namespace

TEST_CASE("avsm: every variant of the passes builds") {
  if (!tests::hasAvsm()) return;
  for (const CurveReduction reduction : {CurveReduction::WholeCurve, CurveReduction::Sorted, CurveReduction::InOrder})
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
  if (!tests::hasAvsm()) return;
  for (const std::string& version : {std::string("#version 430 core\n"), std::string("#version 450 core\n")})
    for (const std::string& bindings :
         {std::string(), define("TYNDALL_LISTS_BINDING", 4) + define("TYNDALL_SEGMENTS_BINDING", 5)})
      for (const bool withLookup : {false, true}) {
        std::string text = version + bindings + avsmCaptureSource();
        if (withLookup)
          text += define("TYNDALL_CURVE_NODES", 8) + define("TYNDALL_CURVE_PACKED", 1) + avsmLookupSource();
        checkCompiles(GL_FRAGMENT_SHADER,
                      text + "void main() { tyndallCapture(ivec3(gl_FragCoord.xy, 0), 0.25, 0.5, 0.5); }\n");
        checkCompiles(GL_COMPUTE_SHADER,
                      text +
                          "layout(local_size_x = 1) in;\nvoid main() { tyndallCapture(ivec3(0), 0.25, 0.5, 0.5); }\n");
      }
}

TEST_CASE("avsm: insertion compiles for all curves, beside capture and look-up") {
  if (!tests::hasAvsm()) return;
  const bool fetch = tests::hasExtension("GL_EXT_shader_framebuffer_fetch");
  const bool interlock = tests::hasExtension("GL_ARB_fragment_shader_interlock");
  for (const int nodes : {4, 8, 12, 16})
    for (const int packed : {0, 1}) {
      CAPTURE(nodes, packed);
      const std::string curves = define("TYNDALL_CURVE_NODES", nodes) + define("TYNDALL_CURVE_PACKED", packed);
      const std::string image = curves + define("TYNDALL_CURVES_IMAGE", 3) + avsmInsertSource();
      const std::string call = "tyndallInsertAt(ivec3(0), 0.25, 0.5, 0.5);";
      const std::string computeMain = "layout(local_size_x = 1) in;\nvoid main() { " + call + " }\n";
      checkCompiles(GL_COMPUTE_SHADER, "#version 430 core\n" + image + computeMain);
      checkCompiles(GL_COMPUTE_SHADER, "#version 430 core\n" + std::string(avsmCaptureSource()) + image +
                                           avsmLookupSource() + computeMain);
      if (interlock)
        checkCompiles(GL_FRAGMENT_SHADER,
                      "#version 430 core\n#extension GL_ARB_fragment_shader_interlock : require\n" + image +
                          "layout(pixel_interlock_ordered) in;\nvoid main() {\n  beginInvocationInterlockARB();\n  " +
                          call + "\n  endInvocationInterlockARB();\n}\n");
      if (!fetch) continue;
      for (const std::string& version : {std::string("#version 330 core\n"), std::string("#version 430 core\n")})
        checkCompiles(GL_FRAGMENT_SHADER, version + "#extension GL_EXT_shader_framebuffer_fetch : require\n" + curves +
                                              avsmInsertSource() + "void main() { tyndallInsert(0.25, 0.5, 0.5); }\n");
    }
}

TEST_CASE("avsm: look-up compiles from #version 330 on, for all curves") {
  tests::testContext();
  std::vector<std::string> versions = {"#version 330 core\n"};
  if (tests::testContext().glVersion() >= 43) versions.emplace_back("#version 430 core\n");
  for (const std::string& version : versions)
    for (const int nodes : {4, 8, 12, 16})
      for (int bits = 0; bits < 4; ++bits) {
        CAPTURE(version, nodes, bits);
        std::string text = version + define("TYNDALL_CURVE_NODES", nodes) + define("TYNDALL_CURVE_PACKED", bits & 1);
        if ((bits & 2) != 0) text += define("TYNDALL_CURVE_EXPONENTIAL", 1);
        text += avsmLookupSource();
        text += "uniform usampler2DArray curves;\n";
        const std::string value = "tyndallTransmittanceBilinear(curves, vec2(0.5), 0, 0.5) + "
                                  "tyndallTransmittance(curves, ivec3(0), 0.5)";
        checkCompiles(GL_FRAGMENT_SHADER, text + "out vec4 colour;\nvoid main() { colour = vec4(" + value + "); }\n");
        checkCompiles(GL_VERTEX_SHADER, text + "void main() { gl_Position = vec4(" + value + "); }\n");
      }
}
