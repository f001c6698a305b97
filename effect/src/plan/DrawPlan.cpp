#include "plan/DrawPlan.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tyndall {

namespace {

// What a sampler reads, as the pass has it.
const NamedTexture* textureFor(const Draw& draw, const std::string& sampler) {
  const auto found = std::find_if(draw.reads.begin(), draw.reads.end(),
                                  [&](const NamedTexture& read) { return read.sampler == sampler; });
  return found == draw.reads.end() ? nullptr : &*found;
}

Status defect(const Draw& draw, const std::string& what) {
  return {StatusCode::ShaderError, "a defect of Tyndall: \"" + draw.title + "\" " + what};
}

Status resolve(Draw& draw, gl::ProgramCache& programs, Resolve what) {
  const gl::Program* program = programs.find(draw.variant);
  if (!program) return {StatusCode::ShaderError, "a shader did not build: " + programs.error()};
  draw.program = program->name();
  draw.textures.clear();
  for (const gl::Program::Sampler& sampler : program->samplers()) {
    const NamedTexture* read = textureFor(draw, sampler.name);
    if (!read) return defect(draw, "has a row that does not say that it reads " + sampler.name);
    if (what == Resolve::ToDraw && read->texture == 0 && !read->mayLack)
      return defect(draw, "reads " + sampler.name + ", which nothing has made");
    draw.textures.push_back({sampler.unit, sampler.target, read->texture});
  }
  return {};
}

// Takes no sampler.
bool isMultisampled(gl::Enum target) {
  return target == gl::TEXTURE_2D_MULTISAMPLE || target == gl::TEXTURE_2D_MULTISAMPLE_ARRAY;
}

template <typename Function>
void forEachDraw(const FramePlan& plan, Function&& function) {
  for (const Step& step : plan.steps)
    if (const Draw* draw = std::get_if<Draw>(&step)) function(*draw);
}

// Sets GL state for one draw after the other, of what has changed only.
class Drawer {
public:
  Drawer(const gl::Functions& gl, const DrawObjects& objects, PassRecorder& recorder, BandPaces& paces,
         double bandMilliseconds, const std::function<bool()>& betweenDraws)
      : gl_(gl), objects_(objects), recorder_(recorder), paces_(paces), most_(bandMilliseconds),
        betweenDraws_(betweenDraws) {}

  /// False once betweenDraws did not want the rest; asked before each draw and band but the first.
  bool goesOn();
  bool isAbandoned() const { return isAbandoned_; }

  void begin();
  void operator()(const Upload& upload);
  void operator()(const Clear& clear);
  void operator()(const Copy& copy);
  void operator()(const Draw& draw);
  void operator()(const Skip& skip) { recorder_.skip(skip.pass, skip.why); }
  void end();

private:
  struct Bound {
    gl::Enum target = 0;
    gl::Uint texture = 0;
  };
  void activate(gl::Uint unit);
  void bind(const Draw::Reading& reading);
  void bind(const std::vector<Draw::Reading>& readings);
  void bindFramebuffer(gl::Uint framebuffer);
  void bindBlocks(const Draw& draw);
  void setBlend(Blend blend);
  void setStencil(const Stencil& stencil);
  void setViewport(const Viewport& viewport);
  void setScissor(const Viewport& band);
  void endScissor();
  void submit(double milliseconds);
  void drawVertices(const Draw& draw);
  void drawBands(const Draw& draw);

