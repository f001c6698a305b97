// What contexts of the compatibility profile still have of OpenGL 1: rows of the GL state and of the hostile engines.
#pragma once

#include "GlState.h"
#include "HostileRows.h"

namespace tests {

/// Whether the tests' context is of the compatibility profile; in others the rest does nothing.
bool isCompatibility();

void addLegacyState(GlState& state);
/// What those rows are that StateMode::Leave changes.
GlState leftLegacyState();

/// All rows that the effect could change to something that no renderer has by default; and GL's defaults again.
void poisonLegacyState();
void leaveCleanLegacyState();

void addLegacyRows(std::vector<HostileRow>& rows);

} // namespace tests
