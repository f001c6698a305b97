#include "ReferenceCache.h"

#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <scene/Error.h>
#include <scene/FileIo.h>

namespace bench {

namespace {

/// To be raised when a reference's answer to the same question changes.
constexpr std::uint32_t kVersion = 1;
constexpr char kMagic[8] = {'T', 'Y', 'N', 'D', 'R', 'E', 'F', '\n'};

struct Header {
  char magic[8];
  std::uint32_t version;
  std::int32_t width, height;
  std::uint32_t padding;
  std::uint64_t checksum;
};

/// FNV-1a over values and arrays of them.
class Hash {
public:
  void bytes(const void* data, std::size_t size) {
    const auto* at = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i)
      value_ = (value_ ^ at[i]) * 1099511628211ULL;
  }
  void number(double value) { bytes(&value, sizeof value); }
  template <class T>
  void array(const T& values) {
    number(static_cast<double>(values.size()));
    bytes(values.data(), values.size() * sizeof(values[0]));
  }
  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

void addLight(Hash& hash, const tyndall::Light& light) {
  hash.number(static_cast<int>(light.kind));
  hash.array(light.direction);
  hash.array(light.position);
  hash.array(light.colour);
  for (const double value : {light.range, light.innerConeAngle, light.outerConeAngle})
    hash.number(value);
  hash.number(light.litOutsideViews ? 1 : 0);
  hash.number(light.boundary.enabled ? 1 : 0);
  hash.array(light.boundary.point);
  hash.array(light.boundary.normal);
  hash.number(static_cast<int>(light.shadow.clipDepth));
  for (const tyndall::ShadowView& view : light.shadow.views) {
    hash.array(view.clipFromWorld);
    hash.number(view.layer);
  }
}

void addFrame(Hash& hash, const tyndall::Camera& camera, const std::vector<tyndall::Light>& lights,
              const tyndall::Medium& medium, int width, int height) {
  hash.array(camera.viewFromWorld);
  hash.array(camera.clipFromView);
  hash.number(static_cast<int>(camera.clipDepth));
  hash.number(static_cast<double>(lights.size()));
  for (const tyndall::Light& light : lights)
    addLight(hash, light);
  for (const tyndall::Constituent& constituent : medium.constituents) {
    hash.array(constituent.scattering);
    hash.number(static_cast<int>(constituent.phase));
    hash.number(constituent.g);
  }
  hash.array(medium.absorption);
  for (const double value : {medium.farDistance, static_cast<double>(width), static_cast<double>(height)})
    hash.number(value);
}

std::uint64_t checksumOf(const reference::Image& image) {
  Hash hash;
  hash.array(image.rgb);
  return hash.value();
}

/// Why a file cannot be used; empty if `image` now holds it.
std::string load(const std::filesystem::path& file, reference::Image& image) {
  std::ifstream stream(file, std::ios::binary);
  Header header{};
  stream.read(reinterpret_cast<char*>(&header), sizeof header);
  if (!stream || std::memcmp(header.magic, kMagic, sizeof kMagic) != 0) return "is corrupt";
  if (header.version != kVersion) return fmt::format("is of version {} instead of {}", header.version, kVersion);
  if (header.width != image.width || header.height != image.height) return "is corrupt";
  const auto size = static_cast<std::streamsize>(image.rgb.size() * sizeof image.rgb[0]);
  stream.read(reinterpret_cast<char*>(image.rgb.data()), size);
  if (stream.gcount() != size || stream.peek() != std::ifstream::traits_type::eof()) return "is corrupt";
  return checksumOf(image) == header.checksum ? "" : "is corrupt";
}

void save(const std::filesystem::path& file, const reference::Image& image) {
  Header header{{}, kVersion, image.width, image.height, 0, checksumOf(image)};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  host::writeAndRename(file, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(&header), sizeof header);
    stream.write(reinterpret_cast<const char*>(image.rgb.data()),
                 static_cast<std::streamsize>(image.rgb.size() * sizeof image.rgb[0]));
    if (!stream.flush()) throw host::Error("cannot be written");
  });
}

} // namespace

ReferenceCache::ReferenceCache(std::filesystem::path folder, std::function<void(const std::string&)> say)
    : folder_(std::move(folder)), say_(std::move(say)) {
  if (!folder_.empty()) std::filesystem::create_directories(folder_);
}

reference::Image ReferenceCache::get(const std::string& name, int width, int height,
                                     const std::function<reference::Image()>& make) const {
  if (folder_.empty()) return make();
  const std::filesystem::path file = folder_ / (name + ".ref");
  if (std::filesystem::exists(file)) {
    reference::Image image(width, height);
    const std::string reason = load(file, image);
    if (reason.empty()) return image;
    say_(fmt::format("reference {} {}: it is made anew", file.filename().string(), reason));
  }
  reference::Image image = make();
  save(file, image);
  return image;
}

reference::Image ReferenceCache::mapExact(const reference::MapScene& scene) const {
  Hash hash;
  addFrame(hash, scene.camera, scene.lights, scene.medium, scene.width, scene.height);
  hash.number(static_cast<int>(scene.filter));
  hash.array(scene.depth);
  for (const reference::ShadowImage& shadow : scene.shadows) {
    hash.array(shadow.depth);
    hash.array(shadow.glassColour);
    hash.array(shadow.glassDepth);
  }
  return get(fmt::format("map-{:016x}", hash.value()), scene.width, scene.height,
             [&] { return reference::mapExact(scene).inscatter; });
}

reference::Image ReferenceCache::sceneExact(const reference::SceneView& view,
                                            const std::vector<reference::Triangle>& triangles) const {
  Hash hash;
  addFrame(hash, view.camera, view.lights, view.medium, view.width, view.height);
  for (const reference::Triangle& triangle : triangles) {
    hash.number(triangle.glass ? 1 : 0);
    for (const glm::dvec3& value : {triangle.a, triangle.b, triangle.c, triangle.tint})
      hash.bytes(&value, sizeof value);
  }
  return get(fmt::format("scene-{:016x}", hash.value()), view.width, view.height,
             [&] { return reference::SceneExact(triangles).render(view).inscatter; });
}

} // namespace bench
