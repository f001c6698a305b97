// The sample scenes and their small pictures.
#pragma once

#include <filesystem>
#include <gl/Objects.h>
#include <string>
#include <vector>

namespace viewer {

class Thumbnails {
public:
  struct Sample {
    std::string name;
    std::filesystem::path file;
    host::GlTexture picture; ///< none where there is no picture of it
    float aspect = 1;
  };

  /// Those that were made by the build, with what is in the gallery. Needs the current context.
  void load(const std::filesystem::path& scenes, const std::filesystem::path& gallery);
  const std::vector<Sample>& samples() const { return samples_; }

private:
  std::vector<Sample> samples_;
};

} // namespace viewer