  const gl::Functions& gl_;
  const DrawObjects& objects_;
  PassRecorder& recorder_;
  BandPaces& paces_;
  std::array<int, 3> blocks_ = {-1, -1, -1};
  std::vector<Bound> units_;
  std::vector<gl::Uint> samplers_; // of the units; 0: none, or the engine's
  gl::Uint active_ = 0, program_ = 0, framebuffer_ = 0;
  Blend blend_ = Blend::Replace;
  Stencil stencil_;
  Viewport viewport_{-1, -1, -1, -1};
  bool scissor_ = false;
  double most_, pending_ = 0; // milliseconds, of what GL gets at once; 0: no limit
  const std::function<bool()>& betweenDraws_;
  bool isDrawing_ = false, isAbandoned_ = false;
};

bool Drawer::goesOn() {
  const bool isFirst = !std::exchange(isDrawing_, true);
  if (!isFirst && betweenDraws_ && !isAbandoned_) isAbandoned_ = !betweenDraws_();
  return !isAbandoned_;
}

void Drawer::begin() {
  gl_.BindVertexArray(objects_.vertexArray);
  gl_.ActiveTexture(gl::TEXTURE0);
}

void Drawer::end() {
  setBlend(Blend::Replace);
  setStencil({});
  endScissor();
}

void Drawer::operator()(const Upload& upload) {
  bind({0, gl::TEXTURE_2D, upload.texture});
  activate(0);
  gl_.TexSubImage2D(gl::TEXTURE_2D, 0, 0, 0, upload.width, upload.height, gl::RGBA, gl::FLOAT, upload.texels.data());
}

void Drawer::operator()(const Clear& clear) {
  endScissor();
  bindFramebuffer(clear.framebuffer);
  if (clear.stencil) {
    const gl::Int zero = 0;
    setStencil({}); // the mask is the clear's
    gl_.StencilMask(clear.stencil);
    gl_.ClearBufferiv(gl::STENCIL, 0, &zero);
  } else {
    gl_.ClearBufferfv(gl::COLOR, 0, &clear.colour.x);
  }
}

void Drawer::operator()(const Copy& copy) {
  const Viewport& from = copy.source;
  endScissor();
  bindFramebuffer(copy.to);
  gl_.BindFramebuffer(gl::READ_FRAMEBUFFER, copy.from);
  recorder_.run(copy.title, [&] {
    gl_.BlitFramebuffer(from.x, from.y, from.x + from.width, from.y + from.height, copy.x, copy.y, copy.x + from.width,
                        copy.y + from.height, gl::COLOR_BUFFER_BIT, gl::NEAREST);
    return true;
  });
}

void Drawer::operator()(const Draw& draw) {
  if (draw.program != program_) gl_.UseProgram(program_ = draw.program);
  bind(draw.textures);
  bindFramebuffer(draw.framebuffer);
  bindBlocks(draw);
  setViewport(draw.viewport);
  setBlend(draw.blend);
  setStencil(draw.stencil);
  recorder_.run(draw.title, [&] { return drawBands(draw), true; }, draw.counting);
}

void Drawer::drawVertices(const Draw& draw) {
  if (draw.instances == 1)
    gl_.DrawArrays(gl::TRIANGLES, draw.firstVertex, draw.vertices);
  else
    gl_.DrawArraysInstanced(gl::TRIANGLES, draw.firstVertex, draw.vertices, draw.instances);
}

// Timer queries would take what betweenDraws does for the draw's own.
void Drawer::drawBands(const Draw& draw) {
  const bool learns = gl_.timerQueries && draw.bands.estimate > 0 && !betweenDraws_;
  if (learns) paces_.begin(draw.title, draw.bands.estimate, draw.bandCount());
  if (draw.isWhole()) endScissor();
  bool first = true;
  forEachBand(draw.viewport, draw.bands.size, [&](const Viewport& band) {
    if (!std::exchange(first, false)) {
      if (isAbandoned_) return;
      recorder_.nextBand();
      if (!goesOn()) return;
      recorder_.resume();
    }
    submit(draw.bands.milliseconds);
    if (!draw.isWhole()) setScissor(band);
    drawVertices(draw);
    if (learns) paces_.endBand();
  });
}

// What is drawn next, and takes so long. A driver gathers draws and hands them to the GPU together, whose watchdog
// counts until all of them are done: without a flush bands would be no shorter than what they are parts of.
void Drawer::submit(double milliseconds) {
  if (most_ > 0 && pending_ > 0 && pending_ + milliseconds > most_) {
    gl_.Flush();
    pending_ = 0;
  }
  pending_ += milliseconds;
}

void Drawer::activate(gl::Uint unit) {
  if (active_ != unit) gl_.ActiveTexture(gl::TEXTURE0 + unit);
  active_ = unit;
}

void Drawer::bind(const Draw::Reading& reading) {
  units_.resize(std::max<std::size_t>(units_.size(), reading.unit + 1));
  samplers_.resize(std::max<std::size_t>(samplers_.size(), reading.unit + 1), 0);
  Bound& bound = units_[reading.unit];
  if (bound.target == reading.target && bound.texture == reading.texture) return;
  activate(reading.unit);
  gl_.BindTexture(reading.target, reading.texture);
  const gl::Uint sampler = isMultisampled(reading.target) ? 0 : objects_.nearestSampler;
  if (bound.target == 0 || samplers_[reading.unit] != sampler) gl_.BindSampler(reading.unit, sampler);
  samplers_[reading.unit] = sampler;
  bound = {reading.target, reading.texture};
}

// All at once where GL can (4.4). That would take textures of every kind from a unit that gets none: a plain sampler
// that reads nothing gets a texture of one texel, others are seen to by themselves.
void Drawer::bind(const std::vector<Draw::Reading>& readings) {
  std::vector<gl::Uint> textures, samplers;
  bool atOnce = gl_.BindTextures && gl_.BindSamplers, bound = readings.size() <= units_.size();
  for (std::size_t i = 0; i < readings.size(); ++i) { // whose units are 0, 1, 2, ...
    const Draw::Reading& reading = readings[i];
    const bool isPlain = reading.target == gl::TEXTURE_2D;
    textures.push_back(reading.texture || !isPlain ? reading.texture : objects_.emptyTexture);
    samplers.push_back(isMultisampled(reading.target) ? 0 : objects_.nearestSampler);
    atOnce = atOnce && textures.back() != 0;
    bound = bound && units_[i].target == reading.target && units_[i].texture == textures[i];
  }
  if (bound) return;
  if (!atOnce) {
    for (std::size_t i = 0; i < readings.size(); ++i)
      bind({readings[i].unit, readings[i].target, textures[i]});
    return;
  }
  const auto count = static_cast<gl::Sizei>(readings.size());
  gl_.BindTextures(0, count, textures.data());
  units_.resize(std::max(units_.size(), readings.size()));
  samplers_.resize(std::max(samplers_.size(), samplers.size()), 0);
  for (std::size_t i = 0; i < readings.size(); ++i)
    units_[i] = {readings[i].target, textures[i]};
  if (std::equal(samplers.begin(), samplers.end(), samplers_.begin())) return;
  gl_.BindSamplers(0, count, samplers.data());
  std::copy(samplers.begin(), samplers.end(), samplers_.begin());
}

void Drawer::bindFramebuffer(gl::Uint framebuffer) {
  if (framebuffer != framebuffer_) gl_.BindFramebuffer(gl::DRAW_FRAMEBUFFER, framebuffer);
  framebuffer_ = framebuffer;
}

void Drawer::bindBlocks(const Draw& draw) {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    if (draw.blocks[i] == blocks_[i]) continue;
    blocks_[i] = draw.blocks[i];
    objects_.blocks.bind(static_cast<gl::Uint>(i), draw.blocks[i]);
  }
}

