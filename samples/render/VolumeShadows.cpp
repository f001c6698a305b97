#include "VolumeShadows.h"

#include <chrono>
#include <gl/Gl.h>
#include <scene/Error.h>

namespace render {

namespace {

void require(const tyndall::Status& status) {
  if (!status) throw host::Error("shadows of smoke, fog and strands: " + status.message);
}

} // namespace

void VolumeShadows::update(host::SceneRenderer& renderer, std::vector<tyndall::Light>& lights) {
  maps_.resize(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    tyndall::Light& light = lights[i];
    create(maps_[i], static_cast<int>(light.shadow.views.size()), nodes_);
    if (!maps_[i].avsm) continue;
    capture(maps_[i], light, [&] { renderer.captureVolumes(light, size_); });
    light.curves = maps_[i].avsm->curves();
  }
}

tyndall::EyeCurves VolumeShadows::before(host::SceneRenderer& renderer, const tyndall::Camera& camera,
                                         const tyndall::Rectangle& image, double nearDistance, double farDistance,
                                         bool isLit) {
  tyndall::Light eye;
  require(tyndall::eyeLight(camera, image, nearDistance, farDistance, eye));
  // What curves of few nodes are off by shows as blotches on what stands within lit fog.
  constexpr int kLitNodes = 16;
  create(eye_, 1, isLit ? kLitNodes : nodes_);
  capture(eye_, eye, [&] { renderer.captureSmoke(eye, size_); });
  return {eye_.avsm->curves(), nearDistance, farDistance};
}

void VolumeShadows::create(Map& map, int layers, int nodes) const {
  if (layers == map.layers && nodes == map.nodes) return;
  map = {};
  if (layers == 0) return;
  tyndall::AvsmConfig config;
  config.loader = loader_;
  config.timing = timing_;
  config.size = size_;
  config.layers = layers;
  config.nodes = nodes;
  tyndall::AvsmResult created = tyndall::Avsm::create(config);
  require(created.status);
  map.layers = layers; // of a map that there is: one that could not be made is tried again
  map.nodes = nodes;
  map.avsm = std::move(created.avsm);
}

// Lists grow to what the frame before needed: what is lost for want of room is captured once more.
void VolumeShadows::capture(Map& map, const tyndall::Light& light, const std::function<void()>& draw) const {
  for (int attempt = 0; attempt < 2; ++attempt) {
    require(map.avsm->begin());
    host::gl().Finish();
    const auto start = std::chrono::steady_clock::now();
    draw();
    if (!fog_.empty()) require(map.avsm->drawVolumes(light, fog_));
    host::gl().Finish();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    map.captureMilliseconds = time.count();
    require(map.avsm->resolve());
    if (map.avsm->statistics().lost == 0) break;
  }
}

std::vector<VolumeShadowStatistics> VolumeShadows::statistics() const {
  std::vector<VolumeShadowStatistics> all;
  for (std::size_t i = 0; i < maps_.size(); ++i)
    if (maps_[i].avsm) all.push_back({static_cast<int>(i), maps_[i].captureMilliseconds, maps_[i].avsm->statistics()});
  if (eye_.avsm) all.push_back({VolumeShadowStatistics::kEye, eye_.captureMilliseconds, eye_.avsm->statistics()});
  return all;
}

} // namespace render
