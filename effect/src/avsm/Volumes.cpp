#include "avsm/Volumes.h"

#include "CheckValues.h"
#include "InspectTexture.h"
#include "Rounding.h"
#include "avsm/CheckAvsm.h"
#include "gl/Enums.h"
#include "gl/OwnErrors.h"
#include "optics/Matrices.h"

#include <algorithm>
#include <cmath>

namespace tyndall::avsm {

namespace {

constexpr int kBrick = 4;      // texels of a grid, by axis, whose range is known
constexpr int kTexelGroup = 8; // texels of the map across and up a work group,
constexpr int kKeptFrames = 8; // that ranges live for without being named
constexpr int kNodeGroup = 4;  // nodes of a level of ranges by axis

int powerOfTwoFrom(int least) {
  int power = 1;
  while (power < least)
    power *= 2;
  return power;
}

// Of the finest level of ranges: bricks, which need be no power of two, and nodes, which are.
int bricksOf(int texels) { return unitsFor(texels, kBrick); }
int nodesOf(int texels) { return powerOfTwoFrom(bricksOf(texels)); }

int levelsOf(const std::array<int, 3>& size) {
  int levels = 1;
  for (int nodes = nodesOf(*std::max_element(size.begin(), size.end())); nodes > 1; nodes /= 2)
    ++levels;
  return levels;
}

struct Texels {
  int x = 0, y = 0, endX = 0, endY = 0;
  bool any() const { return endX > x && endY > y; }
};

// The texels of a view that a volume's cube may be seen in; none where all of it lies behind the far plane, or no
// deeper than where light begins.
Texels texelsOf(const Light& light, int view, const glm::dmat4& worldFromVolume, int size, double behindLight) {
  const glm::dmat4 clipFromWorld = optics::toGlm(light.shadow.views[static_cast<std::size_t>(view)].clipFromWorld);
  const glm::dvec4 depth = optics::linearDepth(light, view).coefficients;
  glm::dvec2 low(kInfinity), high(-kInfinity);
  double nearest = kInfinity, farthest = -kInfinity;
  int before = 0, behind = 0; // the light, one or the other
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 world =
        worldFromVolume * glm::dvec4(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1, 1);
    const glm::dvec4 clip = clipFromWorld * world;
    nearest = std::min(nearest, glm::dot(depth, world));
    farthest = std::max(farthest, glm::dot(depth, world));
    clip.w > 0 ? ++before : ++behind;
    const glm::dvec2 place = glm::dvec2(clip) / clip.w;
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  if (nearest > 1 || farthest <= behindLight) return {};
  if (before > 0 && behind > 0) return {0, 0, size, size};
  // A texel more to each side, for what rounding does to rays.
  const auto texel = [&](double place, int more) {
    return static_cast<int>(std::clamp(std::floor((0.5 * place + 0.5) * size) + more, 0.0, static_cast<double>(size)));
  };
  return {texel(low.x, -1), texel(low.y, -1), texel(high.x, 2), texel(high.y, 2)};
}

} // namespace

void Volumes::makeObjects() {
  block_ = gl::Buffer(gl_);
  gl_.BindBuffer(gl::UNIFORM_BUFFER, block_.name());
  gl_.BufferData(gl::UNIFORM_BUFFER, sizeof(VolumeBlock), nullptr, gl::DYNAMIC_DRAW);
  sampler_ = gl::Sampler(gl_);
  gl_.SamplerParameteri(sampler_.name(), gl::TEXTURE_MIN_FILTER, gl::NEAREST);
  gl_.SamplerParameteri(sampler_.name(), gl::TEXTURE_MAG_FILTER, gl::NEAREST);
}

// ---------------------------------------------------------------------------------------------------------------------

Status Volumes::check(const Light& light, const std::vector<AvsmVolume>& volumes, int layers) {
  if (Status s = checkViews(light, layers); !s) return s;
  if (volumes.size() > kMaxVolumes)
    return refuse("volumes", std::to_string(volumes.size()) + " long", "at most 8 are allowed");
  grids_.assign(volumes.size(), {});
  for (std::size_t i = 0; i < volumes.size(); ++i)
    if (Status s = checkVolume("volumes[" + std::to_string(i) + "].", volumes[i], grids_[i]); !s) return s;
  return {};
}

Status Volumes::checkVolume(const std::string& field, const AvsmVolume& volume, Grid& grid) const {
  if (volume.shape < AvsmVolume::Shape::Box || volume.shape > AvsmVolume::Shape::Sphere)
    return refuse(field + "shape", std::to_string(static_cast<int>(volume.shape)), "must be one of the enumerators");
  const Mat4& m = volume.worldFromVolume;
  if (!isFinite(m)) return refuse(field + "worldFromVolume", "not finite", "every element must be a finite number");
  if (!optics::isInvertible(optics::toGlm(m)))
    return refuse(field + "worldFromVolume", "singular", "the matrix must be invertible");
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
    return refuse(field + "worldFromVolume", "not affine", "its last row must be (0, 0, 0, 1)");
  if (!(volume.extinction >= 0) || !(volume.extinction <= 1e30))
    return refuse(field + "extinction", text(volume.extinction), "must be 0 to 1e30");
  if (!(volume.fade >= 0 && volume.fade <= 1)) return refuse(field + "fade", text(volume.fade), "must be 0 to 1");
  return volume.density == 0 ? Status{} : checkDensity(field + "density", volume.density, grid);
}

Status Volumes::checkDensity(const std::string& field, gl::Uint name, Grid& grid) const {
  const std::string value = "texture " + std::to_string(name);
  if (!gl_.IsTexture(name))
    return refuse(field, value, "not the name of a texture in this context (deleted, or never bound?)");
  if (!bindIfOf(gl_, name, gl::TEXTURE_3D)) return refuse(field, value, "must be a GL_TEXTURE_3D");
  const gl::Enum extents[] = {gl::TEXTURE_WIDTH, gl::TEXTURE_HEIGHT, gl::TEXTURE_DEPTH};
  for (std::size_t axis = 0; axis < 3; ++axis)
    gl_.GetTexLevelParameteriv(gl::TEXTURE_3D, 0, extents[axis], &grid.size[axis]);
  gl_.GetTexLevelParameteriv(gl::TEXTURE_3D, 0, gl::TEXTURE_INTERNAL_FORMAT, &grid.format);
  if (grid.size[0] < 1) return refuse(field, value, "has no level 0");
  if (!isOneChannel(grid.format)) return refuse(field, value, "must have the format R8, R16, R16F or R32F");
  gl::Int base = 0, swizzle = 0;
  gl_.GetTexParameteriv(gl::TEXTURE_3D, gl::TEXTURE_BASE_LEVEL, &base);
  if (base != 0) return refuse(field, value, "GL_TEXTURE_BASE_LEVEL must be 0");
  gl_.GetTexParameteriv(gl::TEXTURE_3D, gl::TEXTURE_SWIZZLE_R, &swizzle);
  if (static_cast<gl::Enum>(swizzle) != gl::RED) return refuse(field, value, "GL_TEXTURE_SWIZZLE_R must be GL_RED");
  return {};
}

// ---------------------------------------------------------------------------------------------------------------------

Status Volumes::prepare(const Light& light, const std::vector<AvsmVolume>& volumes, int size) {
  draws_.clear();
  for (const std::unique_ptr<Ranges>& ranges : ranges_)
    ranges->isNamed = false;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    Ranges* ranges = nullptr;
    if (volumes[i].density != 0)
      if (Status s = makeRoom(volumes[i], grids_[i], ranges); !s) return s;
    if (volumes[i].extinction > 0) plan(light, volumes[i], grids_[i], ranges, size);
  }
  return {};
}