void Drawer::setBlend(Blend blend) {
  if (blend == blend_) return;
  const auto writesAll = [](Blend b) { return b != Blend::Colour && b != Blend::Alpha; };
  const auto blends = [&](Blend b) { return b != Blend::Replace && writesAll(b); };
  if (const gl::Boolean rgb = blend != Blend::Alpha; !writesAll(blend_) || !writesAll(blend))
    gl_.ColorMaski(0, rgb, rgb, rgb, blend != Blend::Colour);
  const gl::Enum alpha = blend == Blend::AddAll ? gl::ONE : gl::ZERO;
  const gl::Enum source = blend == Blend::AddByAlpha ? gl::DST_ALPHA : gl::ONE;
  if (blends(blend))
    gl::setBlending(gl_, gl::kDrawBuffers, true,
                    {source, blend == Blend::DualSource ? gl::SRC1_COLOR : gl::ONE, alpha, gl::ONE});
  else if (blends(blend_))
    gl::setBlending(gl_, gl::kDrawBuffers, false);
  blend_ = blend;
}

void Drawer::setStencil(const Stencil& stencil) {
  if (stencil == stencil_) return;
  stencil_ = stencil;
  if (stencil.isOff()) return gl_.Disable(gl::STENCIL_TEST);
  gl_.Enable(gl::STENCIL_TEST);
  gl_.StencilMask(stencil.marked); // what writes none may be tested before it is shaded
  const auto reference = static_cast<gl::Int>(stencil.required | stencil.marked);
  gl_.StencilFunc(stencil.tested ? gl::EQUAL : gl::ALWAYS, reference, stencil.tested);
  gl_.StencilOp(gl::KEEP, gl::KEEP, stencil.marked ? gl::REPLACE : gl::KEEP);
}

