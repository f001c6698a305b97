// One number for many: equal numbers of equal things, and hardly ever of others.
#pragma once

#include "Random.h"

#include <cstring>
#include <type_traits>

namespace stress {

class Hash {
public:
  template <typename Value>
  Hash& add(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
      std::uint64_t bits = 0;
      static_assert(sizeof value <= sizeof bits);
      std::memcpy(&bits, &value, sizeof value);
      value_ = mixed(value_, bits);
    } else { // a range
      for (const auto& part : value)
        add(part);
    }
    return *this;
  }
  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 1;
};

} // namespace stress
