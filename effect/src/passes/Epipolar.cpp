#include "passes/Epipolar.h"

#include "optics/Slices.h"

namespace tyndall::passes::epipolar {

namespace {

gl::Definitions with(gl::Definitions definitions, const char* name, int value) {
  definitions.emplace_back(name, value);
  return definitions;
}

// One light's run through the pipeline.
class Pipeline {
public:
  Pipeline(const PassContext& context, Targets& targets, PassRecorder& recorder, const Objects& objects, const In& in)
      : context_(context), gl_(context.gl), targets_(targets), recorder_(recorder), objects_(objects), in_(in),
        definitions_(exact::definitionsOf(in.variant)) {
    const Settings& settings = in.frame->settings;
    table_ = optics::makeSlices(*in.frame, *in.light, settings.slices, settings.samples, in.map.width, in.map.height);
    block_ = table_.block;
    block_.thresholds = glm::vec4(settings.breakThreshold, settings.leastWeight, settings.bendThreshold, 0);
    chooseRow();
  }

  Status run() {
    slices_ = table_.slices;
    samples_ = in_.frame->settings.samples;
    if (Status s = uploadTable(); !s) return s;
    return in_.frame->settings.technique == Technique::Tree ? runTree() : runEpipolar();
  }

private:
  bool coloured() const { return !in_.variant.monochrome || in_.variant.glass; }
  int views() const { return in_.variant.shadowViews == 0 ? 0 : block_.march.w; }

  // Texels of a row and levels of its tree: the coarsest level keeps at least one node of each row, and four if it can.
  void chooseRow() {
    const int texels = std::max({in_.map.width, in_.map.height, 1});
    int top = 2;
    while ((texels >> (2 * (top + 1))) >= 4)
      ++top;
    const int unit = 1 << (2 * top);
    block_.grid.z = (texels + unit - 1) / unit * unit;
    block_.grid.w = top;
    block_.march.w = in_.light->shadow.texture ? static_cast<int>(in_.light->shadow.views.size()) : 0;
  }

  Status uploadTable() {
    const gl::Uint texture = targets_.get(Target::SliceTable, table_.slices, table_.rows);
    if (!texture) return outOfMemory();
    gl_.ActiveTexture(gl::TEXTURE0 + static_cast<gl::Enum>(gl::Unit::Upload));
    gl_.BindTexture(gl::TEXTURE_2D, texture);
    gl_.TexSubImage2D(gl::TEXTURE_2D, 0, 0, 0, table_.slices, table_.rows, gl::RGBA, gl::FLOAT, table_.texels.data());
    bindTexture(context_, gl::Unit::SliceTable, gl::TEXTURE_2D, texture);
    return {};
  }

  void bindInputs() {
    bindTexture(context_, gl::Unit::SceneDepth, gl::TEXTURE_2D, in_.frame->depth.texture);
    bindTexture(context_, gl::Unit::SliceTable, gl::TEXTURE_2D,
                targets_.get(Target::SliceTable, table_.slices, table_.rows));
    if (in_.variant.shadowViews == 0) return;
    const gl::Enum target = in_.variant.shadowArray ? gl::TEXTURE_2D_ARRAY : gl::TEXTURE_2D;
    bindTexture(context_, gl::Unit::ShadowMap, target, in_.light->shadow.texture);
    if (!in_.variant.glass) return;
    bindTexture(context_, gl::Unit::GlassColour, target, in_.light->glass.colour);
    bindTexture(context_, gl::Unit::GlassDepth, target, in_.light->glass.depth);
  }

  // Uploads the block for a draw through one view; the draw for the first brings what lies outside all views.
  void selectView(int view) {
    block_.march = glm::ivec4(view, 2 + 2 * view, view == 0 ? 1 : 0, block_.march.w);
    in_.upload(2, &block_, sizeof block_);
  }

  // Binds one of our textures as the target of the next draws; makes it at that size first.
  Status target(Target which, int width, int height) {
    const gl::Uint texture = targets_.get(which, width, height, coloured());
    if (!texture) return outOfMemory();
    gl_.BindFramebuffer(gl::DRAW_FRAMEBUFFER, objects_.scratch.name());
    gl_.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, gl::COLOR_ATTACHMENT0, gl::TEXTURE_2D, texture, 0);
    const gl::Enum buffer = gl::COLOR_ATTACHMENT0;
    gl_.DrawBuffers(1, &buffer);
    gl_.Viewport(0, 0, width, height);
    return {};
  }

  void bindOwn(gl::Unit unit, Target which, int width, int height) {
    bindTexture(context_, unit, gl::TEXTURE_2D, targets_.get(which, width, height, coloured()));
  }

