// Meshes as moving objects (MeshVertices).
#include "ReuseRig.h"
#include "gl/Objects.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

using namespace tyndall;
using namespace tests::reuse;

namespace {

// The cube from -1 to 1 as an engine may hold it: between other things, a position every 20 bytes.
class CubeBuffer {
public:
  CubeBuffer() : buffer_((tests::testContext(), host::makeBuffer())) { fill(1); }
  void fill(float half) {
    std::vector<float> data(2 + 8 * 5, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        data[2 + i * 5 + axis] = (i >> axis & 1) != 0 ? half : -half;
    host::gl().BindBuffer(GL_ARRAY_BUFFER, buffer_.name());
    host::gl().BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.size() * sizeof(float)), data.data(),
                          GL_STATIC_DRAW);
    host::gl().BindBuffer(GL_ARRAY_BUFFER, 0);
  }
  MeshVertices vertices(std::uint64_t version) const { return {buffer_.name(), 8, 20, 8, version}; }

private:
  host::GlBuffer buffer_;
};

} // namespace

TEST_CASE("a mesh as moving object: its vertices are read once per version, and it does what its box does") {
  CubeBuffer cube;
  tests::ShaftRig rig = sunlit(Changes::Objects);
  for (int frame = 0; frame < 4; ++frame) {
    CAPTURE(frame);
    moveTo(rig, frame);
    const double byBox = [&] { // in a view of its own
      tests::ShaftRig other = sunlit(Changes::Objects);
      for (int f = std::max(frame - 1, 0); f <= frame; ++f)
        moveTo(other, f), reused(other);
      return tests::testEffect().statistics().redrawnShare;
    }();
    if (frame == 0) rig.scene.frame.objects = {between(tumbling(0), tumbling(0))}; // so that its shape is known
    rig.scene.frame.objects[0].mesh = cube.vertices(frame < 2 ? 1 : 0);
    if (frame == 1) cube.fill(1);
    const Picture picture = reused(rig);
    checkSame(picture, full(rig));
    CHECK(picture.share == (frame == 0 ? 1 : byBox));
  }
  // A version that was seen is not read again; another one, or none, is.
  cube.fill(std::numeric_limits<float>::infinity());
  moveTo(rig, 4);
  for (const std::uint64_t version : {0, 1, 2}) {
    rig.scene.frame.objects[0].mesh = cube.vertices(version);
    const Status status = tests::testEffect().render(rig.scene.frame);
    CAPTURE(version, status.message);
    CHECK(static_cast<bool>(status) == (version == 1));
    if (!status) CHECK(status.message.find("objects[0].mesh.buffer") != std::string::npos);
    if (!status) CHECK(status.message.find("vertex 0 is not finite") != std::string::npos);
  }
}

TEST_CASE("a mesh that deforms in place covers the shape that it had in the view's last frame") {
  // Half the cube's width in each frame: it grows, shrinks, and rests; and the frames that name it.
  const float halves[] = {1, 1, 2.5F, 0.4F, 0.4F, 1.5F};
  for (const bool fromTheFirst : {true, false}) {
    CubeBuffer cube;
    tests::ShaftRig rig = sunlit(Changes::Objects);
    float last = 0;
    for (int frame = 0; frame < 6; ++frame) {
      CAPTURE(fromTheFirst, frame);
      const float half = halves[frame];
      cube.fill(half);
      rig.setMoving({glm::scale(tumbling(0), glm::dvec3(half))});
      ++rig.scene.frame.reuse.frame;
      rig.scene.frame.objects.clear();
      if (half != last && (frame > 0 || fromTheFirst)) {
        rig.scene.frame.objects = {between(tumbling(0), tumbling(0))};
        rig.scene.frame.objects[0].mesh = cube.vertices(static_cast<std::uint64_t>(1 + frame));
      }
      last = half;
      const Picture picture = reused(rig);
      checkSame(picture, full(rig));
      CHECK((frame == 0 || picture.share < 1));
    }
  }
}

TEST_CASE("meshes that break their rules are refused, field and rule named") {
  CubeBuffer cube;
  tests::ShaftRig rig = sunlit(Changes::Objects);
  const auto checkRefused = [&](const std::string& part, MeshVertices mesh) {
    rig.scene.frame.objects.assign(1, {});
    rig.scene.frame.objects[0].mesh = mesh;
    const Status status = tests::testEffect().render(rig.scene.frame);
    CAPTURE(status.message, part);
    CHECK(status.code == StatusCode::InvalidFrame);
    CHECK(status.message.find("objects[0].mesh." + part) != std::string::npos);
  };
  const GLuint name = cube.vertices(1).buffer;
  checkRefused("buffer is 987654: not the name", {987654, 0, 12, 3, 1});
  checkRefused("stride is 8", {name, 8, 8, 8, 3});
  checkRefused("count is 0", {name, 8, 20, 0, 3});
  checkRefused("count is 16777217", {name, 8, 20, (1U << 24) + 1, 3});
  checkRefused("count is 9: with offset 8 and stride 20 the last vertex ends behind the buffer's 168 bytes",
               {name, 8, 20, 9, 3});
  checkRefused("count is 1: with offset 18446744073709551615", {name, ~std::uint64_t{0}, 20, 1, 3});
  checkRefused("buffer is " + std::to_string(name) + ": its vertex 0 is not finite", {name, 0, 20, 8, 3});
  host::gl().BindBuffer(GL_ARRAY_BUFFER, name);
  REQUIRE(host::gl().MapBuffer(GL_ARRAY_BUFFER, GL_READ_ONLY));
  checkRefused("buffer is " + std::to_string(name) + ": it is mapped", {name, 8, 20, 8, 3});
  host::gl().UnmapBuffer(GL_ARRAY_BUFFER);
  host::gl().BindBuffer(GL_ARRAY_BUFFER, 0);
}
