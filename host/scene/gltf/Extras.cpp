#include "Extras.h"

#include "Convert.h"
#include "Fields.h"

#include <algorithm>
#include <cmath>
#include <scene/Smoke.h>
#include <scene/Strands.h>

namespace host::gltf {

namespace {

constexpr int kMaxParticles = 100000;
constexpr double kMaxNumber = 1e15; ///< beyond it the squares of lengths leave what a float holds

/// extras.tyndall.NAME of an element.
std::optional<Fields> extrasOf(Document& document, nlohmann::json& element, const std::string& where,
                               const char* name) {
  const auto extras = element.find("extras");
  if (extras == element.end() || !extras->is_object() || !extras->contains("tyndall")) return std::nullopt;
  Fields tyndall(document, (*extras)["tyndall"], where + ".extras.tyndall");
  nlohmann::json* object = tyndall.object(name);
  if (object == nullptr) return std::nullopt;
  return Fields(document, *object, tyndall.path(name));
}

void requireKeys(const Fields& fields, std::initializer_list<const char*> keys) {
  for (const auto& [key, value] : fields.value().items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    std::string list;
    for (const char* known : keys)
      list += (list.empty() ? "" : ", ") + std::string(known);
    fields.refuse(printable(key).c_str(), "is unknown, must be one of " + list);
  }
}

enum class Least { Zero, AboveZero };

void read(Fields& fields, const char* key, Least least, double most, double& value) {
  const std::optional<double> number = fields.number(key);
  if (!number) return;
  if (*number <= most && (least == Least::Zero ? *number >= 0 : *number > 0)) {
    value = *number;
    return;
  }
  const std::string low = least == Least::Zero ? "at least 0" : "greater than 0";
  fields.refuse(key,
                "must be " + low + (most < kMaxNumber ? " and at most " + nlohmann::json(most).dump() : " and finite"));
}

void read(Fields& fields, const char* key, int low, int high, int& value) {
  if (const auto number = fields.integer(key, low, high)) value = static_cast<int>(*number);
}

/// Three numbers in [low, high].
template <class Vector>
void read(Fields& fields, const char* key, double low, double high, const char* rule, Vector& value) {
  fields.numbers(key, 3);
  if (!fields.has(key)) return;
  for (int i = 0; i < 3; ++i) {
    const auto number = fields.value()[key][static_cast<std::size_t>(i)].get<double>();
    if (!(number >= low && number <= high)) fields.refuse(key, rule);
    value[i] = static_cast<typename Vector::value_type>(number);
  }
}

SmokeEmitter smokeOf(Fields& fields) {
  requireKeys(fields, {"particles", "radius", "growth", "density", "spread", "height", "rise", "drift", "turbulence",
                       "albedo", "seed"});
  SmokeEmitter smoke;
  read(fields, "particles", 1, kMaxParticles, smoke.particles);
  read(fields, "radius", Least::AboveZero, kMaxNumber, smoke.radius);
  read(fields, "growth", Least::AboveZero, 1000, smoke.growth);
  read(fields, "density", Least::Zero, kMaxNumber, smoke.density);
  read(fields, "spread", Least::Zero, kMaxNumber, smoke.spread);
  read(fields, "height", Least::AboveZero, kMaxNumber, smoke.height);
  read(fields, "rise", Least::AboveZero, kMaxNumber, smoke.rise);
  read(fields, "drift", -kMaxNumber, kMaxNumber, "must be finite", smoke.drift);
  read(fields, "turbulence", Least::Zero, kMaxNumber, smoke.turbulence);
  read(fields, "albedo", 0, 1, "must be 3 numbers from 0 to 1", smoke.albedo);
  read(fields, "seed", 0, std::numeric_limits<std::int32_t>::max(), smoke.seed);
  return smoke;
}

FogBank fogOf(Fields& fields) {
  requireKeys(fields, {"shape", "extinction", "fade", "billows", "clear", "seed"});
  FogBank fog;
  if (fields.has("shape")) {
    const nlohmann::json& shape = fields.value()["shape"];
    if (shape != "box" && shape != "sphere") fields.refuse("shape", "must be box or sphere");
    fog.sphere = shape == "sphere";
  }
  read(fields, "extinction", Least::Zero, kMaxNumber, fog.extinction);
  read(fields, "fade", Least::Zero, 1, fog.fade);
  constexpr int kMostBillows = 32;
  glm::dvec3 billows(fog.billows);
  const char* rule = "must be 3 whole numbers from 1 to 32";
  read(fields, "billows", 1, kMostBillows, rule, billows);
  fog.billows = glm::ivec3(billows);
  if (glm::dvec3(fog.billows) != billows) fields.refuse("billows", rule);
  read(fields, "clear", Least::Zero, 1, fog.clear);
  read(fields, "seed", 0, std::numeric_limits<std::int32_t>::max(), fog.seed);
  return fog;
}

void readStrand(Document& document, nlohmann::json& element, const std::string& where, Strand& strand) {
  std::optional<Fields> fields = extrasOf(document, element, where, "strand");
  if (!fields) return;
  requireKeys(*fields, {"width", "opacity"});
  read(*fields, "width", Least::AboveZero, kMaxNumber, strand.width);
  read(*fields, "opacity", Least::Zero, 1, strand.opacity);
}

} // namespace

void convertSmoke(Document& document, const std::vector<int>& sceneNodes, Scene& scene) {
  for (std::size_t node = 0; node < sceneNodes.size(); ++node) {
    if (sceneNodes[node] < 0) continue;
    const std::string where = at("nodes", node);
    std::optional<Fields> fields = extrasOf(document, document.json["nodes"][node], where, "smoke");
    if (!fields) continue;
    SmokeEmitter smoke = smokeOf(*fields);
    smoke.node = sceneNodes[node];
    document.spend(static_cast<std::uint64_t>(smoke.particles) * sizeof(SmokeParticle), fields->path());
    scene.smoke.push_back(smoke);
  }
}

void convertFog(Document& document, const std::vector<int>& sceneNodes, Scene& scene) {
  for (std::size_t node = 0; node < sceneNodes.size(); ++node) {
    if (sceneNodes[node] < 0) continue;
    std::optional<Fields> fields = extrasOf(document, document.json["nodes"][node], at("nodes", node), "fog");
    if (!fields) continue;
    if (!scene.smoke.empty()) document.refuse(fields->path(), "a scene has smoke or banks of fog, not both");
    if (scene.fog.size() == kMostFogBanks)
      document.refuse(fields->path(), "a scene has at most " + std::to_string(kMostFogBanks) + " banks of fog");
    scene.fog.push_back(fogOf(*fields));
    scene.fog.back().node = sceneNodes[node];
  }
}

Strand strandOf(Document& document, std::size_t mesh, std::size_t primitive, const Primitive& lines) {
  Strand strand = defaultStrand(lines);
  nlohmann::json& source = document.json["meshes"][mesh]["primitives"][primitive];
  if (source.contains("material")) {
    const auto material = source["material"].get<std::size_t>();
    readStrand(document, document.json["materials"][material], at("materials", material), strand);
  }
  readStrand(document, source, at(at("meshes", mesh, "primitives"), primitive), strand);
  return strand;
}

} // namespace host::gltf
