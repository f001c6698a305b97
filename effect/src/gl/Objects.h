// Move-only owners of GL names. Each deletes its name with the table it was made with; the context must be current.
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"

#include <utility>

namespace tyndall::gl {

enum class ObjectKind { Texture, Sampler, Buffer, VertexArray, Framebuffer, Renderbuffer, Query, Program };

template <ObjectKind Kind>
class Object {
public:
  Object() = default;
  explicit Object(const Functions& gl) : gl_(&gl) {
    if constexpr (Kind == ObjectKind::Texture) gl.GenTextures(1, &name_);
    if constexpr (Kind == ObjectKind::Sampler) gl.GenSamplers(1, &name_);
    if constexpr (Kind == ObjectKind::Buffer) gl.GenBuffers(1, &name_);
    if constexpr (Kind == ObjectKind::VertexArray) gl.GenVertexArrays(1, &name_);
    if constexpr (Kind == ObjectKind::Framebuffer) gl.GenFramebuffers(1, &name_);
    if constexpr (Kind == ObjectKind::Renderbuffer) gl.GenRenderbuffers(1, &name_);
    if constexpr (Kind == ObjectKind::Query) gl.GenQueries(1, &name_);
    if constexpr (Kind == ObjectKind::Program) name_ = gl.CreateProgram();
  }
  Object(Object&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    return *this;
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() {
    if (name_ == 0) return;
    if constexpr (Kind == ObjectKind::Texture) gl_->DeleteTextures(1, &name_);
    if constexpr (Kind == ObjectKind::Sampler) gl_->DeleteSamplers(1, &name_);
    if constexpr (Kind == ObjectKind::Buffer) gl_->DeleteBuffers(1, &name_);
    if constexpr (Kind == ObjectKind::VertexArray) gl_->DeleteVertexArrays(1, &name_);
    if constexpr (Kind == ObjectKind::Framebuffer) gl_->DeleteFramebuffers(1, &name_);
    if constexpr (Kind == ObjectKind::Renderbuffer) gl_->DeleteRenderbuffers(1, &name_);
    if constexpr (Kind == ObjectKind::Query) gl_->DeleteQueries(1, &name_);
    if constexpr (Kind == ObjectKind::Program) gl_->DeleteProgram(name_);
  }

  Uint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

private:
  const Functions* gl_ = nullptr;
  Uint name_ = 0;
};

using Texture = Object<ObjectKind::Texture>;
using Sampler = Object<ObjectKind::Sampler>;
using Buffer = Object<ObjectKind::Buffer>;
using VertexArray = Object<ObjectKind::VertexArray>;
using Framebuffer = Object<ObjectKind::Framebuffer>;
using Renderbuffer = Object<ObjectKind::Renderbuffer>;
using Query = Object<ObjectKind::Query>;
using ProgramObject = Object<ObjectKind::Program>;

} // namespace tyndall::gl
