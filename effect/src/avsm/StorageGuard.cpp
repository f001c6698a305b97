#include "avsm/StorageGuard.h"

namespace tyndall::avsm {

StorageGuard::StorageGuard(const gl::Functions& gl, StateMode mode) : gl_(gl) {
  if (mode == StateMode::Restore) save();
}

void StorageGuard::save() {
  gl_.GetIntegerv(gl::SHADER_STORAGE_BUFFER_BINDING, &buffer_);
  for (std::size_t i = 0; i < bindings_.size(); ++i) {
    const auto index = static_cast<gl::Uint>(i);
    gl_.GetIntegeri_v(gl::SHADER_STORAGE_BUFFER_BINDING, index, &bindings_[i].buffer);
    gl_.GetInteger64i_v(gl::SHADER_STORAGE_BUFFER_START, index, &bindings_[i].start);
    gl_.GetInteger64i_v(gl::SHADER_STORAGE_BUFFER_SIZE, index, &bindings_[i].size);
  }
  gl_.GetIntegeri_v(gl::IMAGE_BINDING_NAME, 0, &image_.name);
  gl_.GetIntegeri_v(gl::IMAGE_BINDING_LEVEL, 0, &image_.level);
  gl_.GetIntegeri_v(gl::IMAGE_BINDING_LAYERED, 0, &image_.layered);
  gl_.GetIntegeri_v(gl::IMAGE_BINDING_LAYER, 0, &image_.layer);
  gl_.GetIntegeri_v(gl::IMAGE_BINDING_ACCESS, 0, &image_.access);
  gl_.GetIntegeri_v(gl::IMAGE_BINDING_FORMAT, 0, &image_.format);
}

StorageGuard::~StorageGuard() {
  for (std::size_t i = 0; i < bindings_.size(); ++i) {
    const Binding& binding = bindings_[i];
    const auto index = static_cast<gl::Uint>(i);
    const auto buffer = static_cast<gl::Uint>(binding.buffer);
    if (binding.size > 0)
      gl_.BindBufferRange(gl::SHADER_STORAGE_BUFFER, index, buffer, static_cast<gl::Intptr>(binding.start),
                          static_cast<gl::Sizeiptr>(binding.size));
    else
      gl_.BindBufferBase(gl::SHADER_STORAGE_BUFFER, index, buffer);
  }
  gl_.BindBuffer(gl::SHADER_STORAGE_BUFFER, static_cast<gl::Uint>(buffer_)); // after the indexed ones: they bind it too
  gl_.BindImageTexture(0, static_cast<gl::Uint>(image_.name), image_.level, static_cast<gl::Boolean>(image_.layered),
                       image_.layer, static_cast<gl::Enum>(image_.access), static_cast<gl::Enum>(image_.format));
}

BufferGuard::BufferGuard(const gl::Functions& gl, StateMode mode) : gl_(gl) {
  if (mode == StateMode::Restore) gl.GetIntegerv(gl::SHADER_STORAGE_BUFFER_BINDING, &buffer_);
}

BufferGuard::~BufferGuard() { gl_.BindBuffer(gl::SHADER_STORAGE_BUFFER, static_cast<gl::Uint>(buffer_)); }

} // namespace tyndall::avsm