void Drawer::setViewport(const Viewport& v) {
  if (v.x == viewport_.x && v.y == viewport_.y && v.width == viewport_.width && v.height == viewport_.height) return;
  gl::setViewport(gl_, v.x, v.y, v.width, v.height);
  viewport_ = v;
}

void Drawer::setScissor(const Viewport& band) {
  gl::setScissor(gl_, {band.x, band.y, band.width, band.height});
  if (!std::exchange(scissor_, true)) gl::setScissorTest(gl_, true);
}

void Drawer::endScissor() {
  if (std::exchange(scissor_, false)) gl::setScissorTest(gl_, false);
}

} // namespace

void requestPrograms(const FramePlan& plan, gl::ProgramCache& programs) {
  forEachDraw(plan, [&](const Draw& draw) { programs.request(draw.variant); });
}

Status resolvePrograms(FramePlan& plan, gl::ProgramCache& programs, Resolve what) {
  for (Step& step : plan.steps)
    if (Draw* draw = std::get_if<Draw>(&step))
      if (Status s = resolve(*draw, programs, what); !s) return s;
  return {};
}

UnitsUsed unitsOf(const FramePlan& plan) {
  UnitsUsed used;
  used.count = 1; // tables are uploaded through the first
  for (const Step& step : plan.steps)
    used.copies = used.copies || std::holds_alternative<Copy>(step);
  forEachDraw(plan, [&](const Draw& draw) {
    used.scissor = used.scissor || !draw.isWhole();
    used.stencil = used.stencil || !draw.stencil.isOff();
    for (const Draw::Reading& reading : draw.textures) {
      used.count = std::max(used.count, static_cast<int>(reading.unit) + 1);
      used.kinds.arrays = used.kinds.arrays || reading.target == gl::TEXTURE_2D_ARRAY;
      used.kinds.multisampled = used.kinds.multisampled || isMultisampled(reading.target);
      used.kinds.cubes = used.kinds.cubes || reading.target == gl::TEXTURE_CUBE_MAP;
      used.kinds.cubeArrays = used.kinds.cubeArrays || reading.target == gl::TEXTURE_CUBE_MAP_ARRAY;
    }
  });
  return used;
}

bool drawPlan(const FramePlan& plan, const gl::Functions& gl, const DrawObjects& objects, PassRecorder& recorder,
              BandPaces& paces, const std::function<bool()>& betweenDraws) {
  Drawer drawer(gl, objects, recorder, paces, plan.bandMilliseconds, betweenDraws);
  drawer.begin();
  for (const Step& step : plan.steps) {
    if (drawer.isAbandoned() || (std::holds_alternative<Draw>(step) && !drawer.goesOn())) break;
    std::visit(drawer, step);
  }
  drawer.end();
  return !drawer.isAbandoned();
}

} // namespace tyndall
