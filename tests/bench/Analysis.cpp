#include "Analysis.h"

#include <algorithm>
#include <cmath>

namespace bench {

namespace {

/// Guards the logarithm of an error of 0.
constexpr double kLeastError = 1e-9;

/// The points by time, without those that a faster one beats.
std::vector<Point> frontOf(std::vector<Point> curve) {
  std::sort(curve.begin(), curve.end(), [](const Point& a, const Point& b) { return a.milliseconds < b.milliseconds; });
  std::vector<Point> front;
  for (Point point : curve) {
    point.rRmse = std::max(point.rRmse, kLeastError);
    if (front.empty() || point.rRmse < front.back().rRmse) front.push_back(point);
  }
  return front;
}

double mixLog(double a, double b, double share) { return std::exp((1 - share) * std::log(a) + share * std::log(b)); }

double shareOf(double value, double a, double b) {
  return (std::log(value) - std::log(a)) / (std::log(b) - std::log(a));
}

} // namespace

std::optional<double> timeForError(const std::vector<Point>& curve, double rRmse) {
  const std::vector<Point> front = frontOf(curve);
  const double wanted = std::max(rRmse, kLeastError);
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (front[i].rRmse > wanted) continue;
    if (i == 0) return front[0].milliseconds;
    const Point &a = front[i - 1], &b = front[i];
    return mixLog(a.milliseconds, b.milliseconds, shareOf(wanted, a.rRmse, b.rRmse));
  }
  return std::nullopt;
}

std::optional<double> errorAtTime(const std::vector<Point>& curve, double milliseconds) {
  const std::vector<Point> front = frontOf(curve);
  if (front.empty() || milliseconds < front.front().milliseconds) return std::nullopt;
  for (std::size_t i = 1; i < front.size(); ++i)
    if (front[i].milliseconds > milliseconds) {
      const Point &a = front[i - 1], &b = front[i];
      return mixLog(a.rRmse, b.rRmse, shareOf(milliseconds, a.milliseconds, b.milliseconds));
    }
  return front.back().rRmse;
}

namespace {

using Curves = std::map<std::string, std::vector<Point>>; // by family

EqualError compareWith(const Result& ours, const Curves& curves, Group group) {
  EqualError row;
  row.setup = ours.setup.label();
  row.profile = ours.technique.name;
  row.group = group;
  row.milliseconds = ours.median();
  row.rRmse = ours.rRmse();
  row.leastError = reference::kInfinity;
  for (const auto& [family, curve] : curves) {
    const auto time = timeForError(curve, row.rRmse);
    if (time && (!row.bestTime || *time < *row.bestTime)) {
      row.bestTime = time;
      row.best = family;
    }
    const auto error = errorAtTime(curve, row.milliseconds);
    if (error && (!row.bestError || *error < *row.bestError)) {
      row.bestError = error;
      row.nearest = family;
    }
    for (const Point& point : curve)
      if (point.rRmse < row.leastError) {
        row.leastError = point.rRmse;
        row.leastErrorTime = point.milliseconds;
      }
  }
  return row;
}

} // namespace

std::vector<EqualError> equalErrors(const std::vector<Result>& results) {
  std::map<std::string, std::map<Group, Curves>> setups;
  for (const Result& result : results)
    if (result.ok() && result.setup.series == "curve")
      setups[result.setup.label()][result.technique.group][result.technique.family].push_back(
          {result.median(), result.rRmse()});
  std::vector<EqualError> rows;
  for (const Result& result : results) {
    if (!result.ok() || result.setup.series != "curve" || result.technique.group != Group::Ours) continue;
    for (const Group group : {Group::Shipping, Group::Research}) {
      const Curves& curves = setups[result.setup.label()][group];
      if (!curves.empty()) rows.push_back(compareWith(result, curves, group));
    }
  }
  return rows;
}

std::vector<Growth> growths(const std::vector<Result>& results) {
  std::map<std::pair<std::string, std::string>, std::vector<std::pair<double, double>>> series;
  for (const Result& result : results)
    if (result.ok() && result.setup.series != "curve")
      series[{result.setup.series, result.setup.series == "slices" ? result.technique.family : result.technique.name}]
          .emplace_back(result.setup.x, result.median());
  std::vector<Growth> rows;
  for (auto& [key, points] : series) {
    if (points.size() < 2) continue;
    std::sort(points.begin(), points.end());
    double sumX = 0, sumY = 0, sumXx = 0, sumXy = 0;
    const auto count = static_cast<double>(points.size());
    for (const auto& [value, time] : points) {
      const double x = std::log(value), y = std::log(time);
      sumX += x;
      sumY += y;
      sumXx += x * x;
      sumXy += x * y;
    }
    const double exponent = (count * sumXy - sumX * sumY) / (count * sumXx - sumX * sumX);
    rows.push_back({key.first, key.second, static_cast<int>(points.size()), exponent, points.front().second,
                    points.back().second, points.back().first / points.front().first});
  }
  return rows;
}

} // namespace bench
