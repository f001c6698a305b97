#include "Engine.h"

#include "Hash.h"
#include "gl/ReadBack.h"

#include <utility>

using namespace tyndall;
using host::gl;

namespace stress {

namespace {

GLenum orElse(Format format, GLenum other) { return format != 0 ? format : other; }

// The key of what boxes look like.
Hash keyOf(const std::vector<glm::dmat4>& cubes) {
  Hash hash;
  for (const glm::dmat4& cube : cubes)
    hash.add(fromGlm(cube));
  return hash;
}

constexpr float kPattern = 0.25F;

} // namespace

const Frame& Engine::show(const ScriptState& state) {
  state_ = state;
  if (state.renew) {
    for (Sheet* sheet : {&depth_, &colour_, &inscatter_, &transmittance_})
      *sheet = {};
    lights_.clear();
    ++renewals_;
  }
  frame_ = {};
  frame_.viewport = {state.left, state.bottom, state.width, state.height};
  frame_.camera = cameraOf(state.cameras[static_cast<std::size_t>(state.eye)], state.jitter, state.width, state.height);
  frame_.medium = state.medium;
  frame_.settings = state.settings;
  if (renewals_ % 2 == 1) makeTargets(); // with the names that other textures had
  showDepth();
  for (const LightState& light : state.lights)
    showLight(light);
  makeTargets();
  fillMeshes();
  tellReuse();
  tellFacts();
  return frame_;
}

void Engine::makeTargets() {
  const int width = state_.left + state_.width + state_.right, height = state_.bottom + state_.height + state_.top;
  const auto make = [&](bool wanted, Sheet& sheet, Format format, std::vector<float>& empty) {
    empty.clear();
    if (!wanted) return 0U;
    sheet.makeFor({orElse(format, GL_RGBA32F), width, height});
    for (int i = 0; i < width * height; ++i)
      for (const float value : {1.0F, 2.0F, 4.0F, 1.0F})
        empty.push_back(value * kPattern * static_cast<float>(1 + i % 3));
    return sheet.name();
  };
  frame_.colour = make(state_.colour, colour_, state_.colourFormat, empty_[0]);
  frame_.output.inscatter = make(state_.inscatter, inscatter_, state_.outputFormat, empty_[1]);
  frame_.output.transmittance = make(state_.transmittance, transmittance_, state_.outputFormat, empty_[2]);
}

void Engine::fillTargets() {
  const std::array<Sheet*, 3> sheets = {&colour_, &inscatter_, &transmittance_};
  for (std::size_t i = 0; i < 3; ++i) {
    if (empty_[i].empty()) continue;
    std::vector<float> values = empty_[i];
    if (sheets[i]->form().format == GL_R11F_G11F_B10F) { // no alpha
      values.clear();
      for (std::size_t k = 0; k < empty_[i].size(); ++k)
        if (k % 4 != 3) values.push_back(empty_[i][k]);
    }
    sheets[i]->write(values);
  }
}

Contents Engine::readTargets() const {
  Contents contents;
  const std::array<const Sheet*, 3> sheets = {&colour_, &inscatter_, &transmittance_};
  for (std::size_t i = 0; i < 3; ++i)
    if (!empty_[i].empty())
      contents[i] = host::readColour(sheets[i]->name(), sheets[i]->form().width, sheets[i]->form().height);
  return contents;
}

void Engine::showDepth() {
  const CameraState& camera = state_.cameras[static_cast<std::size_t>(state_.eye)];
  Rectangle at = frame_.viewport;
  SheetForm form{orElse(state_.depthFormat, GL_R32F), state_.left + state_.width + state_.right,
                 state_.bottom + state_.height + state_.top};
  const int scale = state_.depthLayout == DepthLayout::Double ? 2 : 1;
  if (state_.depthLayout == DepthLayout::Rectangle) at = {5, 3, state_.width, state_.height};
  if (scale > 1) at = {0, 0, scale * state_.width, scale * state_.height};
  if (state_.depthLayout == DepthLayout::Rectangle || scale > 1) {
    form.width = at.x + at.width;
    form.height = at.y + at.height;
    frame_.depth.rectangle = at;
  }
  if (state_.depthLayout == DepthLayout::Layer) form.layers = 2;
  frame_.depth.layer = form.layers > 0 ? 1 : -1;
  const Mat4 clipFromWorld = fromGlm(toGlm(frame_.camera.clipFromView) * toGlm(frame_.camera.viewFromWorld));
  const std::vector<glm::dmat4> cubes = cubesOf(state_);
  const std::uint64_t key =
      keyOf(cubes).add(clipFromWorld).add(std::array<int, 4>{at.x, at.y, at.width, at.height}).add(form.format).value();
  depth_.show(form, key, [&] {
    const auto texels = static_cast<std::size_t>(form.width * form.height);
    std::vector<float> image(texels, 0.5F);
    place(image, form.width, at.x, at.y,
          castDepth(cubes, clipFromWorld, frame_.camera.clipDepth, camera.reversed, at.width, at.height), at.width);
    if (form.layers == 0) return image;
    std::vector<float> layers(texels, 0.25F);
    layers.insert(layers.end(), image.begin(), image.end());
    return layers;
  });
  frame_.depth.texture = depth_.name();
}

namespace {

struct MapPlaces {
  SheetForm form;
  std::vector<Rectangle> rectangles; // of views; empty: whole layers
  std::vector<int> layers;
};

MapPlaces placesOf(const LightState& light, int views) {
  const int size = light.mapSize;
  MapPlaces places{{orElse(light.format, GL_DEPTH_COMPONENT32F), size, size}, {}, {}};
  if (light.layout == MapLayout::Layers) places.form.layers = views + 1;
  if (light.layout == MapLayout::Atlas) {
    places.form.width = size * views;
    places.form.height = size + 2;
  }
  for (int view = 0; view < views; ++view) {
    places.layers.push_back(light.layout == MapLayout::Layers ? views - view : 0);
    if (light.layout == MapLayout::Atlas) places.rectangles.push_back({size * (views - 1 - view), 1, size, size});
  }
  return places;
}

// The images of all views in one texture.
std::vector<float> laid(const MapPlaces& places, const std::vector<std::vector<float>>& images, int size,
                        int channels = 1) {
  const auto layer = static_cast<std::size_t>(places.form.width * places.form.height * channels);
  std::vector<float> all(layer * static_cast<std::size_t>(std::max(places.form.layers, 1)), 0.75F);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Rectangle at = places.rectangles.empty() ? Rectangle{} : places.rectangles[i];
    place(all, places.form.width, at.x, at.y + places.layers[i] * places.form.height, images[i], size, channels);
  }
  return all;
}

} // namespace