void Volumes::beginFrame() {
  for (const std::unique_ptr<Ranges>& ranges : ranges_)
    ++ranges->age;
  ranges_.erase(std::remove_if(ranges_.begin(), ranges_.end(), [](const auto& r) { return r->age > kKeptFrames; }),
                ranges_.end());
}

Status Volumes::makeRoom(const AvsmVolume& volume, const Grid& grid, Ranges*& ranges) {
  const auto known = std::find_if(ranges_.begin(), ranges_.end(), [&](const std::unique_ptr<Ranges>& r) {
    return r->density == volume.density && r->grid.size == grid.size && r->grid.format == grid.format;
  });
  if (known != ranges_.end()) {
    ranges = known->get();
    const bool isSame = volume.version == ranges->version && (volume.version != 0 || ranges->isNamed);
    ranges->isMade = ranges->isMade && isSame;
    ranges->version = volume.version;
    ranges->age = 0;
    ranges->isNamed = true;
    return {};
  }
  auto made = std::make_unique<Ranges>();
  made->density = volume.density;
  made->version = volume.version;
  made->grid = grid;
  made->isNamed = true;
  made->texture = gl::Texture(gl_);
  gl::OwnErrors errors(gl_);
  gl_.BindTexture(gl::TEXTURE_3D, made->texture.name());
  gl_.TexStorage3D(gl::TEXTURE_3D, levelsOf(grid.size), gl::RG32F, nodesOf(grid.size[0]), nodesOf(grid.size[1]),
                   nodesOf(grid.size[2]));
  if (errors.take() != gl::NO_ERROR)
    return {StatusCode::OutOfMemory, "GL could not allocate the ranges of a density of " +
                                         std::to_string(grid.size[0]) + " x " + std::to_string(grid.size[1]) + " x " +
                                         std::to_string(grid.size[2]) + " texels"};
  for (const gl::Enum filter : {gl::TEXTURE_MIN_FILTER, gl::TEXTURE_MAG_FILTER})
    gl_.TexParameteri(gl::TEXTURE_3D, filter,
                      filter == gl::TEXTURE_MIN_FILTER ? gl::NEAREST_MIPMAP_NEAREST : gl::NEAREST);
  ranges = made.get();
  ranges_.push_back(std::move(made));
  return {};
}

