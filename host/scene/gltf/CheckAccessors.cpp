// Buffers, buffer views and accessors: every byte that an accessor names lies inside its view, every view inside its
// buffer. All arithmetic is on 64-bit numbers whose factors are bounded, so that nothing overflows.
#include "Check.h"
#include "Fields.h"
#include "Layout.h"

namespace host::gltf {

namespace {

constexpr std::int64_t kMaxCount = std::int64_t{1} << 32; // elements; times the largest stride still fits 64 bits
constexpr std::int64_t kMaxOffset = kMaxFileBytes;
constexpr int kElementArrayBuffer = 34963; // GL's

struct View {
  std::int64_t length = 0;
  std::int64_t stride = 0; // 0: tightly packed
};

void checkBuffer(Fields buffer) {
  buffer.integer("byteLength", 1, kMaxOffset, Need::Required);
  buffer.string("uri", Need::Optional);
}

void checkBufferView(Fields view) {
  const std::int64_t buffer = view.requiredIndex("buffer", "buffers");
  const std::int64_t offset = view.integer("byteOffset", 0, kMaxOffset).value_or(0);
  const std::int64_t length = view.requiredInteger("byteLength", 1, kMaxOffset);
  const nlohmann::json& owner = view.document().json["buffers"][static_cast<std::size_t>(buffer)];
  const auto available = owner["byteLength"].get<std::int64_t>();
  if (offset + length > available) {
    view.refuse("byteLength", "byteOffset + byteLength is " + std::to_string(offset + length) + ", but buffers[" +
                                  std::to_string(buffer) + "] has " + std::to_string(available) + " bytes");
  }
  const std::optional<std::int64_t> stride = view.integer("byteStride", 4, 252);
  if (stride && *stride % 4 != 0) view.refuse("byteStride", "must be a multiple of 4");
  const std::optional<std::int64_t> target = view.integer("target", 0, std::numeric_limits<std::int32_t>::max());
  if (stride && target && *target == kElementArrayBuffer) {
    view.refuse("byteStride", "must not be given for an index buffer");
  }
}

View viewAt(const Document& document, std::int64_t index) {
  const nlohmann::json& view = document.json["bufferViews"][static_cast<std::size_t>(index)];
  return {view["byteLength"].get<std::int64_t>(), view.value("byteStride", std::int64_t{0})};
}

/// `count` elements from `offset` on must end inside the view.
void checkRange(const Fields& owner, const char* key, const View& view, std::int64_t offset, std::int64_t count,
                ElementSize size) {
  const std::int64_t stride = view.stride == 0 ? size.stride : view.stride;
  if (stride < size.extent) owner.refuse(key, "its view's byteStride is smaller than an element");
  const std::int64_t end = offset + stride * (count - 1) + size.extent;
  if (end > view.length) {
    owner.refuse(key, "reads up to byte " + std::to_string(end) + " of a view of " + std::to_string(view.length));
  }
}

void checkSparse(Fields sparse, std::int64_t accessorCount, ElementSize valueSize) {
  Document& document = sparse.document();
  const std::int64_t count = sparse.requiredInteger("count", 1, accessorCount);

  Fields indices(document, *sparse.object("indices", Need::Required), sparse.path("indices"));
  const std::int64_t type = indices.requiredInteger("componentType", 0, 0xffff);
  if (!isIndexType(static_cast<int>(type))) indices.refuse("componentType", "must be 5121, 5123 or 5125");
  const View indexView = viewAt(document, indices.requiredIndex("bufferView", "bufferViews"));
  if (indexView.stride != 0) indices.refuse("bufferView", "must not have a byteStride");
  const std::int64_t indexOffset = indices.integer("byteOffset", 0, kMaxOffset).value_or(0);
  checkRange(indices, "byteOffset", indexView, indexOffset, count, elementSize("SCALAR", static_cast<int>(type)));

  Fields values(document, *sparse.object("values", Need::Required), sparse.path("values"));
  const View valueView = viewAt(document, values.requiredIndex("bufferView", "bufferViews"));
  if (valueView.stride != 0) values.refuse("bufferView", "must not have a byteStride");
  const std::int64_t valueOffset = values.integer("byteOffset", 0, kMaxOffset).value_or(0);
  checkRange(values, "byteOffset", valueView, valueOffset, count, valueSize);
}

void checkAccessor(Fields accessor) {
  Document& document = accessor.document();
  const auto component = static_cast<int>(accessor.requiredInteger("componentType", 0, 0xffff));
  if (componentSize(component) == 0) {
    accessor.refuse("componentType", "must be 5120, 5121, 5122, 5123, 5125 or 5126");
  }
  const std::int64_t count = accessor.requiredInteger("count", 1, kMaxCount);
  const std::string type =
      accessor.string("type", Need::Required, {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"});
  accessor.boolean("normalized");
  if (accessor.value().value("normalized", false) && componentSize(component) == 4) {
    document.note(accessor.path("normalized"), "has no meaning for 32-bit components and is ignored");
  }
  const ElementSize size = elementSize(type, component);
  const std::int64_t offset = accessor.integer("byteOffset", 0, kMaxOffset).value_or(0);
  if (const auto view = accessor.index("bufferView", "bufferViews")) {
    checkRange(accessor, "count", viewAt(document, *view), offset, count, size);
  }
  if (nlohmann::json* sparse = accessor.object("sparse")) {
    checkSparse(Fields(document, *sparse, accessor.path("sparse")), count, size);
  }
}

} // namespace

void checkAccessors(Document& document) {
  Fields root(document, document.json, "");
  root.each("buffers", Need::Optional, checkBuffer);
  root.each("bufferViews", Need::Optional, checkBufferView);
  root.each("accessors", Need::Optional, checkAccessor);
}

} // namespace host::gltf
