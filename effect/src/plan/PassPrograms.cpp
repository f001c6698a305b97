// Which programs draw the passes of the table.
#include "plan/General.h"
#include "plan/Passes.h"

#include <utility>

namespace tyndall {

namespace {

// The vertex shader of a shape, and how it tells apart what it draws (glsl/lib/partly.glsl).
struct Vertices {
  const char* shader;
  int along = kUndefined;
  int whole = 0, changed = 3; // vertices from which on it draws all, or what has changed
};

Vertices verticesOf(Shape shape) {
  constexpr const char *kStrips = "passes/strips.vert", *kChangedStrips = "passes/changedStrips.vert",
                       *kMarch = "passes/march.vert";
  switch (shape) {
  case Shape::Image:
    return {"passes/tiles.vert"};
  case Shape::Slices:
    return {kChangedStrips, 0};
  case Shape::Segments:
    return {kMarch, 1};
  case Shape::ImageOfMarch:
    return {kMarch, 1, 9, 12};
  case Shape::Columns:
    return {kChangedStrips, 2};
  case Shape::Rows:
    return {kChangedStrips, 3};
  case Shape::StripsOfSlices:
  case Shape::StripsOfRows:
    return {kStrips, kUndefined, 0, 6};
  case Shape::Samples:
    return {"passes/debugSamples.vert"};
  default:
    return {gl::kFullScreen};
  }
}

// Every choice of values for the options from the i-th on.
void addOptions(const std::vector<Option>& options, std::size_t i, gl::Definitions chosen,
                std::vector<gl::Definitions>& all) {
  if (i == options.size()) {
    all.push_back(std::move(chosen));
    return;
  }
  for (const int value : options[i].values) {
    gl::Definitions with = chosen;
    if (value != kUndefined && options[i].values.size() > 1) with.emplace_back(options[i].name, value);
    addOptions(options, i + 1, std::move(with), all);
  }
}

void addVariants(Pass pass, const LightVariant& light, std::vector<gl::Variant>& all) {
  const PassRow& row = rowOf(pass);
  std::vector<gl::Definitions> choices;
  addOptions(row.options, 0, {}, choices);
  for (const gl::Definitions& options : choices)
    if (!row.occurs || row.occurs({light, options})) all.push_back(variantOf(pass, light, options));
}

} // namespace

gl::Variant variantOf(Pass pass, const LightVariant& light, const gl::Definitions& options) {
  const PassRow& row = rowOf(pass);
  const Vertices vertices = verticesOf(row.shape);
  gl::Definitions definitions = row.ofLights ? definitionsOf(light) : gl::Definitions{};
  definitions.insert(definitions.end(), options.begin(), options.end());
  for (const Option& option : row.options) // without a choice they are the row's own
    if (option.values.size() == 1) definitions.emplace_back(option.name, option.values.front());
  if (vertices.along != kUndefined) definitions.emplace_back("ALONG", vertices.along);
  return {row.fragment, general(row.fragment, std::move(definitions)), vertices.shader};
}

int firstVertexOf(Pass pass, bool changes) {
  const Vertices vertices = verticesOf(rowOf(pass).shape);
  return changes ? vertices.changed : vertices.whole;
}

std::vector<gl::Variant> allVariants(bool dualSource, bool cubeArrays) {
  std::vector<gl::Variant> all;
  for (std::size_t i = 0; i < static_cast<std::size_t>(Pass::Count); ++i) {
    const auto pass = static_cast<Pass>(i);
    if (!rowOf(pass).ofLights) {
      LightVariant any;
      any.dualSource = dualSource;
      any.cubeArrays = cubeArrays;
      addVariants(pass, any, all);
      continue;
    }
    for (const LightVariant& light : allLightVariants(dualSource))
      addVariants(pass, light, all);
  }
  return all;
}

} // namespace tyndall