void Volumes::plan(const Light& light, const AvsmVolume& volume, const Grid& grid, const Ranges* ranges, int size) {
  const glm::dmat4 worldFromVolume = optics::toGlm(volume.worldFromVolume);
  const glm::dmat3 rows = glm::transpose(glm::inverse(glm::dmat3(worldFromVolume)));
  const Vec3 centre = vec3(glm::dvec3(worldFromVolume[3]));
  const ParticlesBlock views = particlesBlock(light, centre, size);
  VolumeBlock block{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    block.volumeFromWorld[i] = rowOf({rows[axis], 0});
    block.gridSize[i] = grid.size[i];
    block.brickCount[i] = bricksOf(grid.size[i]);
  }
  block.gridSize[3] = ranges ? levelsOf(grid.size) : 0;
  block.shape = {volume.shape == AvsmVolume::Shape::Sphere ? 1.0F : 0.0F, static_cast<float>(volume.fade),
                 static_cast<float>(volume.extinction), 0};
  for (int view = 0; view < static_cast<int>(light.shadow.views.size()); ++view) {
    block.view = views[static_cast<std::size_t>(view)];
    const Texels texels = texelsOf(light, view, worldFromVolume, size, static_cast<double>(block.view.behindLight[0]));
    if (!texels.any()) continue;
    block.texels = {texels.x, texels.y, texels.endX, texels.endY};
    block.brickCount[3] = view;
    const auto groups = [](int count) { return static_cast<gl::Uint>(unitsFor(count, kTexelGroup)); };
    draws_.push_back(
        {block, volume.density, ranges, {groups(texels.endX - texels.x), groups(texels.endY - texels.y), 1}});
  }
}

void Volumes::makeRanges(const std::function<void(int level, const Groups& groups)>& run) {
  for (const std::unique_ptr<Ranges>& ranges : ranges_) {
    if (ranges->isMade || !ranges->isNamed) continue;
    const int levels = levelsOf(ranges->grid.size);
    for (int level = 0; level < levels; ++level) {
      gl_.ActiveTexture(gl::TEXTURE0);
      gl_.BindTexture(gl::TEXTURE_3D, level == 0 ? ranges->density : ranges->texture.name());
      gl_.BindSampler(0, level == 0 ? sampler_.name() : 0);
      gl_.BindImageTexture(0, ranges->texture.name(), level, 1, 0, gl::WRITE_ONLY, gl::RG32F);
      Groups groups{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        groups[axis] =
            static_cast<gl::Uint>(unitsFor(std::max(nodesOf(ranges->grid.size[axis]) >> level, 1), kNodeGroup));
      run(level, groups);
    }
    ranges->isMade = true;
  }
}

void Volumes::draw(const std::function<void(const Groups& groups)>& run) const {
  gl_.BindSampler(0, sampler_.name());
  gl_.BindSampler(1, 0);
  gl_.BindBufferBase(gl::UNIFORM_BUFFER, 0, block_.name());
  for (const Draw& draw : draws_) {
    gl_.BufferSubData(gl::UNIFORM_BUFFER, 0, sizeof draw.block, &draw.block);
    gl_.ActiveTexture(gl::TEXTURE0 + 1);
    gl_.BindTexture(gl::TEXTURE_3D, draw.ranges ? draw.ranges->texture.name() : 0);
    gl_.ActiveTexture(gl::TEXTURE0);
    gl_.BindTexture(gl::TEXTURE_3D, draw.density);
    run(draw.groups);
  }
}

// ---------------------------------------------------------------------------------------------------------------------

GridGuard::GridGuard(const gl::Functions& gl, StateMode mode) : gl_(gl) {
  for (int unit = kVolumeUnits - 1; unit >= 0; --unit) {
    gl.ActiveTexture(gl::TEXTURE0 + static_cast<gl::Enum>(unit));
    if (mode == StateMode::Restore) gl.GetIntegerv(gl::TEXTURE_BINDING_3D, &textures_[static_cast<std::size_t>(unit)]);
  }
}

GridGuard::~GridGuard() {
  for (int unit = kVolumeUnits - 1; unit >= 0; --unit) {
    gl_.ActiveTexture(gl::TEXTURE0 + static_cast<gl::Enum>(unit));
    gl_.BindTexture(gl::TEXTURE_3D, static_cast<gl::Uint>(textures_[static_cast<std::size_t>(unit)]));
  }
}

} // namespace tyndall::avsm
