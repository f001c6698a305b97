// Meshes, cameras, lights, nodes, scenes and animations: types, required members and indices.
#include "Check.h"
#include "Fields.h"

namespace host::gltf {

namespace {

constexpr const char* kLights = "KHR_lights_punctual";

void checkPrimitive(Fields primitive) {
  Document& document = primitive.document();
  primitive.integer("mode", 0, 6);
  primitive.index("indices", "accessors");
  if (const auto material = primitive.integer("material", 0, std::numeric_limits<std::int32_t>::max())) {
    if (static_cast<std::size_t>(*material) >= document.count("materials")) {
      document.note(primitive.path("material"), "there is no such material; the default one is taken");
      primitive.value().erase("material");
    }
  }
  Fields attributes(document, *primitive.object("attributes", Need::Required), primitive.path("attributes"));
  std::optional<std::int64_t> count;
  for (const auto& [name, value] : attributes.value().items()) {
    const std::int64_t accessor = attributes.requiredIndex(name.c_str(), "accessors");
    const auto elements = document.json["accessors"][static_cast<std::size_t>(accessor)]["count"].get<std::int64_t>();
    if (count.value_or(elements) != elements) attributes.refuse(name.c_str(), "attributes differ in their counts");
    count = elements;
  }
  if (primitive.value().erase("targets") > 0) document.note(primitive.path("targets"), "morph targets are ignored");
}

void checkMesh(Fields mesh) {
  const nlohmann::json* primitives = mesh.array("primitives", Need::Required);
  if (primitives->empty()) mesh.refuse("primitives", "must not be empty");
  mesh.each("primitives", Need::Required, checkPrimitive);
}

void checkCamera(Fields camera) {
  const std::string type = camera.string("type", Need::Required, {"perspective", "orthographic"});
  Fields lens(camera.document(), *camera.object(type.c_str(), Need::Required), camera.path(type.c_str()));
  const bool isPerspective = type == "perspective";
  for (const char* key : {"xmag", "ymag", "zfar"}) {
    lens.number(key, isPerspective ? Need::Optional : Need::Required);
  }
  lens.number("yfov", isPerspective ? Need::Required : Need::Optional);
  lens.number("znear", Need::Required);
  lens.number("aspectRatio");
  const char* other = isPerspective ? "orthographic" : "perspective";
  if (camera.has(other)) camera.document().note(camera.path(other), "is ignored, as the type says otherwise");
}

void checkLight(Fields light) {
  const std::string type = light.string("type", Need::Required, {"directional", "point", "spot"});
  light.numbers("color", 3);
  light.number("intensity");
  light.number("range");
  if (type != "spot") return;
  Fields spot(light.document(), *light.object("spot", Need::Required), light.path("spot"));
  spot.number("innerConeAngle");
  spot.number("outerConeAngle");
}

/// The root's extension object; after this json["extensions"][kLights]["lights"] is an array, if it is there.
void checkLights(Fields& root) {
  nlohmann::json* extensions = root.object("extensions");
  if (extensions == nullptr || !extensions->contains(kLights)) return;
  Fields lights(root.document(), (*extensions)[kLights], std::string("extensions.") + kLights);
  lights.each("lights", Need::Required, checkLight);
}

void checkNode(Fields node) {
  Document& document = node.document();
  node.index("mesh", "meshes");
  node.index("camera", "cameras");
  node.indices("children", "nodes");
  node.numbers("matrix", 16);
  node.numbers("translation", 3);
  node.numbers("rotation", 4);
  node.numbers("scale", 3);
  for (const char* key : {"translation", "rotation", "scale"}) {
    if (node.has("matrix") && node.has(key)) node.refuse(key, "must not be given beside a matrix");
  }
  if (node.has("skin")) document.note(node.path("skin"), "skins are ignored");
  nlohmann::json* extensions = node.object("extensions");
  if (extensions == nullptr || !extensions->contains(kLights)) return;
  Fields light(document, (*extensions)[kLights], node.path("extensions.KHR_lights_punctual"));
  const auto count = static_cast<std::int64_t>(document.lightCount());
  if (count == 0) light.refuse("light", "the file has no lights");
  light.integer("light", 0, count - 1, Need::Required);
}

void checkSampler(Fields sampler) {
  sampler.index("input", "accessors", Need::Required);
  sampler.index("output", "accessors", Need::Required);
  sampler.string("interpolation", Need::Optional, {"STEP", "LINEAR", "CUBICSPLINE"});
}

void checkAnimation(Fields animation) {
  Document& document = animation.document();
  animation.each("samplers", Need::Required, checkSampler);
  const auto samplers = static_cast<std::int64_t>(animation.array("samplers")->size());
  animation.each("channels", Need::Required, [&](Fields channel) {
    if (samplers == 0) channel.refuse("sampler", "the animation has no samplers");
    channel.integer("sampler", 0, samplers - 1, Need::Required);
    Fields target(document, *channel.object("target", Need::Required), channel.path("target"));
    target.string("path", Need::Required);
    target.index("node", "nodes");
  });
}

} // namespace

void checkGraph(Document& document) {
  Fields root(document, document.json, "");
  root.each("meshes", Need::Optional, checkMesh);
  root.each("cameras", Need::Optional, checkCamera);
  checkLights(root);
  root.each("nodes", Need::Optional, checkNode);
  root.each("scenes", Need::Optional, [](Fields scene) { scene.indices("nodes", "nodes"); });
  root.array("scenes");
  root.index("scene", "scenes");
  root.each("animations", Need::Optional, checkAnimation);
}

} // namespace host::gltf
