// The three commands. Each returns the exit status, and throws host::Error or render::UsageError where that is 2.
#pragma once

#include "Arguments.h"

namespace regress {

int record(const Arguments& arguments);
int check(const Arguments& arguments);
int report(const Arguments& arguments);

} // namespace regress
