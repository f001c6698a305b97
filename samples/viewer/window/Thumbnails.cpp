#include "Thumbnails.h"

#include <algorithm>
#include <gl/Gl.h>
#include <memory>
#include <stb_image.h>

namespace viewer {

namespace {

constexpr int kWidth = 96; ///< of a small picture

struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Each pixel is the mean of those that it stands for.
Pixels shrunk(const std::uint8_t* rgb, int width, int height) {
  Pixels small{kWidth, std::max(1, height * kWidth / width), {}};
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < 3 * small.width; ++x) {
      const int column = x / 3, channel = x % 3;
      const int x0 = column * width / small.width, x1 = std::max(x0 + 1, (column + 1) * width / small.width);
      const int y0 = y * height / small.height, y1 = std::max(y0 + 1, (y + 1) * height / small.height);
      int sum = 0;
      for (int v = y0; v < y1; ++v)
        for (int u = x0; u < x1; ++u)
          sum += rgb[3 * (static_cast<std::size_t>(v) * width + u) + channel];
      small.rgb.push_back(static_cast<std::uint8_t>(sum / ((x1 - x0) * (y1 - y0))));
    }
  return small;
}

Pixels read(const std::filesystem::path& file) {
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load(file.string().c_str(), &width, &height, &channels, 3), stbi_image_free);
  return pixels && width >= kWidth ? shrunk(pixels.get(), width, height) : Pixels();
}

host::GlTexture textureOf(const Pixels& pixels) {
  if (pixels.rgb.empty()) return {};
  host::GlTexture texture = host::makeTexture2D(GL_RGB8, pixels.width, pixels.height);
  const GladGLContext& gl = host::gl();
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, pixels.width, pixels.height, GL_RGB, GL_UNSIGNED_BYTE, pixels.rgb.data());
  return texture;
}

} // namespace

void Thumbnails::load(const std::filesystem::path& scenes, const std::filesystem::path& gallery) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (auto entry = std::filesystem::directory_iterator(scenes, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    if (entry->path().extension() == ".glb") files.push_back(entry->path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    const std::string name = file.stem().string();
    const Pixels pixels = read(gallery / (name + ".jpg"));
    const float aspect =
        pixels.rgb.empty() ? 1.0F : static_cast<float>(pixels.width) / static_cast<float>(pixels.height);
    samples_.push_back({name, file, textureOf(pixels), aspect});
  }
}

} // namespace viewer
