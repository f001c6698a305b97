#include "VolumeShadows.h"

#include <chrono>
#include <gl/Gl.h>
#include <scene/Error.h>

namespace render {

namespace {

void require(const tyndall::Status& status) {
  if (!status) throw host::Error("shadows of smoke and strands: " + status.message);
}

} // namespace

void VolumeShadows::update(host::SceneRenderer& renderer, std::vector<tyndall::Light>& lights) {
  maps_.resize(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i)
    update(renderer, lights[i], maps_[i]);
}

void VolumeShadows::update(host::SceneRenderer& renderer, tyndall::Light& light, Map& map) const {
  const int layers = static_cast<int>(light.shadow.views.size());
  if (layers != map.layers) {
    map = {};
    map.layers = layers;
    if (layers == 0) return;
    tyndall::AvsmConfig config;
    config.loader = loader_;
    config.timing = timing_;
    config.size = size_;
    config.layers = layers;
    config.nodes = nodes_;
    tyndall::AvsmResult created = tyndall::Avsm::create(config);
    require(created.status);
    map.avsm = std::move(created.avsm);
  }
  if (!map.avsm) return;
  // Lists grow to what the frame before needed: what is lost for want of room is captured once more.
  for (int attempt = 0; attempt < 2; ++attempt) {
    require(map.avsm->begin());
    host::gl().Finish();
    const auto start = std::chrono::steady_clock::now();
    renderer.captureVolumes(light, size_);
    host::gl().Finish();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    map.captureMilliseconds = time.count();
    require(map.avsm->resolve());
    if (map.avsm->statistics().lost == 0) break;
  }
  light.curves = map.avsm->curves();
}

std::vector<VolumeShadowStatistics> VolumeShadows::statistics() const {
  std::vector<VolumeShadowStatistics> all;
  for (std::size_t i = 0; i < maps_.size(); ++i)
    if (maps_[i].avsm) all.push_back({static_cast<int>(i), maps_[i].captureMilliseconds, maps_[i].avsm->statistics()});
  return all;
}

} // namespace render
