#include "Accessors.h"
#include "Convert.h"
#include "Extras.h"
#include "Layout.h"
#include "Unroll.h"

#include <algorithm>
#include <cmath>
#include <scene/Error.h>

namespace host::gltf {

namespace {

/// The formats that an attribute may have: glTF 2.0 section 3.7.2.1, and with KHR_mesh_quantization its table.
bool isAllowedFormat(std::string_view attribute, const Accessor& accessor, bool quantized) {
  const int components = accessor.components;
  const int type = accessor.componentType;
  const bool isFloat = type == kFloat;
  const bool isSigned = type == kByte || type == kShort;
  const bool isShort = componentSize(type) < 4;
  if (attribute == "POSITION") return components == 3 && (isFloat || (quantized && isShort));
  if (attribute == "NORMAL") return components == 3 && (isFloat || (quantized && isSigned && accessor.normalized));
  if (attribute == "COLOR_0")
    return (components == 3 || components == 4) && (isFloat || (isShort && !isSigned && accessor.normalized));
  const bool isTexCoord = isShort && ((accessor.normalized && !isSigned) || quantized);
  return components == 2 && (isFloat || isTexCoord);
}

/// The index that GL would take for a primitive restart.
std::uint32_t restartIndex(int type) {
  if (type == kUnsignedByte) return 0xff;
  return type == kUnsignedShort ? 0xffff : 0xffffffff;
}

class MeshReader {
public:
  MeshReader(Document& document, const nlohmann::json& primitive, std::string where)
      : document_(document), attributes_(primitive["attributes"]), indices_(primitive.value("indices", -1)),
        where_(std::move(where)) {}

  bool has(const std::string& attribute) const { return attributes_.contains(attribute); }

  std::vector<float> attribute(const std::string& name) {
    const int index = attributes_[name].get<int>();
    if (!isAllowedFormat(name, accessorAt(document_, index), document_.uses("KHR_mesh_quantization"))) {
      document_.refuse(where_ + ".attributes." + name,
                       "accessors[" + std::to_string(index) + "] must have a type and component type that glTF allows");
    }
    return readFloats(document_, index);
  }

  std::vector<Vertex> vertices(const TextureCoordinates& coordinates) {
    const std::vector<float> positions = attribute("POSITION");
    const std::size_t count = positions.size() / 3;
    document_.spend(count * sizeof(Vertex), where_);
    std::vector<Vertex> result(count);
    for (std::size_t i = 0; i < count; ++i) {
      Vertex& vertex = result[i];
      vertex.position = {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
      if (!isFinite(vertex.position)) {
        document_.refuse(where_ + ".attributes.POSITION", "element " + std::to_string(i) + " must be finite");
      }
    }
    if (has("NORMAL")) readNormals(result);
    if (coordinates.needed) readTextureCoordinates(coordinates, result);
    if (has("COLOR_0")) readColours(result);
    return result;
  }

  std::vector<std::uint32_t> indices(std::size_t vertexCount) {
    if (indices_ < 0) {
      document_.spend(vertexCount * sizeof(std::uint32_t), where_);
      std::vector<std::uint32_t> sequence(vertexCount);
      for (std::size_t i = 0; i < vertexCount; ++i) {
        sequence[i] = static_cast<std::uint32_t>(i);
      }
      return sequence;
    }
    const Accessor accessor = accessorAt(document_, indices_);
    const std::string where = where_ + ".indices";
    if (accessor.components != 1 || !isIndexType(accessor.componentType)) {
      document_.refuse(where, "accessors[" + std::to_string(indices_) + "] must be SCALAR of 5121, 5123 or 5125");
    }
    if (accessor.strided) document_.refuse(where, "the buffer view of indices must not have a byteStride");
    std::vector<std::uint32_t> result = readIndices(document_, indices_);
    const std::uint32_t restart = restartIndex(accessor.componentType);
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (result[i] < vertexCount && result[i] != restart) continue;
      document_.refuse(where, "index " + std::to_string(result[i]) + " at " + std::to_string(i) +
                                  (result[i] == restart ? " means a restart, which glTF does not have"
                                                        : " exceeds the " + std::to_string(vertexCount) + " vertices"));
    }
    return result;
  }

private:
  static bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

  /// A normal that cannot be normalised stays zero: repairNormals takes the surface's own instead.
  void readNormals(std::vector<Vertex>& vertices) {
    const std::vector<float> normals = attribute("NORMAL");
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const glm::dvec3 normal(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
      const double length = glm::length(normal);
      const bool usable = std::isfinite(length) && length > 0;
      vertices[i].normal = usable ? glm::vec3(normal / length) : glm::vec3(0);
    }
  }

