// Rules of AvsmConfig, by itself and in a context, and the words in which an argument is refused.
#pragma once

#include "gl/Functions.h"

#include <string>
#include <tyndall/avsm.h>

namespace tyndall::avsm {

Status checkConfig(const AvsmConfig& config);

/// Of what the context can hold.
Status checkLimits(const gl::Functions& gl, const AvsmConfig& config);

/// What a function of OpenGL 4.3 that is missing is called; empty if none is.
std::string missingFunction(const gl::Functions& gl);

/// "particles.stride is 3: must be ...", of an argument of a call; without a value "field: the rule".
inline Status refuse(const std::string& field, const std::string& value, const std::string& rule) {
  return {StatusCode::InvalidFrame, field + (value.empty() ? "" : " is " + value) + ": " + rule};
}

} // namespace tyndall::avsm