void Engine::showLight(const LightState& state) {
  Light light = lightOf(state);
  if (state.hasMap) {
    LightSheets& sheets = lights_[state.id];
    const MapPlaces places = placesOf(state, static_cast<int>(light.shadow.views.size()));
    const std::vector<glm::dmat4> cubes = cubesOf(state_);
    Hash key = keyOf(cubes);
    key.add(places.form.format).add(state.layout);
    for (const ShadowView& view : light.shadow.views)
      key.add(view.clipFromWorld);
    sheets.depth.show(places.form, key.value(), [&] {
      std::vector<std::vector<float>> images;
      for (const ShadowView& view : light.shadow.views)
        images.push_back(
            castDepth(cubes, view.clipFromWorld, ClipDepth::NegativeOneToOne, false, state.mapSize, state.mapSize));
      return laid(places, images, state.mapSize);
    });
    for (std::size_t i = 0; i < light.shadow.views.size(); ++i) {
      light.shadow.views[i].layer = places.layers[i];
      if (!places.rectangles.empty()) light.shadow.views[i].rectangle = places.rectangles[i];
    }
    light.shadow.texture = sheets.depth.name();
    light.shadow.array = places.form.layers > 0;
    if (state.glass) showGlass(state, light, sheets);
  }
  frame_.lights.push_back(light);
}

void Engine::showGlass(const LightState& state, Light& light, LightSheets& sheets) {
  MapPlaces places = placesOf(state, static_cast<int>(light.shadow.views.size()));
  Hash key;
  key.add(state.layout).add(places.form.format);
  std::vector<std::vector<float>> depths, colours;
  for (const ShadowView& view : light.shadow.views) {
    key.add(view.clipFromWorld);
    GlassImage image = castGlass(view.clipFromWorld, state.mapSize);
    depths.push_back(std::move(image.depth));
    colours.push_back(std::move(image.colour));
  }
  sheets.glassDepth.show(places.form, key.value(), [&] { return laid(places, depths, state.mapSize); });
  places.form.format = GL_RGB32F;
  sheets.glassColour.show(places.form, key.value(), [&] { return laid(places, colours, state.mapSize, 3); });
  light.glass = {sheets.glassColour.name(), sheets.glassDepth.name()};
}

// The cube of a mesh's shape, among other things: from byte 8 on, a position every 20.
void Engine::fillMeshes() {
  for (std::size_t i = 0; i < meshes_.size(); ++i) {
    const MoverState& mover = state_.movers[i];
    MeshBuffer& mesh = meshes_[i];
    if (!mover.mesh || (mesh.buffer && mesh.shape == mover.shape && !state_.renew)) continue;
    if (state_.renew || !mesh.buffer) mesh.buffer = {};
    if (!mesh.buffer) mesh.buffer = host::makeBuffer();
    std::vector<float> data(2 + 8 * 5, 1e9F);
    for (std::size_t corner = 0; corner < 8; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        data[2 + corner * 5 + axis] = static_cast<float>((corner >> axis & 1U) != 0 ? mover.shape : -mover.shape);
    gl().BindBuffer(GL_ARRAY_BUFFER, mesh.buffer.name());
    gl().BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.size() * sizeof(float)), data.data(), GL_STATIC_DRAW);
    gl().BindBuffer(GL_ARRAY_BUFFER, 0);
    mesh.shape = mover.shape;
    mesh.version = Hash().add(mover.shape).value() | 1U;
  }
}

} // namespace stress