  void readTextureCoordinates(const TextureCoordinates& coordinates, std::vector<Vertex>& vertices) {
    const std::string name = "TEXCOORD_" + std::to_string(coordinates.texCoord);
    if (!has(name)) {
      document_.note(where_ + ".attributes." + name, "is missing, but the material's texture needs it; taken as 0");
      return;
    }
    const std::vector<float> uvs = attribute(name);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const glm::vec2 uv = coordinates.offset + coordinates.linear * glm::vec2(uvs[2 * i], uvs[2 * i + 1]);
      if (std::isfinite(uv.x) && std::isfinite(uv.y)) {
        vertices[i].uv = uv;
      } else {
        document_.note(where_ + ".attributes." + name, "some elements are not finite; taken as 0");
      }
    }
  }

  /// They only tint: those that cannot be read are left out.
  void readColours(std::vector<Vertex>& vertices) {
    const std::string where = where_ + ".attributes.COLOR_0";
    std::vector<float> colours;
    try {
      colours = attribute("COLOR_0");
    } catch (const Error& error) {
      return document_.note(where, std::string("vertex colours are ignored: ") + error.what());
    }
    const Accessor accessor = accessorAt(document_, attributes_["COLOR_0"].get<int>());
    const auto components = static_cast<std::size_t>(accessor.components);
    bool isClamped = false, hasAlpha = false;
    for (std::size_t i = 0; i < std::min(vertices.size(), colours.size() / components); ++i) {
      for (int c = 0; c < 3; ++c) {
        const float given = colours[components * i + static_cast<std::size_t>(c)];
        const float value = given >= 0 ? std::min(given, 1.0F) : 0.0F; // NaN is 0
        isClamped = isClamped || value != given;
        vertices[i].colour[c] = static_cast<std::uint16_t>(std::lround(65535 * value));
      }
      hasAlpha = hasAlpha || (components == 4 && colours[4 * i + 3] != 1);
    }
    if (isClamped) document_.note(where, "some vertex colours are not from 0 to 1; taken as the nearest that is");
    if (hasAlpha) document_.note(where, "the alpha of vertex colours is ignored");
  }

  Document& document_;
  const nlohmann::json& attributes_;
  int indices_; // accessor, or -1
  std::string where_;
};

/// Returns false for a primitive that draws nothing.
bool convertPrimitive(Document& document, const nlohmann::json& source, const std::string& where,
                      const TextureCoordinates& coordinates, Primitive& result) {
  MeshReader reader(document, source, where);
  if (!reader.has("POSITION")) {
    document.note(where + ".attributes.POSITION", "is missing; the primitive is left out");
    return false;
  }
  result.vertices = reader.vertices(coordinates);
  const std::vector<std::uint32_t> indices = reader.indices(result.vertices.size());

  const auto mode = static_cast<Mode>(source.value("mode", static_cast<int>(Mode::Triangles)));
  document.spend(3 * indices.size() * sizeof(std::uint32_t), where);
  result.topology = topologyOf(mode);
  result.indices = unroll(mode, indices);
  if (!isComplete(mode, indices.size())) document.note(where, "its last triangle or line is incomplete and left out");
  if (result.indices.empty()) return false;
  if (result.topology != Topology::Triangles) return true;
  if (!reader.has("NORMAL")) {
    document.spend(result.indices.size() * sizeof(Vertex), where);
    makeFlat(result);
  } else if (repairNormals(result)) {
    document.note(where + ".attributes.NORMAL", "some cannot be normalised; taken from the triangles");
  }
  return true;
}

} // namespace

void convertMeshes(Document& document, const std::vector<TextureCoordinates>& coordinates, Scene& scene) {
  for (std::size_t m = 0; m < document.count("meshes"); ++m) {
    const nlohmann::json& source = document.element("meshes", m);
    const nlohmann::json& primitives = source["primitives"];
    Mesh mesh;
    mesh.name = nameOf(source);
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const int material = primitives[p].value("material", -1);
      Primitive primitive;
      primitive.material = material < 0 ? static_cast<int>(scene.materials.size()) - 1 : material;
      const std::string where = at(at("meshes", m, "primitives"), p);
      const TextureCoordinates& uv = coordinates[static_cast<std::size_t>(primitive.material)];
      if (convertPrimitive(document, primitives[p], where, uv, primitive)) {
        if (primitive.topology == Topology::Lines) primitive.strand = strandOf(document, m, p, primitive);
        mesh.primitives.push_back(std::move(primitive));
      }
    }
    scene.meshes.push_back(std::move(mesh));
  }
}

} // namespace host::gltf
