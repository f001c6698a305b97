#include "avsm/CheckAvsm.h"

#include "avsm/Curves.h"
#include "avsm/Lists.h"
#include "gl/Enums.h"

#include <utility>

namespace tyndall::avsm {

namespace {

Status invalid(const std::string& field, const std::string& value, const std::string& rule) {
  return {StatusCode::InvalidConfig, "AvsmConfig::" + field + " is " + value + ": " + rule};
}

} // namespace

Status checkConfig(const AvsmConfig& config) {
  if (!config.loader) return invalid("loader", "null", "must resolve GL functions");
  if (config.timing < PassTiming::Off || config.timing > PassTiming::Finish)
    return invalid("timing", std::to_string(static_cast<int>(config.timing)), "must be one of the enumerators");
  if (config.size < 1 || config.size > 4096) return invalid("size", std::to_string(config.size), "must be 1 to 4096");
  if (config.layers < 1 || config.layers > kMaxShadowViews)
    return invalid("layers", std::to_string(config.layers), "must be 1 to 6");
  if (config.nodes < 4 || config.nodes > kMaxNodes || config.nodes % 4 != 0)
    return invalid("nodes", std::to_string(config.nodes), "must be 4, 8, 12 or 16");
  if (config.reduction < CurveReduction::Fitted || config.reduction > CurveReduction::InOrder)
    return invalid("reduction", std::to_string(static_cast<int>(config.reduction)), "must be one of the enumerators");
  if (config.state < StateMode::Restore || config.state > StateMode::Leave)
    return invalid("state", std::to_string(static_cast<int>(config.state)), "must be one of the enumerators");
  return {};
}

Status checkLimits(const gl::Functions& gl, const AvsmConfig& config) {
  const std::string size = std::to_string(config.size), layers = std::to_string(config.layers);
  gl::Int width = 0, depth = 0, block = 0;
  gl.GetIntegerv(gl::MAX_TEXTURE_SIZE, &width);
  gl.GetIntegerv(gl::MAX_ARRAY_TEXTURE_LAYERS, &depth);
  gl.GetIntegerv(gl::MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
  if (config.size > width) return invalid("size", size, "this context has " + std::to_string(width) + " texels a side");
  if (curveLayersOf(config) > depth)
    return invalid("layers", layers, "this context has " + std::to_string(depth) + " layers of a texture");
  const std::uint64_t bytes = leastBufferBytes(config.size, config.layers);
  if (block > 0 && bytes > static_cast<std::uint64_t>(block))
    return invalid("size", size,
                   "with " + layers + " layers it needs storage buffers of " + std::to_string(bytes) +
                       " bytes, this context has " + std::to_string(block));
  return {};
}

std::string missingFunction(const gl::Functions& gl) {
  const std::pair<const char*, bool> all[] = {
      {"glDispatchCompute", gl.DispatchCompute},       {"glMemoryBarrier", gl.MemoryBarrier},
      {"glBindImageTexture", gl.BindImageTexture},     {"glTexStorage3D", gl.TexStorage3D},
      {"glClearBufferSubData", gl.ClearBufferSubData}, {"glFramebufferTextureLayer", gl.FramebufferTextureLayer}};
  for (const auto& [name, known] : all)
    if (!known) return name;
  return {};
}

} // namespace tyndall::avsm
