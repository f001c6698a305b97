#include "Curve.h"

#include "reference/CameraRays.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <ostream>

namespace sweeps {

namespace {

double rootMeanSquare(const reference::Image& a, const reference::Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    sum += (a.rgb[i] - b.rgb[i]) * (a.rgb[i] - b.rgb[i]);
  return std::sqrt(sum / static_cast<double>(a.rgb.size()));
}

double meanOf(const reference::Image& image) {
  double sum = 0;
  for (const double value : image.rgb)
    sum += value;
  return sum / static_cast<double>(image.rgb.size());
}

void divideByScales(Curve& curve) {
  double brightest = 0;
  for (const Point& point : curve)
    brightest = std::max(brightest, point.mean);
  for (Point& point : curve) {
    point.scale = std::max({point.mean, 0.1 * brightest, 1e-30}); // black throughout: anything but black is infinite
    for (double* share : {&point.error, &point.change, &point.exactChange})
      *share /= point.scale;
    if (point.mapError >= 0) point.mapError /= point.scale;
  }
}

} // namespace

Curve curveOf(const Sweep& sweep, tyndall::Technique technique, int mapExactEvery) {
  const std::unique_ptr<tests::ShaftRig> rig = sweep.make();
  Curve curve;
  reference::Image lastFast, lastExact;
  for (const double t : sweep.at) {
    sweep.pose(*rig, t);
    const reference::Image fast = rig->picture(technique), exact = rig->truth();
    Point point;
    point.t = t;
    point.mean = meanOf(exact);
    point.error = rootMeanSquare(fast, exact);
    if (mapExactEvery > 0 && static_cast<int>(curve.size()) % mapExactEvery == 0)
      point.mapError = rootMeanSquare(fast, rig->scene.reference().inscatter);
    if (!curve.empty()) {
      point.change = rootMeanSquare(fast, lastFast);
      point.exactChange = rootMeanSquare(exact, lastExact);
    }
    curve.push_back(point);
    lastFast = fast;
    lastExact = exact;
  }
  divideByScales(curve);
  return curve;
}

double displaced(const Sweep& sweep, const Point& at) {
  const std::unique_ptr<tests::ShaftRig> rig = sweep.make();
  sweep.pose(*rig, at.t);
  const reference::Image exact = rig->truth();
  std::vector<reference::Image> moved = rig->displaced();
  tyndall::Frame& frame = rig->scene.frame;
  const glm::dmat4 clipFromView = reference::toMat4(frame.camera.clipFromView);
  for (const glm::dvec3 ndc :
       {glm::dvec3(1.0 / frame.viewport.width, 0, 0), glm::dvec3(0, 1.0 / frame.viewport.height, 0)}) {
    frame.camera.clipFromView = tests::toMat4(glm::translate(glm::dmat4(1), ndc) * clipFromView);
    moved.push_back(rig->picture(tyndall::Technique::Exact));
  }
  double greatest = 0;
  for (const reference::Image& image : moved)
    greatest = std::max(greatest, rootMeanSquare(image, exact) / at.scale);
  return greatest;
}

void writeHeader(std::ostream& csv) { csv << "sweep,technique,t,mean,error,map_error,change,exact_change\n"; }

void write(std::ostream& csv, const std::string& sweep, const std::string& technique, const Curve& curve) {
  for (const Point& p : curve)
    csv << '"' << sweep << "\"," << technique << ',' << p.t << ',' << p.mean << ',' << p.error << ',' << p.mapError
        << ',' << p.change << ',' << p.exactChange << '\n';
}

} // namespace sweeps
