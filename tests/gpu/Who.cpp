#include "Who.h"

#include "Outputs.h"

#include <fmt/format.h>
#include <gl/Context.h>
#include <gl/Driver.h>
#include <gl/EglDevices.h>
#include <gl/Gl.h>
#include <scene/Error.h>
#include <scene/Places.h>
#include <set>

namespace gpu {

namespace {

constexpr int kLeastVersion = 43; // of smoke and hair

std::string textOf(GLenum name) {
  const GLubyte* text = host::gl().GetString(name);
  return text ? reinterpret_cast<const char*>(text) : "";
}

Json limits() {
  const std::pair<const char*, GLenum> names[] = {
      {"GL_MAX_TEXTURE_SIZE", GL_MAX_TEXTURE_SIZE},
      {"GL_MAX_ARRAY_TEXTURE_LAYERS", GL_MAX_ARRAY_TEXTURE_LAYERS},
      {"GL_MAX_TEXTURE_IMAGE_UNITS", GL_MAX_TEXTURE_IMAGE_UNITS},
      {"GL_MAX_UNIFORM_BLOCK_SIZE", GL_MAX_UNIFORM_BLOCK_SIZE},
      {"GL_MAX_DRAW_BUFFERS", GL_MAX_DRAW_BUFFERS},
      {"GL_MAX_DUAL_SOURCE_DRAW_BUFFERS", GL_MAX_DUAL_SOURCE_DRAW_BUFFERS},
      {"GL_MAX_COLOR_TEXTURE_SAMPLES", GL_MAX_COLOR_TEXTURE_SAMPLES},
      {"GL_MAX_SHADER_STORAGE_BLOCK_SIZE", GL_MAX_SHADER_STORAGE_BLOCK_SIZE},
      {"GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS", GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS},
      {"GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS", GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS},
      {"GL_MAX_COMPUTE_SHARED_MEMORY_SIZE", GL_MAX_COMPUTE_SHARED_MEMORY_SIZE},
      {"GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS", GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS},
      {"GL_NUM_PROGRAM_BINARY_FORMATS", GL_NUM_PROGRAM_BINARY_FORMATS},
  };
  Json json;
  for (const auto& [name, value] : names) {
    GLint limit = 0;
    host::gl().GetIntegerv(value, &limit);
    json[name] = limit;
  }
  GLint bits = 0;
  host::gl().GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  json["GL_QUERY_COUNTER_BITS of GL_TIMESTAMP"] = bits;
  return json;
}

std::set<std::string> extensions() {
  std::set<std::string> all;
  GLint count = 0;
  host::gl().GetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i)
    all.insert(reinterpret_cast<const char*>(host::gl().GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))));
  return all;
}

Json extensionsThatMatter(const std::set<std::string>& all) {
  Json json;
  for (const char* name :
       {"GL_KHR_parallel_shader_compile", "GL_ARB_parallel_shader_compile", "GL_ARB_get_program_binary",
        "GL_ARB_clip_control", "GL_ARB_texture_filter_anisotropic", "GL_EXT_texture_filter_anisotropic",
        "GL_ARB_fragment_shader_interlock", "GL_NV_fragment_shader_interlock", "GL_INTEL_fragment_shader_ordering",
        "GL_EXT_shader_framebuffer_fetch", "GL_ARB_shader_stencil_export", "GL_KHR_robustness", "GL_NV_gpu_shader5"})
    json[name] = all.count(name) == 1;
  return json;
}

std::optional<double> videoMemory(const std::set<std::string>& all) {
  constexpr GLenum kTotalKibibytes = 0x9048; // GL_GPU_MEMORY_INFO_TOTAL_AVAILABLE_MEMORY_NVX
  if (all.count("GL_NVX_gpu_memory_info") == 0) return std::nullopt;
  GLint kibibytes = 0;
  host::gl().GetIntegerv(kTotalKibibytes, &kibibytes);
  return kibibytes / 1048576.0;
}

} // namespace

Json who() {
  const std::unique_ptr<host::Context> context = host::Context::create(host::ContextKind::Egl, {/*debug*/ false});
  if (context->glVersion() < kLeastVersion)
    throw host::Error(fmt::format("OpenGL 4.3 is needed, and the driver has less: {}", context->driver()));
  const bench::Machine machine = bench::thisMachine();
  const std::set<std::string> all = extensions();
  Json json = {{"commit", machine.commit},
               {"date", machine.date},
               {"driver", context->driver()},
               {"software", host::isSoftware(context->driver())},
               {"display", host::eglDisplayInUse()},
               {"vendor", textOf(GL_VENDOR)},
               {"renderer", textOf(GL_RENDERER)},
               {"version", textOf(GL_VERSION)},
               {"glsl", textOf(GL_SHADING_LANGUAGE_VERSION)},
               {"processor", machine.processor},
               {"cores", machine.cores},
               {"memory_gib", static_cast<double>(machine.memory >> 20) / 1024},
               {"system", machine.system}};
  for (const host::EglDevice& device : host::eglDevices())
    json["devices"].push_back({{"name", device.name}, {"software", device.isSoftware}});
  if (const std::optional<double> gibibytes = videoMemory(all)) json["video_memory_gib"] = *gibibytes;
  json["limits"] = limits();
  json["extensions"] = extensionsThatMatter(all);
  json["extension_count"] = all.size();
  return json;
}

} // namespace gpu
