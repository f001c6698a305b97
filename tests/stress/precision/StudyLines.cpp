// The lines of the study, from the effect's table of targets.
#include "Study.h"
#include "gl/Enums.h"
#include "plan/Resources.h"

#include <algorithm>

namespace precision {

namespace {

using tyndall::Resource;

std::string nameOf(tyndall::gl::Enum format) {
  static const std::map<tyndall::gl::Enum, std::string> names = {
      {tyndall::gl::R8, "R8"},           {tyndall::gl::R32F, "R32F"},       {tyndall::gl::RG32F, "RG32F"},
      {tyndall::gl::RGBA32F, "RGBA32F"}, {tyndall::gl::RGBA16F, "RGBA16F"}, {tyndall::gl::RG16, "RG16"},
      {tyndall::gl::RGBA16, "RGBA16"},   {tyndall::gl::RGBA8, "RGBA8"}};
  return names.at(format);
}

// Pairs of a least and a greatest depth.
bool isBound(Resource resource) {
  return resource == Resource::RowNodes || resource == Resource::RowTree || resource == Resource::PairTree ||
         resource == Resource::ChangedParts;
}

void add(std::vector<Line>& lines, const tyndall::ResourceRow& row, Resource resource, tyndall::gl::Enum format) {
  const auto isOurs = [&](const Line& line) { return line.name == row.study && line.format == nameOf(format); };
  auto line = std::find_if(lines.begin(), lines.end(), isOurs);
  if (line == lines.end()) line = lines.insert(lines.end(), {row.study, nameOf(format), {}, isBound(resource)});
  if (line->targets.empty() || line->targets.back() != row.name) line->targets.emplace_back(row.name);
}

std::vector<Line> makeLines() {
  std::vector<Line> lines;
  for (int i = 0; i < static_cast<int>(Resource::Count); ++i) {
    const auto resource = static_cast<Resource>(i);
    const tyndall::ResourceRow& row = tyndall::rowOf(resource);
    if (std::string(row.study).empty()) continue;
    add(lines, row, resource, row.wide.internal);
    add(lines, row, resource, row.narrow.internal);
  }
  return lines;
}

} // namespace

const std::vector<Line>& studyLines() {
  static const std::vector<Line> lines = makeLines();
  return lines;
}

} // namespace precision
