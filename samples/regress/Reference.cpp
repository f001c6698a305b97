#include "Reference.h"

#include "Digest.h"
#include "Json.h"

#include <fmt/format.h>
#include <scene/Error.h>
#include <scene/FileIo.h>

namespace regress {

namespace {

std::string digestOfFile(const std::filesystem::path& file) {
  Digest digest;
  digest.addFile(file);
  return digest.text();
}

Reference fromSidecar(const Json& json, const std::string& where) {
  requireFormat(json, where);
  try {
    return {{json.at("size").at(0), json.at("size").at(1), {}},
            {json.at("driver"), json.at("context"), json.at("commit")},
            json.at("options")};
  } catch (const Json::exception& error) {
    throw host::Error(fmt::format("{}: {}", where, error.what()));
  }
}

} // namespace

bool References::exists(const std::string& name) const {
  const auto isThere = [](const std::filesystem::path& file) {
    return std::filesystem::symlink_status(file).type() != std::filesystem::file_type::not_found;
  };
  return isThere(pictureFile(name)) || isThere(sidecarFile(name));
}

Reference References::read(const Case& one) const {
  const std::filesystem::path picture = pictureFile(one.name), sidecar = sidecarFile(one.name);
  const std::string where = host::printable(sidecar.string());
  if (!exists(one.name)) throw host::Error(picture.string() + ": there is no reference; record makes it");
  for (const auto& [there, missing] : {std::pair(picture, sidecar), {sidecar, picture}})
    if (!std::filesystem::exists(missing))
      throw host::Error(fmt::format("{}: is half a reference, {} is missing; record --force makes it anew",
                                    there.string(), missing.filename().string()));
  const Json json = readJson(sidecar);
  Reference reference = fromSidecar(json, where);
  if (json.value("digest", "") != digestOfFile(picture))
    throw host::Error(fmt::format("{}: is damaged or half a reference: it is not the picture that {} tells of; record "
                                  "--force makes it anew",
                                  picture.string(), sidecar.filename().string()));
  const int width = render::renderedWidth(one.options), height = render::renderedHeight(one.options);
  reference.picture = readHdr(picture);
  if (reference.picture.width != width || reference.picture.height != height)
    throw host::Error(fmt::format("{}: is of {}x{} pixels, the case of {}x{}; record --force makes it anew",
                                  picture.string(), reference.picture.width, reference.picture.height, width, height));
  return reference;
}

void References::write(const Case& one, const HdrPicture& picture, const Origin& origin) const {
  writeHdr(pictureFile(one.name), picture);
  writeJson(sidecarFile(one.name), {{"format", kFormat},
                                    {"tool", "tyndall-regress " TYNDALL_VERSION},
                                    {"case", one.name},
                                    {"size", {picture.width, picture.height}},
                                    {"options", one.words},
                                    {"driver", origin.driver},
                                    {"context", origin.context},
                                    {"commit", origin.commit},
                                    {"digest", digestOfFile(pictureFile(one.name))}});
}

std::uint64_t References::digestOf(const std::string& name) const {
  Digest digest;
  digest.addFile(pictureFile(name));
  digest.addFile(sidecarFile(name));
  return digest.value();
}

} // namespace regress
