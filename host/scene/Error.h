// The one exception of the host layers: a line that names file, field or value, and the rule it breaks.
#pragma once

#include <stdexcept>

namespace host {

class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

} // namespace host
