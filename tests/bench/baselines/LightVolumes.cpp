#include "baselines/DrawnBaseline.h"
#include "baselines/SharedPhysics.h"

namespace bench {

namespace {

class LightVolumes : public DrawnBaseline {
public:
  explicit LightVolumes(int cells) : cells_(cells), indices_(host::makeBuffer()) {
    const int stride = cells_ + 2;
    std::vector<std::uint32_t> indices;
    indices.reserve(6 * static_cast<std::size_t>(stride - 1) * static_cast<std::size_t>(stride - 1));
    for (int y = 0; y + 1 < stride; ++y)
      for (int x = 0; x + 1 < stride; ++x)
        for (const int corner : {0, 1, stride, stride, 1, stride + 1})
          indices.push_back(static_cast<std::uint32_t>(y * stride + x + corner));
    indexCount_ = static_cast<GLsizei>(indices.size());
    // Element buffers belong to a vertex array, which is bound only while drawing: fill it as any buffer.
    host::gl().BindBuffer(GL_COPY_WRITE_BUFFER, indices_.name());
    host::gl().BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytesOfIndices()), indices.data(),
                          GL_STATIC_DRAW);
  }

  std::string reasonAgainst(const tyndall::Frame& frame) const override {
    const std::string reason = DrawnBaseline::reasonAgainst(frame);
    if (!reason.empty()) return reason;
    if (hasGlass(frame)) return "takes no glass";
    for (const tyndall::Light& light : frame.lights)
      if (!light.litOutsideViews) return "takes lights that are lit outside their views";
    return reasonAgainstManyViews(frame);
  }

  std::uint64_t bytes() const override { return drawer().bytes() + bytesOfIndices(); }

private:
  std::size_t bytesOfIndices() const { return static_cast<std::size_t>(indexCount_) * sizeof(std::uint32_t); }

  void draw(const tyndall::Frame& frame) override {
    const GLuint faces = drawer().target("faces", GL_RGBA32F, frame.viewport.width, frame.viewport.height);
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
      drawer().pass("faces" + lightSuffix(i), [&] {
        drawer().selectLight(frame, frame.lights[i]);
        drawer().attach({faces}, frame.viewport.width, frame.viewport.height);
        drawLight(frame, frame.lights[i], i == 0);
      });
    drawer().pass("apply", [&] {
      drawer().attachFinal(frame, true);
      drawer().bind(kOwn, faces);
      drawer().use("volumeApply.frag", drawer().definesFor(frame, nullptr), {"faces"});
      drawer().drawFullScreen();
    });
  }

  void drawLight(const tyndall::Frame& frame, const tyndall::Light& light, bool first) {
    const GladGLContext& gl = host::gl();
    Defines defines = drawer().definesFor(frame, &light);
    defines.emplace_back("FACES 0");
    drawer().use("volumeFaces.frag", defines);
    gl.BlendFunc(GL_ONE, GL_ONE);
    if (!first) gl.Enable(GL_BLEND);
    drawer().drawFullScreen();
    if (light.shadow.views.empty()) return;
    gl.Enable(GL_BLEND);
    gl.Enable(GL_DEPTH_CLAMP); // the surface before the near plane and behind the far plane counts, too
    defines.back() = "FACES 1";
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    drawMesh(frame, light, defines, false);
    drawMesh(frame, light, defines, true);
    gl.Disable(GL_DEPTH_CLAMP);
  }

  void drawMesh(const tyndall::Frame& frame, const tyndall::Light& light, Defines defines, bool cap) {
    const glm::dmat4 cameraFromTexel =
        bench::cameraFromTexel(frame, light, drawer().shadowSize().x, drawer().shadowSize().y);
    defines.emplace_back(cap ? "CAP 1" : "CAP 0");
    host::Program& program = drawer().use("volumeFaces.frag", defines, {}, "volumeMesh.vert");
    program.set("cells", cells_);
    program.set("cameraFromTexel", glm::mat4(cameraFromTexel));
    program.set("clipFromCamera", glm::mat4(clipFromCamera(frame)));
    // The grid turns from x to y: seen along growing depth, away from the volume's outside.
    program.set("front", glm::determinant(glm::dmat3(cameraFromTexel)) > 0 ? -1.0F : 1.0F);
    if (cap)
      host::gl().DrawArrays(GL_TRIANGLES, 0, 6);
    else
      host::gl().DrawElements(GL_TRIANGLES, indexCount_, GL_UNSIGNED_INT, nullptr);
  }

  int cells_;
  GLsizei indexCount_ = 0;
  host::GlBuffer indices_;
};

} // namespace

std::unique_ptr<Baseline> makeLightVolumes(int cells) { return std::make_unique<LightVolumes>(cells); }

} // namespace bench
