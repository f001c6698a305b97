#include "PublicShaders.h"

#include <tyndall/avsm.h>
#include <tyndall/tyndall.h>

using namespace tyndall;

namespace tests {

namespace {

std::string define(const std::string& name, int value) {
  return "#define " + name + " " + std::to_string(value) + "\n";
}

std::string version(int number) { return "#version " + std::to_string(10 * number) + " core\n"; }

std::string extend(const std::string& extension) { return "#extension " + extension + " : require\n"; }

std::string curves(int nodes, bool packed) {
  return define("TYNDALL_CURVE_NODES", nodes) + define("TYNDALL_CURVE_PACKED", packed ? 1 : 0);
}

std::string nameOf(int nodes, bool packed) {
  return "-" + std::to_string(nodes) + "-nodes" + (packed ? "-packed" : "");
}

const std::string kCompute = "layout(local_size_x = 1) in;\n";

std::string mainOf(const std::string& body) { return "void main() { " + body + " }\n"; }

} // namespace

std::vector<PublicShader> captureShaders() {
  std::vector<PublicShader> all;
  for (const int number : {43, 45})
    for (const bool bindings : {false, true})
      for (const bool withLookup : {false, true}) {
        const std::string name =
            "capture-" + std::to_string(number) + (bindings ? "-bindings" : "") + (withLookup ? "-and-look-up" : "");
        std::string text = version(number);
        if (bindings) text += define("TYNDALL_LISTS_BINDING", 4) + define("TYNDALL_SEGMENTS_BINDING", 5);
        text += avsmCaptureSource();
        if (withLookup) text += curves(8, true) + avsmLookupSource();
        all.push_back(
            {name, "frag", text + mainOf("tyndallCapture(ivec3(gl_FragCoord.xy, 0), 0.25, 0.5, 0.5);"), number, {}});
        all.push_back(
            {name, "comp", text + kCompute + mainOf("tyndallCapture(ivec3(0), 0.25, 0.5, 0.5);"), number, {}});
      }
  return all;
}

std::vector<PublicShader> insertShaders() {
  std::vector<PublicShader> all;
  const std::string interlock = "GL_ARB_fragment_shader_interlock", fetch = "GL_EXT_shader_framebuffer_fetch";
  const std::string call = "tyndallInsertAt(ivec3(0), 0.25, 0.5, 0.5);";
  for (const int nodes : {4, 8, 12, 16})
    for (const bool packed : {false, true}) {
      const std::string name = nameOf(nodes, packed);
      const std::string image = curves(nodes, packed) + define("TYNDALL_CURVES_IMAGE", 3) + avsmInsertSource();
      all.push_back({"insert" + name, "comp", version(43) + image + kCompute + mainOf(call), 43, {}});
      all.push_back({"insert-capture-and-look-up" + name,
                     "comp",
                     version(43) + avsmCaptureSource() + image + avsmLookupSource() + kCompute + mainOf(call),
                     43,
                     {}});
      for (const int number : {43, 45})
        all.push_back({"insert-interlocked-" + std::to_string(number) + name, "frag",
                       version(number) + extend(interlock) + image + "layout(pixel_interlock_ordered) in;\n" +
                           mainOf("beginInvocationInterlockARB(); " + call + " endInvocationInterlockARB();"),
                       number, interlock});
      for (const int number : {33, 43})
        all.push_back({"insert-fetched-" + std::to_string(number) + name, "frag",
                       version(number) + extend(fetch) + curves(nodes, packed) + avsmInsertSource() +
                           mainOf("tyndallInsert(0.25, 0.5, 0.5);"),
                       number, fetch});
    }
  return all;
}

std::vector<PublicShader> lookupShaders() {
  std::vector<PublicShader> all;
  const std::string value = "tyndallTransmittanceBilinear(curves, vec2(0.5), 0, 0.5) + "
                            "tyndallTransmittance(curves, ivec3(0), 0.5)";
  for (const int number : {33, 43})
    for (const int nodes : {4, 8, 12, 16})
      for (const bool packed : {false, true})
        for (const bool exponential : {false, true}) {
          const std::string name =
              "look-up-" + std::to_string(number) + nameOf(nodes, packed) + (exponential ? "-exponential" : "");
          std::string text = version(number) + curves(nodes, packed);
          if (exponential) text += define("TYNDALL_CURVE_EXPONENTIAL", 1);
          text += std::string(avsmLookupSource()) + "uniform usampler2DArray curves;\n";
          all.push_back(
              {name, "frag", text + "out vec4 colour;\n" + mainOf("colour = vec4(" + value + ");"), number, {}});
          all.push_back({name, "vert", text + mainOf("gl_Position = vec4(" + value + ");"), number, {}});
        }
  return all;
}

std::vector<PublicShader> shaftsLookupShaders() {
  std::vector<PublicShader> all;
  const std::string embedded = "#version 320 es\nprecision highp float;\nprecision highp sampler2DArray;\n";
  for (const int number : {33, 43, 32}) {
    const std::string text = (number == 32 ? embedded : version(number)) + shaftsLookupSource(),
                      call = "tyndallShafts(vec2(0.5), 2.0)", name = "shafts-look-up-" + std::to_string(number);
    all.push_back({name,
                   "frag",
                   text + "out vec4 colour;\n" + mainOf("colour = vec4(" + call + ".inscatter, 1.0);"),
                   number,
                   {}});
    all.push_back({name, "vert", text + mainOf("gl_Position = vec4(" + call + ".transmittance, 1.0);"), number, {}});
  }
  return all;
}

} // namespace tests
