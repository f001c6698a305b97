#include "Curve.h"

#include "reference/Metrics.h"

#include <cmath>
#include <ostream>

namespace sweeps {

namespace {

double rootMeanSquare(const reference::Image& a, const reference::Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    sum += (a.rgb[i] - b.rgb[i]) * (a.rgb[i] - b.rgb[i]);
  return std::sqrt(sum / static_cast<double>(a.rgb.size()));
}

reference::Image minus(reference::Image a, const reference::Image& b) {
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    a.rgb[i] -= b.rgb[i];
  return a;
}

} // namespace

Curve curveOf(const Sweep& sweep, tyndall::Technique technique, int mapExactEvery) {
  const std::unique_ptr<tests::ShaftRig> rig = sweep.make();
  Curve curve;
  reference::Image lastFast, lastExact;
  for (const double t : sweep.at) {
    sweep.pose(*rig, t);
    const reference::Image fast = rig->picture(technique), exact = rig->truth();
    const reference::ErrorMetrics error = reference::compare(fast, exact);
    Point point;
    point.t = t;
    point.mean = error.mean;
    point.error = error.rRmse;
    const int index = static_cast<int>(curve.size());
    if (mapExactEvery > 0 && index % mapExactEvery == 0)
      point.mapError = reference::compare(fast, rig->scene.reference().inscatter).rRmse;
    if (!curve.empty()) {
      point.change = rootMeanSquare(fast, lastFast) / error.mean;
      point.exactChange = rootMeanSquare(exact, lastExact) / error.mean;
      point.jump = rootMeanSquare(minus(fast, exact), minus(lastFast, lastExact)) / error.mean;
    }
    point.displaced = rig->error(fast).displaced;
    curve.push_back(point);
    lastFast = fast;
    lastExact = exact;
  }
  return curve;
}

void writeHeader(std::ostream& csv) {
  csv << "sweep,technique,t,mean,error,map_error,change,exact_change,jump,displaced\n";
}

void write(std::ostream& csv, const std::string& sweep, const std::string& technique, const Curve& curve) {
  for (const Point& p : curve)
    csv << '"' << sweep << "\"," << technique << ',' << p.t << ',' << p.mean << ',' << p.error << ',' << p.mapError
        << ',' << p.change << ',' << p.exactChange << ',' << p.jump << ',' << p.displaced << '\n';
}

} // namespace sweeps
