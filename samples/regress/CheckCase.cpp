#include "CheckCase.h"

#include "Digest.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <render/Outputs.h>
#include <render/RenderFrame.h>
#include <scene/Error.h>
#include <scene/ImageFile.h>

namespace regress {

namespace {

struct Rendering {
  HdrPicture picture;
  std::string driver;
  std::vector<std::string> notes;
};

/// The last of its frames.
Rendering rendered(const Case& one, const Run& run) {
  render::Options options = one.options;
  options.context = run.context;
  render::FrameRenderer renderer(options);
  const render::FrameRange range = options.frames.value_or(render::FrameRange{});
  for (int frame = range.first; frame <= range.last; ++frame)
    renderer.render(frame);
  if (options.strict && !renderer.notes().empty())
    throw host::Error("--strict allows no notes: " + renderer.notes().front());
  return {hdrOf(renderer.readPicture(), options), renderer.context().driver(), renderer.notes()};
}

void writePng(const Case& one, const Results& results, Result& result, const char* kind,
              const std::vector<std::uint8_t>& bytes, int width, int height) {
  host::writePng(results.pictureFile(one.name, kind), width, height, bytes);
  result.pictures.emplace_back(kind);
}

void noteDifferentOptions(const Case& one, const Reference& reference, Result& result) {
  if (reference.words == one.words) return;
  result.notes.push_back(
      fmt::format("the reference was recorded with other options: {}", fmt::join(reference.words, " ")));
}

/// Where the difference's colours are full: far beyond the tolerance, and where few pixels are.
double rangeOf(const Difference& difference, const Tolerance& tolerance) {
  constexpr double kBeyond = 5, kLeast = 1e-3;
  return std::max(kLeast, std::min(difference.max, std::max(difference.p99 / 2, kBeyond * tolerance.pixel)));
}

void judgePicture(const Case& one, const HdrPicture& wanted, const HdrPicture& got, Result& result) {
  result.difference = compare(wanted, got, one.tolerance.pixel, one.options, exposureOf(wanted, one.options));
  const std::vector<Judgement> judgements = judge(*result.difference, one.tolerance);
  const bool isKept = std::all_of(judgements.begin(), judgements.end(), [](const Judgement& j) { return j.isKept(); });
  result.verdict = isKept ? Verdict::Same : Verdict::Different;
  result.isEqual = result.difference->max == 0 && result.difference->notFinite == 0;
  result.range = rangeOf(*result.difference, one.tolerance);
}

void writePictures(const Case& one, const Results& results, const Rendering& rendering,
                   const std::optional<Reference>& reference, Result& result) {
  const float exposure = exposureOf(reference ? reference->picture : rendering.picture, one.options);
  const int width = one.options.width, height = one.options.height;
  const auto display = [&](const char* kind, const HdrPicture& picture) {
    writePng(one, results, result, kind, render::displayed(picture.rgb, one.options, exposure), width, height);
  };
  display("got", rendering.picture);
  if (!reference) return;
  display("wanted", reference->picture);
  if (result.isEqual) return;
  writePng(one, results, result, "difference", differenceColours(reference->picture, rendering.picture, result.range),
           rendering.picture.width, rendering.picture.height);
}

} // namespace

std::vector<std::string> recordCase(const Case& one, const Run& run) {
  const Rendering rendering = rendered(one, run);
  std::vector<std::string> notes = rendering.notes;
  const auto notFinite = std::count_if(rendering.picture.rgb.begin(), rendering.picture.rgb.end(),
                                       [](float value) { return !std::isfinite(value); });
  if (notFinite > 0) notes.push_back(fmt::format("{} of the picture's values are NaN or infinite", notFinite));
  run.references.write(one, rendering.picture, {rendering.driver, host::nameOf(run.context), run.commit});
  return notes;
}

void checkCase(const Case& one, const Run& run, const Results& results) {
  const auto start = std::chrono::steady_clock::now();
  Result result = failureOf(one, run, "");
  std::optional<Rendering> rendering;
  std::optional<Reference> reference;
  try {
    rendering = rendered(one, run);
    result.origin.driver = rendering->driver;
    result.notes = rendering->notes;
    reference = run.references.read(one);
    result.recorded = reference->origin;
    noteDifferentOptions(one, *reference, result);
    judgePicture(one, reference->picture, rendering->picture, result);
  } catch (const std::exception& error) {
    result.message = error.what();
  }
  if (rendering) writePictures(one, results, *rendering, reference, result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  results.write(result);
}

Result failureOf(const Case& one, const Run& run, const std::string& message) {
  Result result;
  result.name = one.name;
  result.message = message;
  result.tolerance = one.tolerance;
  result.words = one.words;
  result.origin.context = host::nameOf(run.context);
  result.origin.commit = run.commit;
  result.inputs = inputsOf(one, run.references);
  return result;
}

std::string inputsOf(const Case& one, const References& references) {
  static const std::string program = [] {
    Digest digest;
    digest.addFile("/proc/self/exe");
    return digest.text();
  }();
  Digest digest;
  digest.add(program);
  for (const std::string& word : one.words)
    digest.add(word);
  const Tolerance& t = one.tolerance;
  digest.add(fmt::format("{} {} {} {} {} {}", t.rRmse, t.p99, t.max, t.pixel, t.over, t.flip.value_or(-1)));
  digest.addFile(one.options.scene);
  if (one.options.mediumFile) digest.addFile(*one.options.mediumFile);
  digest.add(fmt::format("{}", references.digestOf(one.name)));
  return digest.text();
}

} // namespace regress
