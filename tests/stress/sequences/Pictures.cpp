#include "Pictures.h"

#include "gl/Gl.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

using namespace tyndall;

namespace stress {

namespace {

constexpr std::array<const char*, 3> kTargets = {"colour", "inscatter", "transmittance"};

// What a format rounds, relative to the value: once where a composite is blended, once a light where those are.
double roundingOf(Format format, std::size_t lights) {
  return format == GL_RGBA16F ? 0x1p-11 * static_cast<double>(1 + std::max(lights, std::size_t{1})) : 0;
}

class Walk {
public:
  explicit Walk(const ScriptState& state) : state_(state), width_(state.left + state.width + state.right) {}
  template <typename Visit>
  void inside(const Visit& visit) const {
    for (int y = 0; y < state_.height; ++y)
      for (int x = 0; x < state_.width; ++x)
        visit(x, y, at(x + state_.left, y + state_.bottom));
  }
  bool isInside(int x, int y) const {
    return x >= state_.left && y >= state_.bottom && x < state_.left + state_.width &&
           y < state_.bottom + state_.height;
  }
  std::size_t at(int x, int y) const { return 4 * static_cast<std::size_t>(y * width_ + x); }
  int width() const { return width_; }
  int height() const { return state_.bottom + state_.height + state_.top; }

private:
  const ScriptState& state_;
  int width_;
};

double meanOf(const std::vector<float>& image, const Walk& walk) {
  double sum = 0, count = 0;
  walk.inside([&](int, int, std::size_t at) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = std::abs(static_cast<double>(image[at + c]));
      if (!std::isfinite(value)) continue;
      sum += value;
      ++count;
    }
  });
  return count > 0 ? sum / count : 0;
}

double relative(float got, float wanted, double mean, double rounding) {
  if (std::memcmp(&got, &wanted, sizeof got) == 0) return 0;
  const double difference = std::abs(static_cast<double>(got) - static_cast<double>(wanted));
  const double size = std::max(std::abs(static_cast<double>(wanted)), mean);
  if (!std::isfinite(difference)) return kInfinity;
  return std::max(difference / std::max(size, 1e-30) - rounding, 0.0);
}

void addDifference(Difference& all, const std::vector<float>& got, const std::vector<float>& wanted, const Walk& walk,
                   double rounding, const char* target) {
  const double mean = meanOf(wanted, walk);
  double squares = 0, count = 0;
  walk.inside([&](int x, int y, std::size_t at) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double d = relative(got[at + c], wanted[at + c], mean, rounding);
      const double absolute = static_cast<double>(got[at + c]) - static_cast<double>(wanted[at + c]);
      squares += d > 0 ? absolute * absolute : 0;
      ++count;
      if (d <= all.most) continue;
      all.most = d;
      std::ostringstream text;
      text << target << " at (" << x << ", " << y << "), channel " << c << ": " << got[at + c] << " for "
           << wanted[at + c] << ", mean " << mean;
      all.where = text.str();
    }
  });
  const double size = std::sqrt(squares / count) / std::max(mean, 1e-30);
  all.rootMeanSquare = std::max(all.rootMeanSquare, std::isfinite(size) ? size : kInfinity);
}

} // namespace

Difference differenceOf(const Contents& got, const Contents& wanted, const ScriptState& state) {
  const Walk walk(state);
  Difference all;
  const std::size_t lights = state.lights.size();
  const double ofOutputs = roundingOf(state.outputFormat, lights);
  const double ofColour = roundingOf(state.colourFormat, lights) + ofOutputs; // an output may be composited
  for (std::size_t i = 0; i < got.size(); ++i)
    if (!got[i].empty() && got[i].size() == wanted[i].size())
      addDifference(all, got[i], wanted[i], walk, i == 0 ? ofColour : ofOutputs, kTargets[i]);
  return all;
}

bool bitEqual(const Contents& a, const Contents& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].size() != b[i].size() ||
        (!a[i].empty() && std::memcmp(a[i].data(), b[i].data(), a[i].size() * sizeof(float)) != 0))
      return false;
  return true;
}

bool isUntouchedOutside(const Contents& drawn, const Contents& empty, const ScriptState& state) {
  const Walk walk(state);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn[i].empty()) continue;
    for (int y = 0; y < walk.height(); ++y)
      for (int x = 0; x < walk.width(); ++x)
        for (std::size_t c = 0; c < 3 && !walk.isInside(x, y); ++c)
          if (drawn[i][walk.at(x, y) + c] != empty[i][walk.at(x, y) + c]) return false;
  }
  return true;
}

} // namespace stress
