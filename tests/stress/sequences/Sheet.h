// A texture of the engine's, and a key of what it holds.
#pragma once

#include "Script.h"
#include "gl/Objects.h"

#include <functional>

namespace stress {

struct SheetForm {
  GLenum format = GL_R32F;
  int width = 1, height = 1;
  int layers = 0; ///< 0: a GL_TEXTURE_2D
};

class Sheet {
public:
  /// Makes it anew if it has another form, and writes what `draw` gives, layer by layer, unless it holds that already.
  void show(const SheetForm& form, std::uint64_t key, const std::function<std::vector<float>()>& draw);
  void write(const std::vector<float>& values); ///< whatever it holds
  void makeFor(const SheetForm& form);

  GLuint name() const { return texture_.name(); }
  const SheetForm& form() const { return form_; }
  std::uint64_t holds() const { return key_; }

private:
  host::GlTexture texture_;
  SheetForm form_;
  std::uint64_t key_ = 0;
};

/// Puts images into one layer or texture: an image's rows at x, y of a larger one.
void place(std::vector<float>& into, int width, int x, int y, const std::vector<float>& image, int imageWidth,
           int channels = 1);

} // namespace stress
