// Functions of OpenGL that an effect or an AVSM may ask for, each behind a counter.
#pragma once

#include "gl/Gl.h"

#include <array>
#include <cstddef>

// clang-format off
#define TESTS_GL_FUNCTIONS(X) \
  X(ActiveTexture) X(AttachShader) X(BeginConditionalRender) X(BeginQuery) X(BeginQueryIndexed) \
  X(BeginTransformFeedback) X(BindAttribLocation) X(BindBuffer) X(BindBufferBase) X(BindBufferRange) \
  X(BindBuffersBase) X(BindBuffersRange) X(BindFragDataLocation) X(BindFramebuffer) X(BindImageTexture) \
  X(BindImageTextures) X(BindProgramPipeline) X(BindRenderbuffer) X(BindSampler) X(BindSamplers) X(BindTexture) \
  X(BindTextureUnit) X(BindTextures) X(BindTransformFeedback) X(BindVertexArray) X(BindVertexBuffer) X(BlendColor) \
  X(BlendEquation) X(BlendEquationSeparate) X(BlendEquationSeparatei) X(BlendEquationi) X(BlendFunc) \
  X(BlendFuncSeparate) X(BlendFuncSeparatei) X(BlendFunci) X(BlitFramebuffer) X(BufferData) X(BufferStorage) \
  X(BufferSubData) X(CheckFramebufferStatus) X(CheckNamedFramebufferStatus) X(ClampColor) X(Clear) \
  X(ClearBufferData) X(ClearBufferSubData) X(ClearBufferfi) X(ClearBufferfv) X(ClearBufferiv) X(ClearBufferuiv) \
  X(ClearColor) X(ClearDepth) X(ClearStencil) X(ClearTexImage) X(ClearTexSubImage) X(ClientWaitSync) \
  X(ClipControl) X(ColorMask) X(ColorMaski) X(CompileShader) X(CopyBufferSubData) X(CopyImageSubData) \
  X(CopyNamedBufferSubData) X(CopyTexImage2D) X(CopyTexSubImage2D) X(CreateBuffers) X(CreateFramebuffers) \
  X(CreateProgram) X(CreateProgramPipelines) X(CreateQueries) X(CreateRenderbuffers) X(CreateSamplers) \
  X(CreateShader) X(CreateTextures) X(CreateVertexArrays) X(CullFace) X(DebugMessageCallback) \
  X(DebugMessageControl) X(DebugMessageInsert) X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) \
  X(DeleteProgramPipelines) X(DeleteQueries) X(DeleteRenderbuffers) X(DeleteSamplers) X(DeleteShader) \
  X(DeleteSync) X(DeleteTextures) X(DeleteTransformFeedbacks) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) \
  X(DepthRange) X(DetachShader) X(Disable) X(DisableVertexAttribArray) X(Disablei) X(DispatchCompute) \
  X(DispatchComputeIndirect) X(DrawArrays) X(DrawArraysIndirect) X(DrawArraysInstanced) \
  X(DrawArraysInstancedBaseInstance) X(DrawBuffer) X(DrawBuffers) X(DrawElements) X(DrawElementsInstanced) \
  X(Enable) X(EnableVertexAttribArray) X(Enablei) X(EndConditionalRender) X(EndQuery) X(EndQueryIndexed) \
  X(EndTransformFeedback) X(FenceSync) X(Finish) X(Flush) X(FlushMappedBufferRange) X(FramebufferParameteri) \
  X(FramebufferRenderbuffer) X(FramebufferTexture) X(FramebufferTexture1D) X(FramebufferTexture2D) \
  X(FramebufferTextureLayer) X(FrontFace) X(GenBuffers) X(GenFramebuffers) X(GenProgramPipelines) X(GenQueries) \
  X(GenRenderbuffers) X(GenSamplers) X(GenTextures) X(GenTransformFeedbacks) X(GenVertexArrays) X(GenerateMipmap) \
  X(GetActiveAttrib) X(GetActiveUniform) X(GetActiveUniformBlockiv) X(GetActiveUniformName) X(GetActiveUniformsiv) \
  X(GetAttachedShaders) X(GetAttribLocation) X(GetBooleani_v) X(GetBooleanv) X(GetBufferParameteri64v) \
  X(GetBufferParameteriv) X(GetBufferSubData) X(GetCompressedTexImage) X(GetDebugMessageLog) X(GetDoublei_v) \
  X(GetDoublev) X(GetError) X(GetFloati_v) X(GetFloatv) X(GetFragDataLocation) \
  X(GetFramebufferAttachmentParameteriv) X(GetGraphicsResetStatus) X(GetInteger64i_v) X(GetInteger64v) \
  X(GetIntegeri_v) X(GetIntegerv) X(GetInternalformativ) X(GetNamedBufferSubData) X(GetObjectLabel) X(GetPointerv) \
  X(GetProgramBinary) X(GetProgramInfoLog) X(GetProgramInterfaceiv) X(GetProgramResourceIndex) \
  X(GetProgramResourceLocation) X(GetProgramResourceName) X(GetProgramResourceiv) X(GetProgramiv) \
  X(GetQueryBufferObjectui64v) X(GetQueryBufferObjectuiv) X(GetQueryObjecti64v) X(GetQueryObjectiv) \
  X(GetQueryObjectui64v) X(GetQueryObjectuiv) X(GetQueryiv) X(GetRenderbufferParameteriv) X(GetSamplerParameterfv) \
  X(GetSamplerParameteriv) X(GetShaderInfoLog) X(GetShaderSource) X(GetShaderiv) X(GetString) X(GetStringi) \
  X(GetSynciv) X(GetTexImage) X(GetTexLevelParameterfv) X(GetTexLevelParameteriv) X(GetTexParameterfv) \
  X(GetTexParameteriv) X(GetTextureImage) X(GetTextureLevelParameteriv) X(GetTextureParameteriv) \
  X(GetTextureSubImage) X(GetUniformBlockIndex) X(GetUniformIndices) X(GetUniformLocation) X(GetUniformfv) \
  X(GetUniformiv) X(GetVertexAttribiv) X(GetnTexImage) X(GetnUniformiv) X(Hint) X(InvalidateBufferData) \
  X(InvalidateBufferSubData) X(InvalidateFramebuffer) X(InvalidateTexImage) X(IsBuffer) X(IsEnabled) X(IsEnabledi) \
  X(IsFramebuffer) X(IsProgram) X(IsQuery) X(IsRenderbuffer) X(IsSampler) X(IsShader) X(IsSync) X(IsTexture) \
  X(IsVertexArray) X(LineWidth) X(LinkProgram) X(LogicOp) X(MapBuffer) X(MapBufferRange) X(MapNamedBuffer) \
  X(MapNamedBufferRange) X(MemoryBarrier) X(MemoryBarrierByRegion) X(MinSampleShading) X(MultiDrawArrays) \
  X(NamedBufferData) X(NamedBufferStorage) X(NamedBufferSubData) X(NamedFramebufferDrawBuffers) \
  X(NamedFramebufferRenderbuffer) X(NamedFramebufferTexture) X(NamedRenderbufferStorage) X(ObjectLabel) \
  X(ObjectPtrLabel) X(PatchParameteri) X(PauseTransformFeedback) X(PixelStorei) X(PointSize) X(PolygonMode) \
  X(PolygonOffset) X(PopDebugGroup) X(PrimitiveRestartIndex) X(ProgramBinary) X(ProgramParameteri) \
  X(ProgramUniform1f) X(ProgramUniform1i) X(ProgramUniform1iv) X(ProgramUniform1ui) X(ProvokingVertex) \
  X(PushDebugGroup) X(QueryCounter) X(ReadBuffer) X(ReadPixels) X(ReadnPixels) X(ReleaseShaderCompiler) \
  X(RenderbufferStorage) X(RenderbufferStorageMultisample) X(ResumeTransformFeedback) X(SampleCoverage) \
  X(SampleMaski) X(SamplerParameterf) X(SamplerParameterfv) X(SamplerParameteri) X(SamplerParameteriv) X(Scissor) \
  X(ScissorArrayv) X(ScissorIndexed) X(ScissorIndexedv) X(ShaderSource) X(ShaderStorageBlockBinding) \
  X(StencilFunc) X(StencilFuncSeparate) X(StencilMask) X(StencilMaskSeparate) X(StencilOp) X(StencilOpSeparate) \
  X(TexBuffer) X(TexBufferRange) X(TexImage1D) X(TexImage2D) X(TexImage2DMultisample) X(TexImage3D) \
  X(TexParameterf) X(TexParameterfv) X(TexParameteri) X(TexParameteriv) X(TexStorage1D) X(TexStorage2D) \
  X(TexStorage2DMultisample) X(TexStorage3D) X(TexSubImage1D) X(TexSubImage2D) X(TexSubImage3D) X(TextureBarrier) \
  X(TextureParameteri) X(TextureStorage2D) X(TextureStorage2DMultisample) X(TextureStorage3D) X(TextureSubImage2D) \
  X(TextureView) X(TransformFeedbackVaryings) X(Uniform1f) X(Uniform1i) X(Uniform1iv) X(Uniform1ui) X(Uniform2f) \
  X(Uniform2fv) X(Uniform2i) X(Uniform3f) X(Uniform3fv) X(Uniform4f) X(Uniform4fv) X(Uniform4i) \
  X(UniformBlockBinding) X(UniformMatrix4fv) X(UnmapBuffer) X(UnmapNamedBuffer) X(UseProgram) X(UseProgramStages) \
  X(ValidateProgram) X(VertexAttribDivisor) X(VertexAttribIPointer) X(VertexAttribPointer) X(Viewport) \
  X(ViewportArrayv) X(ViewportIndexedf) X(ViewportIndexedfv) X(WaitSync)
// clang-format on

namespace tests {

// NOLINTBEGIN(readability-identifier-naming): GL's names
enum class Call : std::size_t {
#define TESTS_GL_ENUMERATOR(name) name,
  TESTS_GL_FUNCTIONS(TESTS_GL_ENUMERATOR)
#undef TESTS_GL_ENUMERATOR
      Count
};
// NOLINTEND(readability-identifier-naming)

inline constexpr std::size_t kCalls = static_cast<std::size_t>(Call::Count);

/// What a call leads to, and how many there were.
struct CallRow {
  void* target = nullptr;
  int count = 0;
};

/// Of all functions; a loader is a plain function, so what its functions read is global.
std::array<CallRow, kCalls>& callRows();

/// True if a call is to do nothing and to answer 0; null: all do what they do.
using Swallows = bool (*)(Call call);
Swallows& swallowsCall();

/// The name as a loader is asked for it.
const char* nameOf(Call call);

/// Index of the function of that name; Call::Count if it is not in the list.
Call callNamed(const char* name);

/// A function that counts and goes on to the call's target.
void* thunkOf(Call call);

} // namespace tests
