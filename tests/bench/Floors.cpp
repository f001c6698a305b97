#include "Floors.h"

#include "baselines/Drawer.h"
#include "baselines/SharedPhysics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <scene/Error.h>

namespace bench {

namespace {

constexpr std::size_t kMostReads = 8;

/// Texels that each fragment of a pass reads of one texture.
struct Read {
  GLenum format = 0;
  int width = 0, height = 0;
  double texels = 0; ///< a fragment, as a mean
};

struct Pass {
  std::string name;
  std::vector<GLenum> targets; ///< formats
  int width = 0, height = 0;
  std::vector<Read> reads;
  bool blended = false; ///< into the frame's colour, as a composite is
};

/// What the passes of a frame read and write, as effect/src/passes and glsl/passes do.
class Pipeline {
public:
  Pipeline(const tyndall::Frame& frame, const Counts& counts, glm::ivec2 shadowSize)
      : frame_(frame), counts_(counts), shadowSize_(shadowSize),
        shape_(sliceShape(frame, frame.lights[0], shadowSize.x, shadowSize.y)), samples_(frame.settings.samples) {
    for (int nodes = shape_.rowTexels / 16; nodes >= 4 || levels_ == 0; nodes /= 4) {
      treeNodes_ += nodes;
      ++levels_;
    }
    hasGlass_ = frame.lights[0].glass.colour != 0;
    coloured_ = hasGlass_ || !isMonochrome(frame.medium);
    packs_ = static_cast<double>(counts.rays - counts.fixupPixels - shape_.regularSamples);
    packRows_ = std::max(1, static_cast<int>(std::ceil(packs_ / shape_.slices)));
  }

