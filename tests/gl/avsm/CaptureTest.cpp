// What avsmCapture records, and what it leaves out.
#include "AvsmRig.h"

#include <catch2/catch.hpp>