  Status draw(const std::string& pass, const std::string& fragment, const gl::Definitions& definitions) {
    const bool ok =
        recorder_.run(in_.name + " " + pass, [&] { return drawFullScreen(context_, fragment, definitions); });
    return ok ? Status{} : shaderError();
  }

  Status shaderError() const {
    return {StatusCode::ShaderError, "a shader did not build: " + context_.programs.error()};
  }
  static Status outOfMemory() { return {StatusCode::OutOfMemory, "GL could not allocate an epipolar texture"}; }

  int treeNodes() const {
    int nodes = 0;
    for (int level = 2; level <= block_.grid.w; ++level)
      nodes += block_.grid.z >> (2 * level);
    return nodes;
  }

  // The shadow map along every slice, and its tree: glsl/passes/rowDepths, rowNodes, rowTree.
  Status buildRows(int view) {
    selectView(view);
    bindInputs();
    setBlend(context_, Blend::Replace);
    const int texels = block_.grid.z;
    if (Status s = target(Target::RowDepths, slices_, texels / 4); !s) return s;
    if (Status s = draw("rows", "passes/rowDepths.frag", definitions_); !s) return s;
    bindOwn(gl::Unit::RowDepths, Target::RowDepths, slices_, texels / 4);
    if (Status s = target(Target::RowNodes, slices_, texels / 16); !s) return s;
    if (Status s = draw("nodes", "passes/rowNodes.frag", definitions_); !s) return s;
    bindOwn(gl::Unit::RowNodes, Target::RowNodes, slices_, texels / 16);
    if (Status s = target(Target::RowTree, slices_, treeNodes()); !s) return s;
    if (Status s = draw("tree", "passes/rowTree.frag", definitions_); !s) return s;
    bindOwn(gl::Unit::RowTree, Target::RowTree, slices_, treeNodes());
    return {};
  }

  // Every pixel through its slice's tree.
  Status runTree() {
    Blend blend = in_.blend;
    for (int view = 0; view < std::max(views(), 1); ++view) {
      if (views() > 0)
        if (Status s = buildRows(view); !s) return s;
      selectView(view);
      bindInputs();
      if (Status s = in_.attachDestination(false, view == 0); !s) return s;
      setBlend(context_, blend);
      if (Status s = draw("pixels", "passes/pixelTree.frag", definitions_); !s) return s;
      blend = Blend::Add;
    }
    return {};
  }

  Status runEpipolar() {
    selectView(0);
    bindInputs();
    setBlend(context_, Blend::Replace);
    if (Status s = classify(); !s) return s;
    const int draws = std::max(views(), 1);
    for (int view = 0; view < draws; ++view) {
      if (views() > 0)
        if (Status s = buildRows(view); !s) return s;
      if (Status s = marchRegular(view); !s) return s;
    }
    if (Status s = refine(); !s) return s;
    for (int view = 0; view < draws; ++view) {
      if (views() > 1) // only the last view's rows are at hand
        if (Status s = buildRows(view); !s) return s;
      if (Status s = marchExtra(view); !s) return s;
    }
    setBlend(context_, Blend::Replace);
    bindOwn(gl::Unit::Marched, Target::Marched, slices_, samples_ / 16 + 1);
    bindOwn(gl::Unit::Extra, Target::Extra, slices_, samples_);
    if (Status s = target(Target::EpipolarInscatter, slices_, samples_); !s) return s;
    if (Status s = draw("interpolate", "passes/interpolate.frag", definitions_); !s) return s;
    bindOwn(gl::Unit::EpipolarInscatter, Target::EpipolarInscatter, slices_, samples_);
    return unwarp();
  }

  // Ray ends at all samples, and which of them to march: glsl/passes/sampleEnds, marks.
  Status classify() {
    if (Status s = target(Target::SampleEnds, slices_, samples_); !s) return s;
    if (Status s = draw("sample ends", "passes/sampleEnds.frag", definitions_); !s) return s;
    bindOwn(gl::Unit::SampleEnds, Target::SampleEnds, slices_, samples_);
    if (Status s = target(Target::Marks, slices_, samples_ / 64); !s) return s;
    if (Status s = draw("marks", "passes/marks.frag", definitions_); !s) return s;
    bindOwn(gl::Unit::Marks, Target::Marks, slices_, samples_ / 64);
    return {};
  }

  // Inscatter at the regular march samples through one view: glsl/passes/march.
  Status marchRegular(int view) {
    selectView(view);
    setBlend(context_, view == 0 ? Blend::Replace : Blend::Add);
    if (Status s = target(Target::Marched, slices_, samples_ / 16 + 1); !s) return s;
    return draw("march", "passes/march.frag", with(definitions_, "EXTRA", 0));
  }

