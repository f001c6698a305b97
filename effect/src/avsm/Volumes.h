// Fog and smoke that stand in boxes and spheres, on their way into lists or curves (glsl/passes/avsmVolumes.comp), and
// where their grids are empty (glsl/passes/avsmRanges.comp).
#pragma once

#include "avsm/Particles.h"
#include "gl/Objects.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <tyndall/avsm.h>
#include <vector>

namespace tyndall::avsm {

inline constexpr std::size_t kMaxVolumes = 8;
inline constexpr int kVolumeUnits = 2; ///< of textures: density and ranges

using Groups = std::array<gl::Uint, 3>; ///< work groups of a dispatch

/// What passes/avsmVolumes.comp is given of a volume and a view, as the shader has it (std140).
struct VolumeBlock {
  using Integers = std::array<std::int32_t, 4>;
  ParticleView view;
  std::array<ParticleView::Row, 3> volumeFromWorld;
  Integers texels, gridSize, brickCount;
  ParticleView::Row shape;
};

class Volumes {
public:
  explicit Volumes(const gl::Functions& gl) : gl_(gl) {}

  void makeObjects();

  /// Forgets ranges of grids that no call of the last 8 frames has named.
  void beginFrame();

  /// Every rule of the arguments of Avsm::drawVolumes. Binds to GL_TEXTURE_3D.
  Status check(const Light& light, const std::vector<AvsmVolume>& volumes, int layers);

  /// Plans what is seen in a map of `size` texels a side, of volumes that have passed check(), and makes room for the
  /// ranges of grids that it does not know. Binds to GL_TEXTURE_3D and the generic uniform buffer.
  Status prepare(const Light& light, const std::vector<AvsmVolume>& volumes, int size);

  /// Runs passes/avsmRanges.comp over each level of ranges that is not as its grid is, from the finest on.
  void makeRanges(const std::function<void(int level, const Groups& groups)>& run);

  /// Runs passes/avsmVolumes.comp for each volume and view that sees it.
  void draw(const std::function<void(const Groups& groups)>& run) const;

private:
  struct Grid {
    std::array<int, 3> size{}; ///< texels; 0: none
    gl::Int format = 0;
  };
  struct Ranges {
    gl::Uint density = 0;
    std::uint64_t version = 0;
    Grid grid;
    gl::Texture texture;
    bool isMade = false;
    int age = 0;          ///< frames since it was named last
    bool isNamed = false; ///< by the last call
  };
  struct Draw {
    VolumeBlock block;
    gl::Uint density = 0;
    const Ranges* ranges = nullptr;
    Groups groups{};
  };

  Status checkVolume(const std::string& field, const AvsmVolume& volume, Grid& grid) const;
  Status checkDensity(const std::string& field, gl::Uint name, Grid& grid) const;
  Status makeRoom(const AvsmVolume& volume, const Grid& grid, Ranges*& ranges);
  void plan(const Light& light, const AvsmVolume& volume, const Grid& grid, const Ranges* ranges, int size);

  const gl::Functions& gl_;
  gl::Buffer block_;
  gl::Sampler sampler_;
  std::vector<Grid> grids_;                     // of the volumes that were checked last
  std::vector<std::unique_ptr<Ranges>> ranges_; // of grids that calls have named lately
  std::vector<Draw> draws_;
};

/// Gives back GL_TEXTURE_3D of the units that volumes use, or leaves it empty: gl::StateGuard does all else.
class GridGuard {
public:
  GridGuard(const gl::Functions& gl, StateMode mode);
  ~GridGuard();
  GridGuard(const GridGuard&) = delete;
  GridGuard& operator=(const GridGuard&) = delete;

private:
  const gl::Functions& gl_;
  std::array<gl::Int, kVolumeUnits> textures_{};
};

} // namespace tyndall::avsm
