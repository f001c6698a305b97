// Compute programs, and buffers and texts for them.
#pragma once

#include <gl/Objects.h>
#include <string>
#include <utility>
#include <vector>

namespace avsmbench {

using Defines = std::vector<std::pair<std::string, int>>;

/// Of OpenGL 4.3. Files are named from this folder's shaders/ or from the effect's glsl/. Throws host::Error with the
/// log.
class ComputeProgram {
public:
  explicit ComputeProgram(const std::vector<std::string>& files, const Defines& defines = {},
                          const std::string& declarations = {});
  ~ComputeProgram();
  ComputeProgram(const ComputeProgram&) = delete;
  ComputeProgram& operator=(const ComputeProgram&) = delete;

  void use() const;
  void set(const char* uniform, int value) const; ///< needs it in use
  void set(const char* uniform, float value) const;
  /// Of the program in use, and a barrier behind it for all that a shader can write.
  static void dispatch(std::size_t groupsX, std::size_t groupsY = 1);

private:
  GLuint name_;
};

/// Binds it; `data` may be null.
void fillStorage(const host::GlBuffer& buffer, GLuint binding, std::size_t bytes, const void* data);

} // namespace avsmbench
