#include "scene/Places.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

namespace host {

namespace {

std::string firstLineOf(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"),
                                                             pclose); // NOLINT(cert-env33-c)
  std::array<char, 256> line{};
  if (!pipe || !std::fgets(line.data(), static_cast<int>(line.size()), pipe.get())) return {};
  const std::string text = line.data();
  return text.substr(0, text.find('\n'));
}

} // namespace

std::filesystem::path placeOf(const std::string& inBundle, const std::filesystem::path& inBuild) {
  const char* bundle = std::getenv(kBundleVariable);
  return bundle && *bundle ? std::filesystem::path(bundle) / inBundle : inBuild;
}

std::string commitOf(const std::filesystem::path& sources) {
  std::string commit;
  if (const char* bundle = std::getenv(kBundleVariable); bundle && *bundle)
    std::getline(std::ifstream(std::filesystem::path(bundle) / "commit") >> std::ws, commit);
  else
    commit = firstLineOf("git -C '" + sources.string() + "' describe --always --dirty --abbrev=12 2>/dev/null");
  return commit.empty() ? "unknown" : commit;
}

} // namespace host