  // More of them where the inscatter bends: glsl/passes/refine.
  Status refine() {
    setBlend(context_, Blend::Replace);
    bindOwn(gl::Unit::Marched, Target::Marched, slices_, samples_ / 16 + 1);
    if (Status s = target(Target::RefinedMarks, slices_, samples_ / 64); !s) return s;
    if (Status s = draw("refine", "passes/refine.frag", definitions_); !s) return s;
    bindOwn(gl::Unit::Marks, Target::RefinedMarks, slices_, samples_ / 64);
    return {};
  }

  // Inscatter at the marked samples between: glsl/passes/strips, march.
  Status marchExtra(int view) {
    selectView(view);
    setBlend(context_, view == 0 ? Blend::Replace : Blend::Add);
    if (Status s = target(Target::Extra, slices_, samples_); !s) return s;
    const int instances = (slices_ + 7) / 8 * (samples_ / 64);
    const bool ok = recorder_.run(in_.name + " march extra", [&] {
      return drawStrips(context_, "passes/strips.vert", instances, "passes/march.frag", with(definitions_, "EXTRA", 1));
    });
    return ok ? Status{} : shaderError();
  }

  // To the pixels; those that no sample serves keep their stencil for the fix-up.
  Status unwarp() {
    const Frame& frame = *in_.frame;
    if (Status s = in_.attachDestination(true, true); !s) return s;
    const gl::Int zero = 0;
    gl_.StencilMask(0xFF);
    gl_.ClearBufferiv(gl::STENCIL, 0, &zero);
    gl_.Enable(gl::STENCIL_TEST);
    gl_.StencilFunc(gl::ALWAYS, 1, 0xFF);
    gl_.StencilOp(gl::KEEP, gl::KEEP, gl::REPLACE);
    setBlend(context_, in_.blend);
    gl::Int busy = 0;
    gl_.GetQueryiv(gl::SAMPLES_PASSED, gl::CURRENT_QUERY, &busy); // the engine's own query may be under way
    if (!busy) gl_.BeginQuery(gl::SAMPLES_PASSED, objects_.fixup.name());
    Status status = draw("unwarp", "passes/unwarp.frag", definitions_);
    if (!busy) gl_.EndQuery(gl::SAMPLES_PASSED);
    const auto pixels = static_cast<gl::Uint64>(frame.width) * static_cast<gl::Uint64>(frame.height);
    gl::Uint64 served = 0;
    if (!busy) gl_.GetQueryObjectui64v(objects_.fixup.name(), gl::QUERY_RESULT, &served);
    recorder_.countFixup(pixels - served);
    if (status && served == pixels) recorder_.skip(in_.name + " fix-up", "every pixel was served");
    if (status && served < pixels) status = fixUp();
    gl_.Disable(gl::STENCIL_TEST);
    return status;
  }

  // The pixels that are left, along their slice's tree. With several views only the last one's rows are at hand: those
  // pixels then walk every texel.
  Status fixUp() {
    gl_.StencilFunc(gl::EQUAL, 0, 0xFF);
    gl_.StencilOp(gl::KEEP, gl::KEEP, gl::KEEP);
    return draw("fix-up", views() > 1 ? "passes/exact.frag" : "passes/pixelTree.frag", definitions_);
  }

  const PassContext& context_;
  const gl::Functions& gl_;
  Targets& targets_;
  PassRecorder& recorder_;
  const Objects& objects_;
  const In& in_;
  gl::Definitions definitions_;
  optics::SliceTable table_;
  blocks::EpipolarBlock block_{};
  int slices_ = 0;
  int samples_ = 0;
};

} // namespace

Status run(const PassContext& context, Targets& targets, PassRecorder& recorder, const Objects& objects, const In& in) {
  return Pipeline(context, targets, recorder, objects, in).run();
}

std::vector<std::pair<std::string, gl::Definitions>> allVariants() {
  std::vector<std::pair<std::string, gl::Definitions>> all;
  for (const exact::Variant& variant : exact::allVariants()) {
    if (variant.multisampled || variant.lightKind == 3) continue;
    const gl::Definitions definitions = exact::definitionsOf(variant);
    all.emplace_back("passes/pixelTree.frag", definitions);
    if (variant.composite) continue;
    for (const int extra : {0, 1})
      all.emplace_back("passes/march.frag", with(definitions, "EXTRA", extra));
  }
  return all;
}

} // namespace tyndall::passes::epipolar
