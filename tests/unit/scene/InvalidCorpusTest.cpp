// The Khronos validator's corpus of broken files: what leaves geometry, camera or light undefined is refused, and
// nothing else is.
#include "GltfFile.h"
#include "support/Catch.h"

#include <fstream>
#include <map>
#include <scene/Error.h>
#include <scene/GltfLoader.h>
#include <sstream>

namespace tests {

namespace {

const std::filesystem::path kCorpus = std::filesystem::path(TYNDALL_SHARED_DIR) / "data/gltf_invalid";

/// Beginnings of the validator's error codes after which geometry, camera, light or their motion is undefined.
const char* const kUndefining[] = {"ACCESSOR_",
                                   "ANIMATION_",
                                   "ASSET_MIN_VERSION",
                                   "BUFFER_",
                                   "CAMERA_",
                                   "GLB_",
                                   "INVALID_JSON",
                                   "INVALID_URI",
                                   "IO_ERROR",
                                   "KHR_LIGHTS_",
                                   "MESH_",
                                   "NODE_LOOP",
                                   "NODE_MATRIX_",
                                   "NODE_PARENT_OVERRIDE",
                                   "PATTERN_MISMATCH",
                                   "SCENE_NON_ROOT_NODE",
                                   "TYPE_MISMATCH",
                                   "UNDEFINED_PROPERTY",
                                   "UNKNOWN_ASSET_MAJOR_VERSION",
                                   "UNRESOLVED_REFERENCE",
                                   "VALUE_NOT_IN_RANGE"};

const char* const kLook = "only a material's look depends on it";
const char* const kSkin = "skins are ignored";
const char* const kMorph = "morph targets are ignored";
const char* const kBounds = "the bounds that a file states are not used";
const char* const kUnread = "nothing in the file reads it";

/// Files with one of these codes that load nevertheless, and why.
const std::map<std::string, const char*> kAccepted = {
    {"KHR_texture_transform/textureInfo/uv_sets.gltf", kLook},
    {"accessor/float_normalized.gltf", "the flag has no meaning for floats"},
    {"accessor_data/invalid_elements_float.gltf", kUnread},
    {"accessor_data/out_of_range_elements_float.gltf", kBounds},
    {"accessor_data/out_of_range_elements_sint16.gltf", kBounds},
    {"accessor_data/out_of_range_elements_sint8.gltf", kBounds},
    {"accessor_data/out_of_range_elements_uint16.gltf", kBounds},
    {"accessor_data/out_of_range_elements_uint32.gltf", kBounds},
    {"accessor_data/out_of_range_elements_uint8.gltf", kBounds},
    {"animation/channel_node_no_morphs.gltf", kMorph},
    {"animation/sampler_input_no_bounds.gltf", kBounds},
    {"buffer/no_bin_chunk.glb", kUnread},
    {"buffer_view/invalid_stride_too_big.gltf", kUnread},
    {"image/invalid_data_uri.gltf", kLook},
    {"image/invalid_data_uri_mime_type.gltf", kLook},
    {"image/invalid_uri_scheme.gltf", kLook},
    {"image/not_found.gltf", kLook},
    {"image/unresolved_buffer_view.gltf", kLook},
    {"material/unresolved_basecolor.gltf", kLook},
    {"material/unresolved_emissive.gltf", kLook},
    {"material/unresolved_mr.gltf", kLook},
    {"material/unresolved_normal.gltf", kLook},
    {"material/unresolved_occlusion.gltf", kLook},
    {"mesh/accessor_attribute_uint32.gltf", "vertex colours that cannot be read are ignored"},
    {"mesh/accessor_unaligned.gltf", "the bytes are inside the buffer"},
    {"mesh/invalid_attribute.gltf", "unknown attributes are ignored"},
    {"mesh/invalid_attribute_escaped_name.gltf", "unknown attributes are ignored"},
    {"mesh/invalid_indexed_attribute.gltf", "unknown attributes are ignored"},
    {"mesh/morph_attribute_invalid_count.gltf", kMorph},
    {"mesh/morph_attribute_no_base.gltf", kMorph},
    {"mesh/morph_position_accessor_no_bounds.gltf", kMorph},
    {"mesh/morph_unequal_targets_count.gltf", kMorph},
    {"mesh/morph_weights_wrong_count.gltf", kMorph},
    {"mesh/position_accessor_no_bounds.gltf", kBounds},
    {"mesh/unequal_joints.gltf", kSkin},
    {"mesh/unresolved_material.gltf", kLook},
    {"mesh/unresolved_morph_positions.gltf", kMorph},
    {"mesh/uv.gltf", kLook},
    {"mesh_data/colors_non_clamped.gltf", "vertex colours are clamped"},
    {"mesh_data/joints_weights_complex.gltf", kSkin},
    {"mesh_data/normals_tangents_non_unit_invalid_sign.gltf", "normals are normalised, tangents ignored"},
    {"node/unresolved_skin.gltf", kSkin},
    {"root/extensions_non_objects.gltf", "unknown extensions are ignored"},
    {"skin/empty_object.gltf", kSkin},
    {"skin/unresolved_ibm.gltf", kSkin},
    {"skin/unresolved_joint.gltf", kSkin},
    {"skin/unresolved_skeleton.gltf", kSkin},
    {"skin_data/invalid_ibm.gltf", kSkin},
    {"texture/unresolved_sampler.gltf", kLook},
    {"texture/unresolved_source.gltf", kLook}};

/// Files in which the validator finds no error, but that leave something undefined, and the message about it.
const std::map<std::string, const char*> kRefusedValid = {
    {"KHR_lights_punctual/light/unknown_type.gltf", "lights[0].type"},
    {"accessor/unknown_type.gltf", "accessors[0].type"},
    {"animation/valid.gltf", "times must be"},
    {"asset/min_version_valid.gltf", "asset.minVersion"},
    {"buffer/data_uri.glb", "must be base64"},
    {"buffer/non_relative_uri.gltf", "other schemes are not read"},
    {"camera/perspective_yfov.gltf", "yfov"},
    {"root/named_objects.gltf", "has no data"},
    {"root/unused_objects.gltf", "has no data"},
    {"skin/ignored_animated_transform.gltf", "times must be"}};

struct Expected {
  std::string file;
  int errors = 0;
  std::string codes;
};

std::vector<Expected> readExpected() {
  std::ifstream stream(kCorpus / "expected.tsv");
  std::vector<Expected> list;
  std::string line;
  std::getline(stream, line); // the column titles
  while (std::getline(stream, line)) {
    std::istringstream columns(line);
    Expected expected;
    std::string errors;
    std::string warnings;
    std::getline(columns, expected.file, '\t');
    std::getline(columns, errors, '\t');
    std::getline(columns, warnings, '\t');
    std::getline(columns, expected.codes, '\t');
    expected.errors = std::stoi(errors);
    list.push_back(expected);
  }
  return list;
}

bool isUndefining(const std::string& codes) {
  std::istringstream list(codes);
  std::string code;
  while (std::getline(list, code, ',')) {
    for (const char* beginning : kUndefining) {
      if (code.rfind(beginning, 0) == 0) return true;
    }
  }
  return false;
}

/// The message with which the file is refused, empty if it loads.
std::string refusal(const std::filesystem::path& file) {
  try {
    host::loadScene(file);
  } catch (const host::Error& error) {
    const std::string message = error.what();
    CHECK(message.rfind(file.string() + ": ", 0) == 0);
    CHECK(message.find('\n') == std::string::npos);
    return message;
  }
  return {};
}

} // namespace

TEST_CASE("Broken files are refused where geometry, camera or light is undefined", "[scene][gltf][shared]") {
  if (!std::filesystem::is_directory(kCorpus)) {
    WARN("skipped: " << kCorpus << " is absent");
    return;
  }
  const std::vector<Expected> corpus = readExpected();
  REQUIRE(corpus.size() == 290);
  int refused = 0;
  for (const Expected& expected : corpus) {
    INFO(expected.file << ": " << expected.codes);
    const std::string message = refusal(kCorpus / expected.file);
    refused += message.empty() ? 0 : 1;
    if (const auto reason = kRefusedValid.find(expected.file); reason != kRefusedValid.end()) {
      CHECK_THAT(message, Catch::Contains(reason->second));
    } else if (expected.errors == 0) {
      CHECK(message.empty());
    } else if (isUndefining(expected.codes)) {
      CHECK(message.empty() == (kAccepted.count(expected.file) > 0));
    }
  }
  CHECK(refused > 100);
}

TEST_CASE("No file of the corpus is more than refused", "[scene][gltf][shared]") {
  if (!std::filesystem::is_directory(kCorpus)) {
    WARN("skipped: " << kCorpus << " is absent");
    return;
  }
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kCorpus)) {
    if (!entry.is_regular_file()) continue;
    INFO(entry.path());
    CHECK_NOTHROW(refusal(entry.path()));
    ++files;
  }
  CHECK(files >= 314);
}

} // namespace tests
