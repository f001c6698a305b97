#include "gl/SceneBuffers.h"

#include "gl/Driver.h"
#include "gl/Pause.h"
#include "scene/Error.h"

#include <algorithm>
#include <cstddef>

namespace host {

namespace {

constexpr float kMaxAnisotropy = 8;

/// Mesa's software rasterisers filter anisotropically at a tenth of their usual speed.
bool isSoftwareRenderer() { return isSoftware(reinterpret_cast<const char*>(gl().GetString(GL_RENDERER))); }

GLint wrapOf(Wrap wrap) {
  switch (wrap) {
  case Wrap::Repeat:
    return GL_REPEAT;
  case Wrap::MirroredRepeat:
    return GL_MIRRORED_REPEAT;
  case Wrap::ClampToEdge:
    return GL_CLAMP_TO_EDGE;
  }
  return GL_REPEAT;
}

GLenum modeOf(Topology topology) {
  switch (topology) {
  case Topology::Points:
    return GL_POINTS;
  case Topology::Lines:
    return GL_LINES;
  case Topology::Triangles:
    return GL_TRIANGLES;
  }
  return GL_TRIANGLES;
}

/// GL takes offsets into the bound buffer as pointers.
const void* bufferOffset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes); // NOLINT(performance-no-int-to-ptr)
}

void setAttribute(GLuint location, GLint components, std::size_t offset) {
  gl().EnableVertexAttribArray(location);
  gl().VertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, sizeof(Vertex), bufferOffset(offset));
}

SceneBuffers::Primitive upload(const Primitive& primitive) {
  SceneBuffers::Primitive uploaded;
  uploaded.mode = modeOf(primitive.topology);
  uploaded.count = static_cast<GLsizei>(primitive.indices.size());
  uploaded.material = primitive.material;
  uploaded.vertexArray = makeVertexArray();
  uploaded.vertices = makeBuffer();
  uploaded.indices = makeBuffer();
  gl().BindVertexArray(uploaded.vertexArray.name());
  gl().BindBuffer(GL_ARRAY_BUFFER, uploaded.vertices.name());
  gl().BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(primitive.vertices.size() * sizeof(Vertex)),
                  primitive.vertices.data(), GL_STATIC_DRAW);
  gl().BindBuffer(GL_ELEMENT_ARRAY_BUFFER, uploaded.indices.name());
  gl().BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(primitive.indices.size() * sizeof(std::uint32_t)),
                  primitive.indices.data(), GL_STATIC_DRAW);
  setAttribute(0, 3, offsetof(Vertex, position));
  setAttribute(1, 3, offsetof(Vertex, normal));
  setAttribute(2, 2, offsetof(Vertex, uv));
  gl().EnableVertexAttribArray(3);
  gl().VertexAttribPointer(3, 4, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(Vertex), bufferOffset(offsetof(Vertex, colour)));
  gl().BindVertexArray(0);
  gl().BindBuffer(GL_ARRAY_BUFFER, 0);
  if (!primitive.vertices.empty()) {
    uploaded.low = uploaded.high = primitive.vertices.front().position;
  }
  for (const Vertex& vertex : primitive.vertices) {
    uploaded.low = glm::min(uploaded.low, glm::dvec3(vertex.position));
    uploaded.high = glm::max(uploaded.high, glm::dvec3(vertex.position));
  }
  return uploaded;
}

GlTexture upload(const Texture& image) {
  GLint maxSide = 0;
  gl().GetIntegerv(GL_MAX_TEXTURE_SIZE, &maxSide);
  if (image.width < 1 || image.height < 1 || image.width > maxSide || image.height > maxSide) {
    throw Error("texture " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                ": each side must be 1 to " + std::to_string(maxSide) + " pixels");
  }
  GlTexture texture = makeTexture();
  gl().BindTexture(GL_TEXTURE_2D, texture.name());
  gl().BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl().PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  gl().TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                  image.rgba.data());
  gl().GenerateMipmap(GL_TEXTURE_2D);
  gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrapOf(image.wrapU));
  gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrapOf(image.wrapV));
  gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  const bool offersAnisotropy = gl().EXT_texture_filter_anisotropic || gl().ARB_texture_filter_anisotropic;
  if (offersAnisotropy && !isSoftwareRenderer()) {
    float supported = 1;
    gl().GetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &supported);
    gl().TexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY, std::min(supported, kMaxAnisotropy));
  }
  gl().BindTexture(GL_TEXTURE_2D, 0);
  return texture;
}

} // namespace

