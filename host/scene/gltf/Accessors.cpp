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
  case kByte:
    return toFloat<std::int8_t>(bytes, normalized);
  case kUnsignedByte:
    return toFloat<std::uint8_t>(bytes, normalized);
  case kShort:
    return toFloat<std::int16_t>(bytes, normalized);
  case kUnsignedShort:
    return toFloat<std::uint16_t>(bytes, normalized);
  case kUnsignedInt:
    return toFloat<std::uint32_t>(bytes, false);
  default:
    return toFloat<float>(bytes, false);
  }
}

std::uint32_t readIndex(const std::uint8_t* bytes, int type) {
  switch (type) {
  case kUnsignedByte:
    return *bytes;
  case kUnsignedShort:
    return load<std::uint16_t>(bytes);
  default:
    return load<std::uint32_t>(bytes);
  }
}

/// Where the elements begin that an accessor, or a part of a sparse one, names. check() has seen to the range inside
/// the buffer.
const std::uint8_t* dataOf(const Document& document, const nlohmann::json& owner, const std::string& where) {
  const nlohmann::json& view = document.element("bufferViews", owner["bufferView"].get<std::size_t>());
  const auto index = view["buffer"].get<std::size_t>();
  const Bytes& buffer = document.buffers[index];
  if (buffer.data == nullptr) document.refuse(where, at("buffers", index) + " has no data: no uri, no BIN chunk");
  return buffer.data + view.value("byteOffset", std::size_t{0}) + owner.value("byteOffset", std::size_t{0});
}

std::size_t strideOf(const Document& document, const nlohmann::json& accessor) {
  if (!accessor.contains("bufferView")) return 0;
  return document.element("bufferViews", accessor["bufferView"].get<std::size_t>()).value("byteStride", std::size_t{0});
}

/// Calls write(element, bytes) for each element that the accessor stores, then for those that it replaces.
template <typename Write>
void forEachElement(const Document& document, int index, std::size_t size, Write write) {
  const nlohmann::json& accessor = document.element("accessors", index);
  const std::string where = at("accessors", static_cast<std::size_t>(index));
  const auto count = accessor["count"].get<std::size_t>();
  if (accessor.contains("bufferView")) {
    const std::size_t stride = strideOf(document, accessor);
    const std::uint8_t* bytes = dataOf(document, accessor, where);
    for (std::size_t i = 0; i < count; ++i) {
      write(i, bytes + i * (stride == 0 ? size : stride));
    }
  }
  const auto sparse = accessor.find("sparse");
  if (sparse == accessor.end()) return;
  const nlohmann::json& indices = (*sparse)["indices"];
  const std::uint8_t* indexBytes = dataOf(document, indices, where + ".sparse.indices");
  const std::uint8_t* valueBytes = dataOf(document, (*sparse)["values"], where + ".sparse.values");
  const int indexType = indices["componentType"].get<int>();
  const auto indexSize = static_cast<std::size_t>(componentSize(indexType));
  const auto replaced = (*sparse)["count"].get<std::size_t>();
  for (std::size_t i = 0; i < replaced; ++i) {
    const std::uint32_t element = readIndex(indexBytes + i * indexSize, indexType);
    if (element >= count) {
      document.refuse(where + ".sparse.indices",
                      "element " + std::to_string(element) + " is beyond the accessor's count");
    }
    write(element, valueBytes + i * size);
  }
}

} // namespace

Accessor accessorAt(const Document& document, int index) {
  const nlohmann::json& json = document.element("accessors", index);
  const auto type = json["type"].get<std::string_view>();
  Accessor accessor;
  if (type == "SCALAR") accessor.components = 1;
  if (type.substr(0, 3) == "VEC") accessor.components = type.back() - '0';
  accessor.componentType = json["componentType"].get<int>();
  accessor.normalized = json.value("normalized", false);
  accessor.strided = strideOf(document, json) != 0;
  accessor.count = json["count"].get<std::size_t>();
  return accessor;
}

std::vector<float> readFloats(Document& document, int accessor) {
  const Accessor source = accessorAt(document, accessor);
  const auto components = static_cast<std::size_t>(source.components);
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
  const Accessor source = accessorAt(document, accessor);
  const auto size = static_cast<std::size_t>(componentSize(source.componentType));
  document.spend(source.count * sizeof(std::uint32_t), at("accessors", static_cast<std::size_t>(accessor)));
  std::vector<std::uint32_t> values(source.count, 0);
  forEachElement(document, accessor, size, [&](std::size_t element, const std::uint8_t* bytes) {
    values[element] = readIndex(bytes, source.componentType);
  });
  return values;
}

} // namespace host::gltf
