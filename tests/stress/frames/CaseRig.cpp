#include "CaseRig.h"

#include "gl/ReadBack.h"

#include <cmath>
#include <stdexcept>

using namespace tyndall;
using host::gl;

namespace stress {

namespace {

constexpr float kPoison = 12345; // of texels outside the viewport, which nothing may write

GLenum formatOf(DepthForm form) {
  constexpr GLenum kFormats[] = {GL_R32F, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT16};
  return kFormats[static_cast<int>(form)];
}

std::size_t countOf(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

} // namespace

CaseRig::CaseRig(const Case& made, Effect& effect) : frame(made.frame), made_(made), effect_(effect) {
  const Rectangle& viewport = frame.viewport;
  width_ = viewport.x + viewport.width + made.margin.x;
  height_ = viewport.y + viewport.height + made.margin.y;
  inscatter_ = host::makeTexture2D(GL_RGBA32F, width_, height_);
  transmittance_ = host::makeTexture2D(GL_RGBA32F, width_, height_);
  frame.output = {inscatter_.name(), transmittance_.name()};
  scene_.camera = frame.camera;
  scene_.medium = frame.medium;
  scene_.ambient = frame.ambient;
  scene_.filter = frame.settings.shadowFilter;
  scene_.width = viewport.width;
  scene_.height = viewport.height;
  uploadDepth(made.depth, made.depthForm);
  if (made.lookup.z > 0)
    lookup_.emplace(made.lookup.x, made.lookup.y, made.lookup.z,
                    tests::ShaftsLookup::Range{made.lookupNear, made.lookupFar});
  uploadEyeCurves();
  maps_.reserve(made.maps.size());
  scene_.lights = frame.lights;
  for (std::size_t i = 0; i < made.maps.size(); ++i)
    uploadMaps(i);
}

void CaseRig::uploadDepth(const std::vector<float>& depth, DepthForm form) {
  const Rectangle& viewport = frame.viewport;
  std::vector<float> all(countOf(width_, height_), 0.37F);
  for (int y = 0; y < viewport.height; ++y)
    for (int x = 0; x < viewport.width; ++x)
      all[countOf(width_, viewport.y + y) + static_cast<std::size_t>(viewport.x + x)] =
          depth[countOf(viewport.width, y) + static_cast<std::size_t>(x)];
  depth_ = tests::floatTexture(formatOf(form), width_, height_, all);
  frame.depth.texture = depth_.name();
  scene_.depth = depth;
  if (form == DepthForm::Float) return;
  all = host::readDepth(depth_.name(), width_, height_);
  for (int y = 0; y < viewport.height; ++y)
    for (int x = 0; x < viewport.width; ++x)
      scene_.depth[countOf(viewport.width, y) + static_cast<std::size_t>(x)] =
          all[countOf(width_, viewport.y + y) + static_cast<std::size_t>(viewport.x + x)];
}

void CaseRig::setDepth(const std::vector<float>& depth) { uploadDepth(depth, DepthForm::Float); }

void CaseRig::uploadMaps(std::size_t light) {
  const LightMaps& maps = made_.maps[light];
  scene_.shadows.push_back(maps.image);
  if (maps.image.width == 0) return;
  maps_.emplace_back(maps.image, maps.layout, kPoison, maps.format);
  ShadowMap& shadow = frame.lights[light].shadow;
  maps_.back().enter(frame.lights[light]);
  if (maps.isCompared) {
    const GLenum target = maps.layout == tests::Layout::Atlas ? GL_TEXTURE_2D : GL_TEXTURE_2D_ARRAY;
    gl().BindTexture(target, shadow.texture);
    gl().TexParameteri(target, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  }
  if (maps.format != GL_DEPTH_COMPONENT24 && maps.format != GL_DEPTH_COMPONENT16) return;
  const auto readBack = [&](GLuint texture, std::vector<float>& values) {
    values.clear();
    for (int layer = 0; layer < maps.image.layers; ++layer) {
      const std::vector<float> one = host::readDepthArray(texture, maps.image.width, maps.image.height, layer);
      values.insert(values.end(), one.begin(), one.end());
    }
  };
  readBack(shadow.texture, scene_.shadows.back().depth);
  if (!maps.image.glassDepth.empty()) readBack(frame.lights[light].glass.depth, scene_.shadows.back().glassDepth);
}

void CaseRig::uploadEyeCurves() {
  const reference::CurveMap& map = made_.eyeCurves;
  const EyeCurves& eye = frame.eyeCurves;
  scene_.eyeCurves = {map, eye.nearDistance, eye.farDistance, {eye.albedo, eye.phase, eye.g}, eye.dimsBackground};
  if (map.size == 0) return;
  std::vector<GLuint> texels;
  for (const std::vector<glm::dvec2>& curve : map.curves)
    for (const glm::dvec2& node : curve) {
      const glm::uvec2 bits(glm::round(node * 65535.0));
      texels.push_back(bits.x << 16U | bits.y);
    }
  eyeCurves_ = host::makeTextureArray(GL_RGBA32UI, map.size, map.size, 1);
  gl().TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, map.size, map.size, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                     texels.data());
  frame.eyeCurves.curves = {eyeCurves_.name(), 4, true, 0};
}

// From layer to layer light becomes more, and what is left of it less.
std::string CaseRig::faultOfLookup() const {
  constexpr double kRounding = 1e-4;
  reference::Image last;
  std::vector<double> left;
  for (int layer = 0; layer < made_.lookup.z; ++layer) {
    const reference::Image light = lookup_->light(layer), passed = lookup_->passed(layer);
    for (std::size_t i = 0; i < light.rgb.size(); ++i) {
      const auto is = [&](const char* what) { return std::string(what) + " in layer " + std::to_string(layer); };
      if (!(std::isfinite(light.rgb[i]) && light.rgb[i] >= 0)) return is("no light");
      if (!(passed.rgb[i] >= 0 && passed.rgb[i] <= 1)) return is("no transmittance");
      if (layer == 0) continue;
      if (light.rgb[i] < (1 - kRounding) * last.rgb[i]) return is("less light");
      if (passed.rgb[i] > left[i] + kRounding) return is("more transmittance");
    }
    last = light;
    left = passed.rgb;
  }
  return {};
}

Picture CaseRig::render(const Settings& settings) {
  const std::vector<float> poison(4 * countOf(width_, height_), kPoison);
  for (const host::GlTexture* output : {&inscatter_, &transmittance_}) {
    gl().BindTexture(GL_TEXTURE_2D, output->name());
    gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_FLOAT, poison.data());
  }
  frame.settings = settings;
  frame.lookup = {};
  const bool looksUp = lookup_ && settings.technique != Technique::Exact;
  if (looksUp) lookup_->enter(frame);
  if (const Status status = effect_.render(frame); !status) throw std::runtime_error(status.message);
  Picture picture;
  const Rectangle& viewport = frame.viewport;
  const auto read = [&](const host::GlTexture& texture) {
    const std::vector<float> all = host::readColour(texture.name(), width_, height_, 3);
    reference::Image image(viewport.width, viewport.height);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const float* texel = &all[3 * (countOf(width_, y) + static_cast<std::size_t>(x))];
        const int column = x - viewport.x, row = y - viewport.y;
        const bool isInside = column >= 0 && row >= 0 && column < viewport.width && row < viewport.height;
        if (isInside)
          image.set(column, row, {texel[0], texel[1], texel[2]});
        else if (!(texel[0] == kPoison && texel[1] == kPoison && texel[2] == kPoison))
          picture.isWithinViewport = false;
      }
    return image;
  };
  picture.inscatter = read(inscatter_);
  picture.transmittance = read(transmittance_);
  if (looksUp) picture.lookupFault = faultOfLookup();
  return picture;
}

} // namespace stress
