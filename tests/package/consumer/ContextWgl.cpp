// A hidden window of Windows and its WGL context, by the functions that every Windows has.
#include "Context.h"

#include <cstdio>
#include <windows.h>

namespace {

using CreateContextAttribs = HGLRC(WINAPI*)(HDC, HGLRC, const int*);

/// opengl32.dll has the functions of OpenGL 1.1, the driver all others.
void* load(const char* name) {
  static const HMODULE library = LoadLibraryA("opengl32.dll");
  const PROC function = wglGetProcAddress(name);
  return reinterpret_cast<void*>(function ? function : reinterpret_cast<PROC>(GetProcAddress(library, name)));
}

bool fail(const char* what) {
  std::fprintf(stderr, "no WGL context: %s\n", what);
  return false;
}

bool makeCurrent() {
  const HWND window =
      CreateWindowA("STATIC", "consumer", WS_OVERLAPPED, 0, 0, 16, 16, nullptr, nullptr, nullptr, nullptr);
  if (!window) return fail("no window");
  const HDC device = GetDC(window);
  PIXELFORMATDESCRIPTOR format = {};
  format.nSize = sizeof(format);
  format.nVersion = 1;
  format.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER;
  format.cColorBits = 24;
  if (!SetPixelFormat(device, ChoosePixelFormat(device, &format), &format)) return fail("no pixel format");
  const HGLRC first = wglCreateContext(device);
  if (!first || !wglMakeCurrent(device, first)) return fail("no context");
  const auto create = reinterpret_cast<CreateContextAttribs>(load("wglCreateContextAttribsARB"));
  if (!create) return fail("no WGL_ARB_create_context");
  const int attributes[] = {0x2091, 3, 0x2092, 3, 0x9126, 1, 0}; // version 3.3, core profile
  const HGLRC core = create(device, nullptr, attributes);
  if (!core || !wglMakeCurrent(device, core)) return fail("no core profile of OpenGL 3.3");
  wglDeleteContext(first);
  return true;
}

} // namespace

void* (*openContext())(const char* name) { return makeCurrent() ? load : nullptr; }
