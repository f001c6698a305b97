#include "Methods.h"

#include <scene/Error.h>

namespace avsmbench {

namespace {

using host::gl;

class AvsmMethod : public Method {
public:
  explicit AvsmMethod(const tyndall::AvsmConfig& config) : config_(config) {
    tyndall::AvsmResult result = tyndall::Avsm::create(config);
    if (!result.avsm) throw host::Error(result.status.message);
    avsm_ = std::move(result.avsm);
  }

  tyndall::Avsm& lists() override { return *avsm_; }

  void build() override {
    if (const tyndall::Status status = avsm_->resolve(); !status) throw host::Error(status.message);
  }

  std::vector<std::string> lookUpFiles() const override { return {"avsmLookUp.glsl"}; }
  Defines lookUpDefines() const override {
    return {{"TYNDALL_CURVE_NODES", config_.nodes}, {"TYNDALL_CURVE_PACKED", config_.packed ? 1 : 0}};
  }

  void bindForLookUp() const override {
    gl().ActiveTexture(GL_TEXTURE0);
    gl().BindTexture(GL_TEXTURE_2D_ARRAY, avsm_->curves().texture);
  }

  bool filters() const override { return true; }
  std::uint64_t bytes() const override { return avsm_->statistics().curveBytes; }
  bool needsLists() const override { return true; }

private:
  tyndall::AvsmConfig config_;
  std::unique_ptr<tyndall::Avsm> avsm_;
};

} // namespace

MethodPointer makeAvsm(const tyndall::AvsmConfig& config) { return std::make_unique<AvsmMethod>(config); }

} // namespace avsmbench
