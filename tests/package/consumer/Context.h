// The engine's OpenGL context.
#pragma once

/// Makes a core profile current and returns what gives its functions; null, and says why, if there is none to be had.
void* (*openContext())(const char* name);
