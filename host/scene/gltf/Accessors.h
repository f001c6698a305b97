// Typed reads from accessors that check() has passed.
#pragma once

#include "Document.h"

namespace host::gltf {

struct Accessor {
  int components = 0;    ///< of a SCALAR, VEC2, VEC3 or VEC4; 0 for a matrix
  int componentType = 0; ///< gltf/Layout.h
  bool normalized = false;
  bool strided = false; ///< its buffer view has a byteStride
  std::size_t count = 0;
};

Accessor accessorAt(const Document& document, int index);

/// All components of a scalar or vector accessor, sparse values applied, as float: normalised ones as glTF 2.0 section
/// 3.6.2.2 says. Without a buffer view the elements are zero. Refuses a buffer without data.
std::vector<float> readFloats(Document& document, int accessor);

/// A SCALAR accessor of unsigned integers, as vertex indices are.
std::vector<std::uint32_t> readIndices(Document& document, int accessor);

} // namespace host::gltf
