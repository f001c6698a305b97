// The effect's own table of GL functions, filled from the engine's loader: no global symbol, one table per effect. Only
// GL names and types that the effect uses are declared here, so that no GL header is needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#if defined(_WIN32)
#define TYNDALL_GLAPI __stdcall
#else
#define TYNDALL_GLAPI
#endif

struct __GLsync; // NOLINT(bugprone-reserved-identifier): the name that GL's headers give it, part of functions' types

namespace tyndall {
class GlLoader;
}

namespace tyndall::gl {

using Enum = std::uint32_t;
using Boolean = std::uint8_t;
using Bitfield = std::uint32_t;
using Int = std::int32_t;
using Sizei = std::int32_t;
using Uint = std::uint32_t;
using Float = float;
using Char = char;
using Intptr = std::ptrdiff_t;
using Sizeiptr = std::ptrdiff_t;
using Int64 = std::int64_t;
using Uint64 = std::uint64_t;
using Sync = ::__GLsync*;

enum class Language { Glsl, Essl };

// X(result, name, arguments, state): state names the row of StateGuard that gives back what the function changes, None
// for functions that change nothing of the engine's (queries, draws into our targets, objects of our own).
#define TYNDALL_GL_REQUIRED(X)                                                                                         \
  X(const std::uint8_t*, GetString, (Enum name), None)                                                                 \
  X(const std::uint8_t*, GetStringi, (Enum name, Uint index), None)                                                    \
  X(Enum, GetError, (), None)                                                                                          \
  X(void, GetIntegerv, (Enum name, Int * value), None)                                                                 \
  X(void, GetIntegeri_v, (Enum name, Uint index, Int * value), None)                                                   \
  X(void, GetInteger64i_v, (Enum name, Uint index, Int64 * value), None)                                               \
  X(void, GetBooleanv, (Enum name, Boolean * value), None)                                                             \
  X(void, GetBooleani_v, (Enum name, Uint index, Boolean * value), None)                                               \
  X(Boolean, IsEnabled, (Enum capability), None)                                                                       \
  X(Boolean, IsEnabledi, (Enum capability, Uint index), None)                                                          \
  X(Boolean, IsTexture, (Uint texture), None)                                                                          \
  X(Boolean, IsVertexArray, (Uint array), None)                                                                        \
  X(void, Enable, (Enum capability), Capabilities)                                                                     \
  X(void, Disable, (Enum capability), Capabilities)                                                                    \
  X(void, Enablei, (Enum capability, Uint index), Capabilities)                                                        \
  X(void, Disablei, (Enum capability, Uint index), Capabilities)                                                       \
  X(void, ActiveTexture, (Enum unit), Textures)                                                                        \
  X(void, BindTexture, (Enum target, Uint texture), Textures)                                                          \
  X(void, GenTextures, (Sizei n, Uint * names), None)                                                                  \
  X(void, DeleteTextures, (Sizei n, const Uint* names), None)                                                          \
  X(void, TexParameteri, (Enum target, Enum name, Int value), None)                                                    \
  X(void, TexImage2D,                                                                                                  \
    (Enum target, Int level, Int internal, Sizei width, Sizei height, Int border, Enum format, Enum type,              \
     const void* pixels),                                                                                              \
    PixelStorage)                                                                                                      \
  X(void, TexImage3D,                                                                                                  \
    (Enum target, Int level, Int internal, Sizei width, Sizei height, Sizei depth, Int border, Enum format, Enum type, \
     const void* pixels),                                                                                              \
    PixelStorage)                                                                                                      \
  X(void, TexSubImage2D,                                                                                               \
    (Enum target, Int level, Int x, Int y, Sizei width, Sizei height, Enum format, Enum type, const void* pixels),     \
    PixelStorage)                                                                                                      \
  X(void, PixelStorei, (Enum name, Int value), PixelStorage)                                                           \
  X(void, GetTexLevelParameteriv, (Enum target, Int level, Enum name, Int * value), None)                              \
  X(void, GetTexParameteriv, (Enum target, Enum name, Int * value), None)                                              \
  X(void, GenSamplers, (Sizei n, Uint * names), None)                                                                  \
  X(void, DeleteSamplers, (Sizei n, const Uint* names), None)                                                          \
  X(void, BindSampler, (Uint unit, Uint sampler), Textures)                                                            \
  X(void, SamplerParameteri, (Uint sampler, Enum name, Int value), None)                                               \
  X(void, GenBuffers, (Sizei n, Uint * names), None)                                                                   \
  X(void, DeleteBuffers, (Sizei n, const Uint* names), None)                                                           \
  X(void, BindBuffer, (Enum target, Uint buffer), UniformBuffers)                                                      \
  X(void, BindBufferBase, (Enum target, Uint index, Uint buffer), UniformBuffers)                                      \
  X(void, BindBufferRange, (Enum target, Uint index, Uint buffer, Intptr offset, Sizeiptr size), UniformBuffers)       \
  X(void, BufferData, (Enum target, Sizeiptr size, const void* data, Enum usage), None)                                \
  X(void, BufferSubData, (Enum target, Intptr offset, Sizeiptr size, const void* data), None)                          \
  X(Boolean, IsBuffer, (Uint buffer), None)                                                                            \
  X(void, GetBufferParameteriv, (Enum target, Enum name, Int * value), None)                                           \
  X(void, GetBufferParameteri64v, (Enum target, Enum name, Int64 * value), None)                                       \
  X(void, GenVertexArrays, (Sizei n, Uint * names), None)                                                              \
  X(void, DeleteVertexArrays, (Sizei n, const Uint* names), None)                                                      \
  X(void, BindVertexArray, (Uint array), VertexArray)                                                                  \
  X(void, VertexAttribDivisor, (Uint index, Uint divisor), None)                                                       \
  X(void, GetVertexAttribiv, (Uint index, Enum name, Int * value), None)                                               \
  X(void, GenFramebuffers, (Sizei n, Uint * names), None)                                                              \
  X(void, DeleteFramebuffers, (Sizei n, const Uint* names), None)                                                      \
  X(void, BindFramebuffer, (Enum target, Uint framebuffer), Framebuffers)                                              \
  X(void, FramebufferTexture2D, (Enum target, Enum attachment, Enum kind, Uint texture, Int level), None)              \
  X(void, FramebufferTextureLayer, (Enum target, Enum attachment, Uint texture, Int level, Int layer), None)           \
  X(void, BlitFramebuffer,                                                                                             \
    (Int fromX, Int fromY, Int fromEndX, Int fromEndY, Int toX, Int toY, Int toEndX, Int toEndY, Bitfield what,        \
     Enum filter),                                                                                                     \
    None)                                                                                                              \
  X(Enum, CheckFramebufferStatus, (Enum target), None)                                                                 \
  X(void, DrawBuffers, (Sizei n, const Enum* buffers), None)                                                           \
  X(Uint, CreateShader, (Enum kind), None)                                                                             \
  X(void, DeleteShader, (Uint shader), None)                                                                           \
  X(void, ShaderSource, (Uint shader, Sizei n, const Char* const* text, const Int* lengths), None)                     \
  X(void, CompileShader, (Uint shader), None)                                                                          \
  X(void, GetShaderiv, (Uint shader, Enum name, Int * value), None)                                                    \
  X(void, GetShaderInfoLog, (Uint shader, Sizei size, Sizei * length, Char * log), None)                               \
  X(Uint, CreateProgram, (), None)                                                                                     \
  X(void, DeleteProgram, (Uint program), None)                                                                         \
  X(void, AttachShader, (Uint program, Uint shader), None)                                                             \
  X(void, DetachShader, (Uint program, Uint shader), None)                                                             \
  X(void, LinkProgram, (Uint program), None)                                                                           \
  X(void, GetProgramiv, (Uint program, Enum name, Int * value), None)                                                  \
  X(void, GetProgramInfoLog, (Uint program, Sizei size, Sizei * length, Char * log), None)                             \
  X(void, UseProgram, (Uint program), Program)                                                                         \
  X(Int, GetUniformLocation, (Uint program, const Char* name), None)                                                   \
  X(void, GetActiveUniform,                                                                                            \
    (Uint program, Uint index, Sizei size, Sizei * length, Int * count, Enum * type, Char * name), None)               \
  X(void, Uniform1i, (Int location, Int value), None)                                                                  \
  X(Uint, GetUniformBlockIndex, (Uint program, const Char* name), None)                                                \
  X(void, UniformBlockBinding, (Uint program, Uint index, Uint binding), None)                                         \
  X(void, DrawArrays, (Enum mode, Int first, Sizei count), None)                                                       \
  X(void, DrawArraysInstanced, (Enum mode, Int first, Sizei count, Sizei instances), None)                             \
  X(void, GenRenderbuffers, (Sizei n, Uint * names), None)                                                             \
  X(void, DeleteRenderbuffers, (Sizei n, const Uint* names), None)                                                     \
  X(void, BindRenderbuffer, (Enum target, Uint renderbuffer), Renderbuffer)                                            \
  X(void, RenderbufferStorage, (Enum target, Enum format, Sizei width, Sizei height), None)                            \
  X(void, FramebufferRenderbuffer, (Enum target, Enum attachment, Enum kind, Uint renderbuffer), None)                 \
  X(void, ClearBufferiv, (Enum buffer, Int index, const Int* value), None)                                             \
  X(void, ClearBufferfv, (Enum buffer, Int index, const Float* value), None)                                           \
  X(void, StencilFunc, (Enum function, Int reference, Uint mask), Stencil)                                             \
  X(void, StencilOp, (Enum fail, Enum depthFail, Enum pass), Stencil)                                                  \
  X(void, StencilMask, (Uint mask), Stencil)                                                                           \
  X(void, StencilFuncSeparate, (Enum face, Enum function, Int reference, Uint mask), Stencil)                          \
  X(void, StencilOpSeparate, (Enum face, Enum fail, Enum depthFail, Enum pass), Stencil)                               \
  X(void, StencilMaskSeparate, (Enum face, Uint mask), Stencil)                                                        \
  X(void, Viewport, (Int x, Int y, Sizei width, Sizei height), Viewports)                                              \
  X(void, Scissor, (Int x, Int y, Sizei width, Sizei height), Viewports)                                               \
  X(void, BlendFuncSeparate, (Enum srcRgb, Enum dstRgb, Enum srcAlpha, Enum dstAlpha), Blending)                       \
  X(void, BlendEquationSeparate, (Enum rgb, Enum alpha), Blending)                                                     \
  X(void, ColorMaski, (Uint index, Boolean r, Boolean g, Boolean b, Boolean a), ColourMasks)                           \
  X(void, Flush, (), None)                                                                                             \
  X(void, Finish, (), None)                                                                                            \
  X(void, GenQueries, (Sizei n, Uint * names), None)                                                                   \
  X(void, DeleteQueries, (Sizei n, const Uint* names), None)                                                           \
  X(void, BeginQuery, (Enum target, Uint query), None)                                                                 \
  X(void, EndQuery, (Enum target), None)                                                                               \
  X(void, GetQueryiv, (Enum target, Enum name, Int * value), None)                                                     \
  X(void, Clear, (Bitfield buffers), None)                                                                             \
  X(void, ColorMask, (Boolean r, Boolean g, Boolean b, Boolean a), ColourMasks)                                        \
  X(void, CopyBufferSubData, (Enum from, Enum to, Intptr fromOffset, Intptr toOffset, Sizeiptr size), None)            \
  X(Sync, FenceSync, (Enum condition, Bitfield flags), None)                                                           \
  X(Enum, ClientWaitSync, (Sync sync, Bitfield flags, Uint64 nanoseconds), None)                                       \
  X(void, DeleteSync, (Sync sync), None)                                                                               \
  X(void, ReadPixels, (Int x, Int y, Sizei width, Sizei height, Enum format, Enum type, void* pixels), PixelStorage)

// Functions that OpenGL ES lacks; null there, but for those that an extension brings under another name.
#define TYNDALL_GL_DESKTOP(X)                                                                                          \
  X(void, GetBufferSubData, (Enum target, Intptr offset, Sizeiptr size, void* data), None)                             \
  X(void, PolygonMode, (Enum face, Enum mode), PolygonMode)                                                            \
  X(void, QueryCounter, (Uint query, Enum target), None)                                                               \
  X(void, GetQueryObjectui64v, (Uint query, Enum name, Uint64 * value), None)

// What takes their place there; null in others.
#define TYNDALL_GL_EMBEDDED(X)                                                                                         \
  X(void*, MapBufferRange, (Enum target, Intptr offset, Sizeiptr size, Bitfield access), None)                         \
  X(Boolean, UnmapBuffer, (Enum target), None)

// Functions of later versions that state of later versions needs; null where the context lacks them. A loader may know
// some that a context does not: the version decides, and where it is too low an extension (LoadFunctions.cpp).
#define TYNDALL_GL_OPTIONAL(X)                                                                                         \
  X(void, GetFloati_v, (Enum name, Uint index, Float * value), None)                                                   \
  X(void, ViewportIndexedf, (Uint index, Float x, Float y, Float width, Float height), Viewports)                      \
  X(void, ScissorIndexed, (Uint index, Int x, Int y, Sizei width, Sizei height), Viewports)                            \
  X(void, BlendFuncSeparatei, (Uint index, Enum srcRgb, Enum dstRgb, Enum srcAlpha, Enum dstAlpha), Blending)          \
  X(void, BlendEquationSeparatei, (Uint index, Enum rgb, Enum alpha), Blending)                                        \
  X(void, DispatchCompute, (Uint x, Uint y, Uint z), None)                                                             \
  X(void, MemoryBarrier, (Bitfield barriers), None)                                                                    \
  X(void, BindImageTexture,                                                                                            \
    (Uint unit, Uint texture, Int level, Boolean layered, Int layer, Enum access, Enum format), Images)                \
  X(void, TexStorage3D, (Enum target, Sizei levels, Enum format, Sizei width, Sizei height, Sizei depth), None)        \
  X(void, ClearBufferSubData,                                                                                          \
    (Enum target, Enum internal, Intptr offset, Sizeiptr size, Enum format, Enum type, const void* data), None)        \
  X(void, ClipControl, (Enum origin, Enum depth), ClipControl)                                                         \
  X(Enum, GetGraphicsResetStatus, (), None)                                                                            \
  X(Enum, GetGraphicsResetStatusARB, (), None)                                                                         \
  X(void, GetProgramBinary, (Uint program, Sizei size, Sizei * length, Enum * format, void* bytes), None)              \
  X(void, ProgramBinary, (Uint program, Enum format, const void* bytes, Sizei length), None)                           \
  X(void, ProgramParameteri, (Uint program, Enum name, Int value), None)                                               \
  X(void, ObjectLabel, (Enum kind, Uint name, Sizei length, const Char* text), None)                                   \
  X(void, PushDebugGroup, (Enum source, Uint id, Sizei length, const Char* message), None)                             \
  X(void, PopDebugGroup, (), None)                                                                                     \
  X(void, GetTextureParameteriv, (Uint texture, Enum name, Int * value), None)                                         \
  X(void, ActiveStencilFaceEXT, (Enum face), Legacy)                                                                   \
  X(void, BindTextures, (Uint first, Sizei n, const Uint* textures), Textures)                                         \
  X(void, BindSamplers, (Uint first, Sizei n, const Uint* samplers), Textures)

// Functions that the compatibility profile needs: null in other contexts.
#define TYNDALL_GL_LEGACY(X)                                                                                           \
  X(void, GetFloatv, (Enum name, Float * value), None)                                                                 \
  X(void, ClampColor, (Enum target, Enum clamp), Legacy)                                                               \
  X(void, PixelTransferf, (Enum name, Float value), Legacy)

struct Functions {
  // NOLINTBEGIN(readability-identifier-naming): GL's names
#define TYNDALL_GL_DECLARE(result, name, arguments, state) result(TYNDALL_GLAPI* name) arguments = nullptr;
  TYNDALL_GL_REQUIRED(TYNDALL_GL_DECLARE)
  TYNDALL_GL_OPTIONAL(TYNDALL_GL_DECLARE)
  TYNDALL_GL_LEGACY(TYNDALL_GL_DECLARE)
  TYNDALL_GL_DESKTOP(TYNDALL_GL_DECLARE)
  TYNDALL_GL_EMBEDDED(TYNDALL_GL_DECLARE)
#undef TYNDALL_GL_DECLARE
  // NOLINTEND(readability-identifier-naming)

