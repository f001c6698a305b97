#include "Hair.h"

#include "reference/Parallel.h"
#include "reference/StrandLight.h"

#include <algorithm>
#include <cmath>
#include <gl/CameraView.h>
#include <scene/Error.h>
#include <scene/ShadowViews.h>
#include <scene/View.h>

namespace avsmbench {

namespace {

constexpr int kRays = 64;       ///< of a footprint
constexpr double kBefore = 1.5; ///< widths of the strand, or texels where those are less

glm::dvec3 toVec3(const tyndall::Vec3& v) { return {v[0], v[1], v[2]}; }

host::Strands strandsOf(const host::Scene& scene) {
  host::Strands strands = host::strandsAt(scene, host::poseAt(scene, 0));
  if (strands.segments.empty()) throw host::Error("the scene has no strands");
  return strands;
}

tyndall::Light lampOf(const host::Scene& scene) {
  host::Notes notes;
  const std::vector<glm::dmat4> pose = host::poseAt(scene, 0);
  std::vector<tyndall::Light> lights = host::makeLights(scene, pose, notes);
  if (lights.empty() || lights.front().kind != tyndall::LightKind::Spot)
    throw host::Error("the scene's first light is not a spot");
  host::fitShadowViews(lights.front(), scene, pose, host::makeDefaultCamera(scene, pose, 1, {}, notes));
  if (lights.front().shadow.views.size() != 1) throw host::Error("the scene's first light does not see the strands");
  return lights.front();
}

} // namespace

Hair::Hair(const host::Scene& scene, int receivers) : Hair(strandsOf(scene), lampOf(scene), receivers) {}

Hair::Hair(host::Strands strands, tyndall::Light lamp, int receivers)
    : strands_(std::move(strands)), lamp_(std::move(lamp)) {
  const std::size_t count = strands_.segments.size();
  for (int i = 0; i < receivers; ++i) {
    const double share = (i + 0.5) / receivers, along = std::fmod((i + 0.5) * 0.6180339887498949, 1);
    const auto segment = std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
    const glm::uvec2 ends = strands_.segments[segment];
    receivers_.push_back({glm::mix(strands_.points[ends.x].position, strands_.points[ends.y].position, along),
                          static_cast<int>(segment)});
  }
  renderer_.set({}, strands_, true);
}

std::vector<float> Hair::answers(const MethodEntry& entry, tyndall::Avsm& lists, const tyndall::AvsmConfig& config) {
  const MethodPointer method = entry.make(lists, config);
  captureAll(method->lists(), [&] {
    if (const tyndall::Status status = method->lists().begin(); !status) throw host::Error(status.message);
    renderer_.capture(lamp_, config.size);
  });
  method->build();
  const host::CaptureView view(lamp_, 0, config.size);
  const glm::dvec3 lamp = toVec3(lamp_.position);
  const double scale = glm::length(glm::dvec3(glm::transpose(view.clipFromWorld)[0])); // NDC a unit aside, times w
  std::vector<Position> positions;
  for (const Receiver& receiver : receivers_) {
    const double width = strands_.points[strands_.segments[static_cast<std::size_t>(receiver.segment)].x].strand.width;
    const double texel = 2 * (view.clipFromWorld * glm::dvec4(receiver.place, 1)).w / (scale * config.size);
    const glm::dvec3 place = receiver.place + kBefore * std::min(texel, width) * glm::normalize(lamp - receiver.place);
    const glm::dvec4 clip = view.clipFromWorld * glm::dvec4(place, 1);
    positions.emplace_back(0.5 * clip.x / clip.w + 0.5, 0.5 * clip.y / clip.w + 0.5,
                           glm::dot(view.depthPlane, glm::dvec4(place, 1)));
  }
  const LookUps lookUps(*method, config.size, false, positions, static_cast<int>(positions.size()), 1);
  lookUps.run();
  return lookUps.image();
}

std::vector<double> Hair::truth(double footprint) const {
  const reference::StrandLight light(strands_);
  std::vector<double> values(receivers_.size());
  reference::parallelFor(static_cast<int>(values.size()), [&](int i) {
    const Receiver& receiver = receivers_[static_cast<std::size_t>(i)];
    values[static_cast<std::size_t>(i)] =
        light.meanTransmittance(receiver.place, toVec3(lamp_.position), receiver.segment, footprint, kRays);
  });
  return values;
}

double meanDifference(const std::vector<float>& answers, const std::vector<double>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum += std::abs(static_cast<double>(answers[i]) - truth[i]);
  return sum / static_cast<double>(truth.size());
}

} // namespace avsmbench
