#include "Accessors.h"

#include "Layout.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace host::gltf {

namespace {

template <typename T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// glTF 2.0 section 3.6.2.2: c / max for unsigned, max(c / max, -1) for signed components.
template <typename T>
float toFloat(const std::uint8_t* bytes, bool normalized) {
  const auto value = static_cast<float>(load<T>(bytes));
  if constexpr (std::is_same_v<T, float>) return value;
  return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F) : value;
}

float readComponent(const std::uint8_t* bytes, int type, bool normalized) {
  switch (type) {
  case TINYGLTF_COMPONENT_TYPE_BYTE:
    return toFloat<std::int8_t>(bytes, normalized);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return toFloat<std::uint8_t>(bytes, normalized);
  case TINYGLTF_COMPONENT_TYPE_SHORT:
    return toFloat<std::int16_t>(bytes, normalized);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return toFloat<std::uint16_t>(bytes, normalized);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    return toFloat<std::uint32_t>(bytes, false);
  default:
    return toFloat<float>(bytes, false);
  }
}

std::uint32_t readIndex(const std::uint8_t* bytes, int type) {
  switch (type) {
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return *bytes;
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return load<std::uint16_t>(bytes);
  default:
    return load<std::uint32_t>(bytes);
  }
}

/// Where the elements of a buffer view begin. check() has seen to the range inside the buffer.
const std::uint8_t* viewData(const Document& document, int view, const std::string& where) {
  const tinygltf::BufferView& bufferView = document.model.bufferViews[static_cast<std::size_t>(view)];
  const Bytes& buffer = document.buffers[static_cast<std::size_t>(bufferView.buffer)];
  if (buffer.data == nullptr) {
    document.refuse(where, "buffers[" + std::to_string(bufferView.buffer) + "] has no data: no uri, no BIN chunk");
  }
  return buffer.data + bufferView.byteOffset;
}

/// Calls write(element, bytes) for each element that the accessor stores, then for those that it replaces.
template <typename Write>
void forEachElement(const Document& document, int index, std::size_t size, Write write) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(index)];
  const std::string where = at("accessors", static_cast<std::size_t>(index));
  if (accessor.bufferView >= 0) {
    const std::size_t stride = document.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    const std::uint8_t* bytes = viewData(document, accessor.bufferView, where) + accessor.byteOffset;
    for (std::size_t i = 0; i < accessor.count; ++i) {
      write(i, bytes + i * (stride == 0 ? size : stride));
    }
  }
  if (!accessor.sparse.isSparse) return;
  const auto& indices = accessor.sparse.indices;
  const auto& values = accessor.sparse.values;
  const std::uint8_t* indexBytes =
      viewData(document, indices.bufferView, where + ".sparse.indices") + indices.byteOffset;
  const std::uint8_t* valueBytes = viewData(document, values.bufferView, where + ".sparse.values") + values.byteOffset;
  const auto indexSize = static_cast<std::size_t>(componentSize(indices.componentType));
  for (std::size_t i = 0; i < static_cast<std::size_t>(accessor.sparse.count); ++i) {
    const std::uint32_t element = readIndex(indexBytes + i * indexSize, indices.componentType);
    if (element >= accessor.count) {
      document.refuse(where + ".sparse.indices",
                      "element " + std::to_string(element) + " is beyond the accessor's count");
    }
    write(element, valueBytes + i * size);
  }
}

} // namespace

int componentCount(const tinygltf::Accessor& accessor) {
  switch (accessor.type) {
  case TINYGLTF_TYPE_SCALAR:
    return 1;
  case TINYGLTF_TYPE_VEC2:
    return 2;
  case TINYGLTF_TYPE_VEC3:
    return 3;
  case TINYGLTF_TYPE_VEC4:
    return 4;
  default:
    return 0;
  }
}

std::vector<float> readFloats(Document& document, int accessor) {
  const tinygltf::Accessor& source = document.model.accessors[static_cast<std::size_t>(accessor)];
  const auto components = static_cast<std::size_t>(componentCount(source));
  const auto size = static_cast<std::size_t>(componentSize(source.componentType));
  document.spend(source.count * components * sizeof(float), at("accessors", static_cast<std::size_t>(accessor)));
  std::vector<float> values(source.count * components, 0.0F);
  forEachElement(document, accessor, components * size, [&](std::size_t element, const std::uint8_t* bytes) {
    for (std::size_t c = 0; c < components; ++c) {
      values[element * components + c] = readComponent(bytes + c * size, source.componentType, source.normalized);
    }
  });
  return values;
}

std::vector<std::uint32_t> readIndices(Document& document, int accessor) {
  const tinygltf::Accessor& source = document.model.accessors[static_cast<std::size_t>(accessor)];
  const auto size = static_cast<std::size_t>(componentSize(source.componentType));
  document.spend(source.count * sizeof(std::uint32_t), at("accessors", static_cast<std::size_t>(accessor)));
  std::vector<std::uint32_t> values(source.count, 0);
  forEachElement(document, accessor, size, [&](std::size_t element, const std::uint8_t* bytes) {
    values[element] = readIndex(bytes, source.componentType);
  });
  return values;
}

} // namespace host::gltf