  std::vector<Pass> passes() const {
    std::vector<Pass> all = rowPasses();
    for (const auto& more : {samplePasses(), marchPasses(), pixelPasses()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }

private:
  // The textures, by the names of effect/src/Targets.cpp.
  Read sliceTable(double n) const { return {GL_RGBA32F, shape_.slices, 4, n}; }
  Read sceneDepth(double n) const { return {GL_R32F, frame_.viewport.width, frame_.viewport.height, n}; }
  Read shadowMap(double n) const { return {GL_R32F, shadowSize_.x, shadowSize_.y, n}; }
  Read sampleEnds(double n) const { return {GL_R32F, shape_.slices, samples_, n}; }
  Read marks(double n) const { return {GL_RGBA16, shape_.slices, samples_ / 64, n}; }
  Read offsets(double n) const { return {GL_R32F, shape_.slices, samples_ / 64 + 1, n}; }
  Read marched(double n) const { return {marchedFormat(), shape_.slices, samples_ / 16 + 1, n}; }
  Read extra(double n) const { return {extraFormat(), shape_.slices, samples_ / 2, n}; }
  Read epipolarInscatter(double n) const { return {inscatterFormat(), shape_.slices, samples_, n}; }
  Read rowDepths(double n) const { return {GL_RGBA16, shape_.rowTexels / 4, shape_.slices, n}; }
  Read rowNodes(double n) const { return {GL_RGBA16, shape_.rowTexels / 16, shape_.slices, n}; }
  Read rowTree(double n) const { return {GL_RGBA16, treeNodes_, shape_.slices, n}; }

  GLenum marchedFormat() const { return coloured_ ? GL_RGBA16F : GL_R32F; }
  GLenum extraFormat() const { return coloured_ ? GL_RGBA16F : GL_RG32F; }
  GLenum inscatterFormat() const { return coloured_ ? GL_RGBA16F : GL_RG32F; }

  /// What a ray looks at: nodes and groups of texels, which are not counted apart, half of each. rays: of a
  /// fragment.
  std::vector<Read> withVisits(std::vector<Read> reads, double rays) const {
    const double each = 0.5 * rays * counts_.visitsPerRay.value_or(0);
    reads.push_back(rowTree(each));
    reads.push_back(rowDepths(each));
    return reads;
  }

  /// A pass over one of the textures.
  static Pass over(const std::string& name, const Read& target, std::vector<Read> reads) {
    return {name, {target.format}, target.width, target.height, std::move(reads)};
  }

  std::vector<Pass> rowPasses() const {
    std::vector<Read> maps = {sliceTable(2), shadowMap(4)};
    if (hasGlass_) maps.push_back(shadowMap(4)); // its depths
    const double texelsOfNode = static_cast<double>(levels_) * (shape_.rowTexels / 16) / treeNodes_;
    Pass rows = over("rows", rowDepths(0), maps);
    rows.height = std::max(1, shape_.drawnTexels / 4);
    Pass nodes = over("nodes", rowNodes(0), {rowDepths(4)});
    Pass tree = over("tree", rowTree(0), {rowNodes(texelsOfNode)});
    for (Pass* pass : {&nodes, &tree})
      pass->targets.push_back(GL_RG16); // the averages
    return {rows, nodes, tree};
  }

  std::vector<Pass> samplePasses() const {
    const int chunks = samples_ / 64;
    return {over("sample ends", sampleEnds(0), {sliceTable(2), sceneDepth(5)}),
            over("marks", marks(0), {sliceTable(2), sampleEnds(67)}),
            over("refine", marks(0), {sliceTable(1), marks(1), marched(7)}),
            over("offsets", offsets(0), {marks(0.5 * chunks)})};
  }

  std::vector<Pass> marchPasses() const {
    const double all = static_cast<double>(shape_.slices) * (samples_ / 16 + 1);
    const double share = static_cast<double>(shape_.regularSamples) / all;
    Pass march = over("march", marched(0), withVisits({sliceTable(4), sampleEnds(1)}, share));
    const double chunksBefore = 0.5 * samples_ / 64 + 1;
    Pass extraPass = over("march extra", extra(0),
                          withVisits({sliceTable(4), offsets(chunksBefore), marks(1), sampleEnds(2)},
                                     counts_.packedRays / std::max(packs_, 1.0)));
    extraPass.height = packRows_; // others are not drawn
    if (coloured_) extraPass.targets.resize(2, extraFormat());
    // Each sample lies between two march samples, of which those in segments with extra ones are extra ones.
    const double fromExtra = 2 * std::min(1.0, 0.5 * packs_ / static_cast<double>(shape_.regularSamples));
    const std::vector<Read> between = {sliceTable(2),          marks(1),        offsets(1), sampleEnds(1),
                                       marched(2 - fromExtra), extra(fromExtra)};
    return {march, extraPass, over("interpolate", epipolarInscatter(0), between)};
  }

  std::vector<Pass> pixelPasses() const {
    const auto fixups = static_cast<double>(counts_.fixupPixels);
    const int rows = std::max(1, static_cast<int>(std::ceil(fixups / frame_.viewport.width)));
    const std::vector<GLenum> colour = {GL_RGBA16F};
    return {{"unwarp",
             colour,
             frame_.viewport.width,
             frame_.viewport.height,
             {sceneDepth(1), sliceTable(2), epipolarInscatter(4)},
             true},
            {"fix-up", colour, frame_.viewport.width, rows, withVisits({sceneDepth(1), sliceTable(2)}, 1), true}};
  }

  const tyndall::Frame& frame_;
  const Counts& counts_;
  glm::ivec2 shadowSize_;
  SliceShape shape_;
  int samples_;
  int levels_ = 0, treeNodes_ = 0;
  bool hasGlass_ = false, coloured_ = false;
  double packs_ = 0; ///< of extra march samples
  int packRows_ = 0;
};

/// Draws a pass's floor.
class FloorDraw {
public:
  FloorDraw(Drawer& drawer, const tyndall::Frame& frame, const Pass& pass)
      : drawer_(drawer), frame_(frame), pass_(pass) {
    for (const Read& read : pass.reads)
      reads_.push_back(filled(read.format, read.width, heightOf(read)));
    for (const GLenum format : pass.targets)
      targets_.push_back(filled(format, pass.width, pass.height));
    if (pass.blended) frame_.colour = filled(pass.targets[0], frame.viewport.width, frame.viewport.height);
    draw(); // compiles the shader
  }

  const std::string& name() const { return pass_.name; }

  void run() {
    drawer_.pass("floor", [this] { draw(); });
    milliseconds_.push_back(drawer_.passes().back().milliseconds);
  }

  double median() const {
    std::vector<double> sorted = milliseconds_;
    std::sort(sorted.begin(), sorted.end());
    return sorted.at(sorted.size() / 2);
  }

private:
  /// No smaller than what a fragment reads.
  static int heightOf(const Read& read) { return std::max(read.height, static_cast<int>(std::lround(read.texels))); }

  /// Cleared: pages that nobody wrote would all be one in the cache.
  GLuint filled(GLenum format, int width, int height) {
    const std::string name = fmt::format("{} {}", pass_.name, ++textures_);
    const GLuint texture = drawer_.target(name, format, width, height);
    drawer_.attach({texture}, width, height);
    host::gl().ClearColor(0.25F, 0.25F, 0.25F, 0.25F);
    host::gl().Clear(GL_COLOR_BUFFER_BIT);
    return texture;
  }

  void draw() {
    static const std::vector<const char*> names = {"read0", "read1", "read2", "read3",
                                                   "read4", "read5", "read6", "read7"};
    drawer_.attach(targets_, pass_.width, pass_.height);
    if (pass_.blended) {
      drawer_.attachFinal(frame_, true);
      host::gl().Viewport(0, 0, pass_.width, pass_.height);
    }
    Defines defines = {fmt::format("COMPOSITE {}", pass_.blended ? 1 : 0),
                       fmt::format("TARGETS {}", pass_.targets.size())};
    for (std::size_t i = 0; i < kMostReads; ++i) {
      const Read read = i < reads_.size() ? pass_.reads[i] : Read{GL_R32F, 1, 1, 0};
      defines.push_back(fmt::format("WIDTH_{} {}", i, read.width));
      defines.push_back(fmt::format("HEIGHT_{} {}", i, heightOf(read)));
      defines.push_back(fmt::format("COUNT_{} {}", i, std::lround(read.texels)));
    }
    host::Program& program = drawer_.use("floor.frag", defines, names);
    program.set("scale", 1.0F / glm::vec2(pass_.width, pass_.height));
    for (std::size_t i = 0; i < reads_.size(); ++i)
      drawer_.bind(kOwn + static_cast<int>(i), reads_[i]);
    drawer_.drawFullScreen();
  }

  Drawer& drawer_;
  tyndall::Frame frame_;
  Pass pass_;
  std::vector<GLuint> reads_, targets_;
  std::vector<double> milliseconds_;
  int textures_ = 0;
};

} // namespace

PassFloor sumOf(const std::vector<PassFloor>& passes) {
  PassFloor sum{"sum"};
  for (const PassFloor& pass : passes) {
    sum.milliseconds += pass.milliseconds;
    sum.floor += pass.floor;
  }
  return sum;
}

std::string reasonAgainstFloors(const tyndall::Frame& frame) {
  if (frame.settings.technique != tyndall::Technique::Epipolar) return "it is not technique Epipolar";
  if (frame.settings.errorTarget > 0) return "its slices are chosen";
  if (frame.lights.size() != 1) return "it has not one light";
  const tyndall::Light& light = frame.lights[0];
  if (light.kind != tyndall::LightKind::Directional) return "its light is not directional";
  if (!light.shadow.texture || light.shadow.views.size() != 1) return "its light has not one shadow view";
  return {};
}

struct Floors::State {
  tyndall::Frame frame;
  Drawer drawer;
  std::vector<FloorDraw> draws;
};

Floors::Floors(const tyndall::Frame& frame, const Counts& counts) : state_(new State{frame, {}, {}}) {
  Drawer& drawer = state_->drawer;
  drawer.beginFrame(frame);
  drawer.selectLight(frame, frame.lights[0]);
  for (const Pass& pass : Pipeline(frame, counts, drawer.shadowSize()).passes())
    state_->draws.emplace_back(drawer, frame, pass);
  drawer.timePasses(true);
  drawer.endFrame();
}

Floors::~Floors() = default;

void Floors::run() {
  state_->drawer.beginFrame(state_->frame);
  for (FloorDraw& draw : state_->draws)
    draw.run();
  state_->drawer.endFrame();
}

std::vector<PassFloor> Floors::beside(const std::vector<tyndall::PassStatistics>& passes) const {
  std::vector<PassFloor> floors;
  for (const tyndall::PassStatistics& pass : passes) {
    if (!pass.skipped.empty()) continue;
    const auto found = std::find_if(state_->draws.begin(), state_->draws.end(),
                                    [&](const FloorDraw& draw) { return "light 0 " + draw.name() == pass.name; });
    if (found == state_->draws.end()) throw host::Error("no floor is known for the pass \"" + pass.name + "\"");
    floors.push_back({found->name(), pass.milliseconds, found->median()});
  }
  return floors;
}

} // namespace bench
