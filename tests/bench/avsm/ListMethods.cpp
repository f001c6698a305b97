// Methods of variable size: the lists as they are, and deep shadow maps.
#include "Methods.h"

namespace avsmbench {

namespace {

using host::gl;

constexpr GLuint kSegments = 1, kExits = 2, kNodes = 3, kTexels = 4; // storage bindings

class ListMethod : public Method {
public:
  ListMethod(tyndall::Avsm& lists, int size) : lists_(lists), size_(static_cast<std::uint64_t>(size)) {}

  tyndall::Avsm& lists() override { return lists_; }
  void build() override {}
  std::vector<std::string> lookUpFiles() const override { return {"listsLookUp.glsl"}; }
  void bindForLookUp() const override {}

  std::uint64_t bytes() const override {
    const tyndall::AvsmStatistics statistics = lists_.statistics();
    return 16 * (size_ * size_ + statistics.segments - statistics.lost);
  }
  bool needsLists() const override { return true; }

private:
  tyndall::Avsm& lists_;
  std::uint64_t size_;
};

/// Sorts as the effect does. Nodes lie in memory for as many as a texel could need; what is counted is those it does.
class DeepMethod : public Method {
public:
  DeepMethod(tyndall::Avsm& lists, int size, float threshold)
      : lists_(lists), size_(static_cast<std::size_t>(size)), threshold_(threshold),
        sortEntries_({"passes/avsmSort.comp"}, {{"EXITS", 0}}), sortExits_({"passes/avsmSort.comp"}, {{"EXITS", 1}}),
        build_({"deepBuild.comp"}), exits_(host::makeBuffer()), nodes_(host::makeBuffer()),
        texels_(host::makeBuffer()) {
    fillStorage(texels_, kTexels, size_ * size_ * 8, nullptr);
  }

  tyndall::Avsm& lists() override { return lists_; }

  void build() override {
    makeRoom();
    const std::size_t groups = (size_ + 7) / 8;
    for (const ComputeProgram* sort : {&sortEntries_, &sortExits_}) {
      sort->use();
      ComputeProgram::dispatch(groups, groups);
    }
    build_.use();
    build_.set("threshold", threshold_);
    ComputeProgram::dispatch(groups, groups);
  }

  std::vector<std::string> lookUpFiles() const override { return {"deepLookUp.glsl"}; }

  void bindForLookUp() const override {
    gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, kNodes, nodes_.name());
    gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, kTexels, texels_.name());
  }

  std::uint64_t bytes() const override {
    std::uint32_t counts[2] = {};
    gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, nodes_.name());
    gl().GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof counts, counts);
    return 8 * (size_ * size_ + counts[1]);
  }
  bool needsLists() const override { return true; }

private:
  /// As large as the buffer of segments asks for, as deepBuild.comp reckons; empties the counts.
  void makeRoom() {
    GLint segments = 0;
    gl().GetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, kSegments, &segments);
    gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(segments));
    GLint64 bytes = 0;
    gl().GetBufferParameteri64v(GL_SHADER_STORAGE_BUFFER, GL_BUFFER_SIZE, &bytes);
    const std::size_t count = static_cast<std::size_t>(bytes) / 16;
    if (count > room_) {
      room_ = count;
      fillStorage(exits_, kExits, 4 * count, nullptr);
      fillStorage(nodes_, kNodes, 8 * (1 + 2 * count + 68 * size_ * size_), nullptr);
    }
    gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, kExits, exits_.name());
    bindForLookUp();
    gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, nodes_.name());
    constexpr std::uint32_t kNone[2] = {0, 0};
    gl().BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof kNone, kNone);
  }

  tyndall::Avsm& lists_;
  std::size_t size_;
  float threshold_;
  ComputeProgram sortEntries_, sortExits_, build_;
  host::GlBuffer exits_, nodes_, texels_;
  std::size_t room_ = 0; // segments
};

} // namespace

MethodPointer makeLists(tyndall::Avsm& lists, int size) { return std::make_unique<ListMethod>(lists, size); }

MethodPointer makeDeep(tyndall::Avsm& lists, int size, float threshold) {
  return std::make_unique<DeepMethod>(lists, size, threshold);
}

} // namespace avsmbench