  // What the context can do: settled once, by its version and extensions (LoadFunctions.cpp).
  Language language = Language::Glsl; ///< of its shaders; ESSL: of OpenGL ES
  int version = 0;                    ///< 10 * major + minor of the context
  bool compatibility = false;         ///< of the compatibility profile
  bool indexedBlending = false;       ///< functions, factors and equations for each draw buffer
  bool viewportArrays = false;
  bool cubeArrays = false;       ///< GL_TEXTURE_CUBE_MAP_ARRAY is a target
  bool stencilTexturing = false; ///< a texture may show its stencil in place of its depth
  bool normalised16 = false;     ///< textures of 16-bit normalised integers that can be drawn into
  bool countsSamples = false;    ///< queries of how many samples passed
  bool timerQueries = false;
  bool feedbackQuery = false;   ///< it says whether transform feedback is active
  bool parallelCompile = false; ///< it says whether a program is complete without waiting for it
  bool debugOutput = false;     ///< GL_DEBUG_OUTPUT and debug groups
  bool dualSource = false;      ///< blending with two sources
  int clipDistances = 0;        ///< that may be enabled

  /// Fills the table. Returns the name of the first required function that the loader does not know, empty if all are.
  std::string load(GlLoader loader);
  /// Likewise what only this kind of context has: desktop, embedded, of the compatibility profile.
  std::string loadOwn(GlLoader loader);
};

} // namespace tyndall::gl
