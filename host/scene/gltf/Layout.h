// Sizes of accessor elements, glTF 2.0 section 3.6.2.
#pragma once

#include <string_view>

namespace host::gltf {

/// Component types, as GL numbers them.
inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
                     kFloat = 5126;

/// Bytes of a component, 0 for a type that glTF does not know.
inline int componentSize(int type) {
  switch (type) {
  case kByte:
  case kUnsignedByte:
    return 1;
  case kShort:
  case kUnsignedShort:
    return 2;
  case kUnsignedInt:
  case kFloat:
    return 4;
  default:
    return 0;
  }
}

/// The types of vertex indices and of the indices of a sparse accessor.
inline bool isIndexType(int type) { return type == kUnsignedByte || type == kUnsignedShort || type == kUnsignedInt; }

/// Bytes from an element to the next, and those that an element takes: columns of matrices begin at multiples of 4
/// bytes, but the last one is not padded.
struct ElementSize {
  int stride = 0;
  int extent = 0;
};

inline ElementSize elementSize(std::string_view type, int component) {
  const int size = componentSize(component);
  if (type == "SCALAR") return {size, size};
  const int rows = type.back() - '0';
  if (type.substr(0, 3) == "VEC") return {rows * size, rows * size};
  const int column = (rows * size + 3) / 4 * 4;
  return {rows * column, (rows - 1) * column + rows * size};
}

} // namespace host::gltf