SurfaceClass classOf(const Material& material) {
  if (material.isGlass()) {
    return SurfaceClass::Glass;
  }
  switch (material.alphaMode) {
  case AlphaMode::Opaque:
    return SurfaceClass::Opaque;
  case AlphaMode::Mask:
    return SurfaceClass::Masked;
  case AlphaMode::Blend:
    return SurfaceClass::Blended;
  }
  return SurfaceClass::Opaque;
}

SceneBuffers::SceneBuffers(const Scene& scene) : materials_(scene.materials), nodeCount_(scene.nodes.size()) {
  gl().ActiveTexture(GL_TEXTURE0);
  for (const Texture& image : scene.textures) {
    textures_.push_back(upload(image));
  }
  white_ = upload(Texture{1, 1, {255, 255, 255, 255}, Wrap::Repeat, Wrap::Repeat});
  for (const Mesh& mesh : scene.meshes) {
    std::vector<Primitive>& primitives = meshes_.emplace_back();
    for (const host::Primitive& primitive : mesh.primitives) {
      primitives.push_back(upload(primitive));
    }
  }
  for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
    if (scene.nodes[node].mesh < 0) {
      continue;
    }
    for (const Primitive& primitive : meshes_[static_cast<std::size_t>(scene.nodes[node].mesh)]) {
      if (primitive.mode == GL_LINES) {
        continue; // strands
      }
      const Material& look = material(primitive.material);
      draws_.push_back({&primitive, static_cast<int>(node), classOf(look), !look.unlit});
      hasGlass_ = hasGlass_ || draws_.back().tintsLight();
    }
  }
  std::stable_sort(draws_.begin(), draws_.end(),
                   [](const Draw& a, const Draw& b) { return a.primitive->material < b.primitive->material; });
}

GLuint SceneBuffers::textureOf(const Material& material) const {
  return material.texture < 0 ? white_.name() : textures_[static_cast<std::size_t>(material.texture)].name();
}

void SceneBuffers::submit(const Primitive& primitive) {
  constexpr GLsizei kAtOnce = 3 * 8192; // indices, of points, lines or triangles
  gl().BindVertexArray(primitive.vertexArray.name());
  const GLsizei most = Pause::isWanted() ? kAtOnce : primitive.count;
  for (GLsizei first = 0; first < primitive.count; first += most) {
    gl().DrawElements(primitive.mode, std::min(most, primitive.count - first), GL_UNSIGNED_INT,
                      bufferOffset(static_cast<std::size_t>(first) * sizeof(std::uint32_t)));
    Pause::take();
  }
}

bool SceneBuffers::isBesideView(const Primitive& primitive, const glm::dmat4& clipFromNode) {
  bool left = true;
  bool right = true;
  bool below = true;
  bool above = true;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::bvec3 pick((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
    const glm::dvec4 clip = clipFromNode * glm::dvec4(glm::mix(primitive.low, primitive.high, pick), 1);
    left = left && clip.x < -clip.w;
    right = right && clip.x > clip.w;
    below = below && clip.y < -clip.w;
    above = above && clip.y > clip.w;
  }
  return left || right || below || above;
}

void SceneBuffers::requirePose(const std::vector<glm::dmat4>& worldFromNode) const {
  if (worldFromNode.size() != nodeCount_) {
    throw Error("pose of " + std::to_string(worldFromNode.size()) + " matrices: the scene has " +
                std::to_string(nodeCount_) + " nodes");
  }
}

} // namespace host
