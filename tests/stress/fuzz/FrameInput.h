// A Frame from bytes: mostly as engines fill it in, with now and then a number in it that nobody would write.
#pragma once

#include "Fuzz.h"

#include <tyndall/tyndall.h>

namespace fuzz {

/// Texture names are numbers that stand for textures; none is looked at.
tyndall::Frame frameOf(Numbers& numbers);

} // namespace fuzz
