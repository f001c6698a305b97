#include "reference/Curves.h"

#include <algorithm>
#include <cmath>

namespace reference {

double transmittanceAt(const std::vector<Segment>& segments, double depth) {
  double passed = 1;
  for (const Segment& s : segments) {
    if (depth < s.entry || (depth == s.entry && s.exit > s.entry)) continue;
    const double share = s.exit > s.entry ? std::min((depth - s.entry) / (s.exit - s.entry), 1.0) : 1.0;
    passed *= std::pow(s.transmittance, share);
  }
  return passed;
}

} // namespace reference
