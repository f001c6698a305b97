#include "Recorder.h"

#include <utility>

namespace {

Ogre::TexturePtr makeOutput(const std::string& name, int width, int height) {
  return Ogre::TextureManager::getSingleton().createManual(
      name + std::to_string(width) + "x" + std::to_string(height), Ogre::RGN_INTERNAL, Ogre::TEX_TYPE_2D,
      static_cast<Ogre::uint>(width), static_cast<Ogre::uint>(height), 0, Ogre::PF_FLOAT32_RGBA);
}

/// FNV-1a.
std::uint64_t hash(const std::vector<std::uint8_t>& bytes) {
  std::uint64_t value = 0xcbf29ce484222325U;
  for (const std::uint8_t byte : bytes)
    value = (value ^ byte) * 0x100000001b3U;
  return value;
}

std::vector<std::uint8_t> bytesOf(const Ogre::TexturePtr& texture) {
  const auto width = texture->getWidth(), height = texture->getHeight();
  std::vector<std::uint8_t> bytes(Ogre::PixelUtil::getMemorySize(width, height, 1, texture->getFormat()));
  texture->getBuffer()->blitToMemory({width, height, 1, texture->getFormat(), bytes.data()});
  return bytes;
}

std::vector<std::uint8_t> bytesOf(Ogre::RenderWindow& window) {
  const auto width = window.getWidth(), height = window.getHeight();
  std::vector<std::uint8_t> bytes(std::size_t{3} * width * height);
  window.copyContentsToMemory(Ogre::Box(0, 0, width, height), {width, height, 1, Ogre::PF_BYTE_RGB, bytes.data()},
                              Ogre::RenderTarget::FB_BACK);
  return bytes;
}

} // namespace

Recorder::Recorder(const std::string& digests, std::string inscatter) : inscatter_(std::move(inscatter)) {
  if (!digests.empty()) digests_.open(digests);
}

void Recorder::wantOutputs(tyndall::Frame& frame, bool colourToo) {
  if (!colourToo) frame.colour = 0;
  if (colourToo && inscatter_.empty()) return;
  const int width = frame.viewport.width, height = frame.viewport.height;
  Outputs& outputs = outputs_[size_ = {width, height}];
  if (!outputs.inscatter)
    outputs = {makeOutput("inscatter", width, height), makeOutput("transmittance", width, height)};
  frame.output.inscatter = outputs.inscatter->getCustomAttribute("GLID");
  frame.output.transmittance = outputs.transmittance->getCustomAttribute("GLID");
}

void Recorder::digest(Ogre::RenderWindow& window, const std::vector<Ogre::CompositorInstance*>& compositors) {
  if (!digests_.is_open()) return;
  digests_ << std::hex;
  for (Ogre::CompositorInstance* compositor : compositors)
    digests_ << hash(bytesOf(compositor->getTextureInstance("scene", 0))) << ' ';
  digests_ << hash(bytesOf(window)) << '\n';
}

void Recorder::writeInscatter() {
  if (inscatter_.empty()) return;
  const std::vector<std::uint8_t> bytes = bytesOf(outputs_.at(size_).inscatter);
  std::ofstream file(inscatter_, std::ios::binary);
  file << size_.first << ' ' << size_.second << '\n';
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}
