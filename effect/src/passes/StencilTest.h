// The stencil test, while this lives.
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"

namespace tyndall::passes {

class StencilTest {
public:
  struct Rule {
    gl::Enum function; ///< compares reference and stencil, both & mask
    gl::Int reference; ///< also what REPLACE writes
    gl::Uint mask;
    gl::Enum passed; ///< KEEP or REPLACE
  };
  StencilTest(const gl::Functions& gl, const Rule& rule) : gl_(gl) {
    gl.Enable(gl::STENCIL_TEST);
    gl.StencilFunc(rule.function, rule.reference, rule.mask);
    gl.StencilOp(gl::KEEP, gl::KEEP, rule.passed);
  }
  ~StencilTest() { gl_.Disable(gl::STENCIL_TEST); }
  StencilTest(const StencilTest&) = delete;
  StencilTest& operator=(const StencilTest&) = delete;

private:
  const gl::Functions& gl_;
};

} // namespace tyndall::passes
