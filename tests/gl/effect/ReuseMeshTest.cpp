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

// The share that a frame redraws of which boxes say what moved: from that before to this one, in a view of its own.
double shareByBox(const MovingObject& before, int frame, const MovingObject& object) {
  tests::ShaftRig rig = sunlit(Changes::Objects);
  for (int f = std::max(frame - 1, 0); f <= frame; ++f) {
    moveTo(rig, f);
    rig.scene.frame.objects = {f == frame ? object : before};
    reused(rig);
  }
  return tests::testEffect().statistics().redrawnShare;
}

MovingObject resting(const glm::dmat4& place) { return between(place, place); }

} // namespace

TEST_CASE("a mesh as moving object: its vertices are read once per version, and it does what its box does") {
  CubeBuffer cube;
  tests::ShaftRig rig = sunlit(Changes::Objects);
  for (int frame = 0; frame < 4; ++frame) {
    CAPTURE(frame);
    moveTo(rig, frame);
    const MovingObject box = frame == 0 ? resting(tumbling(0)) : rig.scene.frame.objects[0];
    const double byBox = shareByBox(resting(tumbling(frame - 1)), frame, box);
    rig.scene.frame.objects = {box}; // in the full frame, too, so that it is known in the next
    rig.scene.frame.objects[0].mesh = cube.vertices(1);
    const Picture picture = reused(rig);
    checkSame(picture, full(rig));
    CHECK(picture.share == (frame == 0 ? 1 : byBox));
    CHECK((frame == 0 || picture.share < 1));
  }
  // A version that was seen is not read again; another one is, which shows when its vertices have come; none never is.
  cube.fill(std::numeric_limits<float>::infinity());
  moveTo(rig, 4);
  for (const std::uint64_t version : {0, 1, 2})
    for (int frame = 0; frame < 3; ++frame) {
      rig.scene.frame.objects[0].mesh = cube.vertices(version);
      const Status status = tests::testEffect().render(rig.scene.frame);
      host::gl().Finish();
      CAPTURE(version, frame, status.message);
      CHECK(static_cast<bool>(status) == (version < 2 || frame == 0));
      if (!status) CHECK(status.message.find("objects[0].mesh.buffer") != std::string::npos);
      if (!status) CHECK(status.message.find("vertex 0 is not finite") != std::string::npos);
    }
}

TEST_CASE("a frame that names a mesh of which nothing is known, or without a version, compares all and is exact") {
  for (const bool hasVersion : {true, false}) {
    CubeBuffer cube;
    tests::ShaftRig rig = sunlit(Changes::Objects);
    for (int frame = 0; frame < 4; ++frame) {
      CAPTURE(hasVersion, frame);
      moveTo(rig, frame);
      if (frame == 2) { // what its matrices say is wrong, too
        rig.scene.frame.objects = {resting(glm::translate(glm::dmat4(1), glm::dvec3(0, 90, 0)))};
        rig.scene.frame.objects[0].mesh = cube.vertices(hasVersion ? 1 : 0);
      }
      const Picture picture = reused(rig);
      checkSame(picture, full(rig));
      CHECK((frame == 0 || picture.share < 1));
    }
  }
}

TEST_CASE("a mesh larger than what is read in a frame comes in parts, and another version in between is not mixed in") {
  // Three frames' worth of a strided cube.
  constexpr std::uint32_t kCount = 3U << 18, kStride = 16;
  const host::GlBuffer buffer = (tests::testContext(), host::makeBuffer());
  const auto fill = [&](float half) {
    std::vector<float> data(std::size_t{4} * kCount);
    for (std::size_t i = 0; i < kCount; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        data[4 * i + axis] = (i >> axis & 1) != 0 ? half : -half;
    host::gl().BindBuffer(GL_ARRAY_BUFFER, buffer.name());
    host::gl().BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.size() * sizeof(float)), data.data(),
                          GL_STATIC_DRAW);
    host::gl().BindBuffer(GL_ARRAY_BUFFER, 0);
  };
  tests::ShaftRig rig = sunlit(Changes::Objects);
  const std::uint64_t before = tests::testEffect().statistics().bytes;
  for (int frame = 0; frame < 9; ++frame) {
    CAPTURE(frame);
    const bool rests = frame < 8;
    const std::uint64_t version = frame < 2 ? 1 : 2; // the first is never read to its end
    if (frame == 0) fill(std::numeric_limits<float>::infinity());
    if (frame == 2) fill(1);
    rig.setMoving({tumbling(rests ? 0 : 1)});
    ++rig.scene.frame.reuse.frame;
    rig.scene.frame.objects = {between(tumbling(0), tumbling(rests ? 0 : 1))};
    rig.scene.frame.objects[0].mesh = {buffer.name(), 0, kStride, kCount, version};
    const Picture picture = reused(rig);
    if (rests) continue;
    checkSame(picture, full(rig));
    CHECK(picture.share == shareByBox(resting(tumbling(0)), 1, between(tumbling(0), tumbling(1))));
  }
  CHECK(tests::testEffect().statistics().bytes <= before + (std::uint64_t{64} << 20));
}

TEST_CASE("a mesh that has two known shapes in turn covers both") {
  CubeBuffer cube;
  tests::ShaftRig rig = sunlit(Changes::Objects);
  const auto shaped = [](int version) { return glm::scale(tumbling(0), glm::dvec3(version == 1 ? 1 : 2.5)); };
  int last = 1;
  for (int frame = 0; frame < 10; ++frame) {
    CAPTURE(frame);
    const int version = frame < 2 ? 1 : frame < 5 ? 2 : last == 1 ? 2 : 1; // until both are known, and then in turn
    cube.fill(version == 1 ? 1.0F : 2.5F);
    rig.setMoving({shaped(version)});
    ++rig.scene.frame.reuse.frame;
    rig.scene.frame.objects = {resting(tumbling(0))};
    rig.scene.frame.objects[0].mesh = cube.vertices(static_cast<std::uint64_t>(version));
    const Picture picture = reused(rig);
    checkSame(picture, full(rig));
    if (frame >= 5) CHECK(picture.share < 1);
    last = version;
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
  const auto checkRefused = [&](const std::string& part, MeshVertices mesh, int frames = 1) {
    rig.scene.frame.objects.assign(1, {});
    rig.scene.frame.objects[0].mesh = mesh;
    Status status;
    for (int frame = 0; frame < frames; ++frame) {
      CHECK(status);
      status = tests::testEffect().render(rig.scene.frame);
      host::gl().Finish();
    }
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
  checkRefused("buffer is " + std::to_string(name) + ": its vertex 0 is not finite", {name, 0, 20, 8, 3}, 2);
  host::gl().BindBuffer(GL_ARRAY_BUFFER, name);
  REQUIRE(host::gl().MapBuffer(GL_ARRAY_BUFFER, GL_READ_ONLY));
  checkRefused("buffer is " + std::to_string(name) + ": it is mapped", {name, 8, 20, 8, 3});
  host::gl().UnmapBuffer(GL_ARRAY_BUFFER);
  host::gl().BindBuffer(GL_ARRAY_BUFFER, 0);
}
