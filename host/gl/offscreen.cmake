# The sources of contexts without a window, which stand alone: they need no OpenGL loader and no library but libdl.
set(TYNDALL_OFFSCREEN_SOURCES ContextEgl.cpp ContextOsmesa.cpp Driver.cpp EglLibrary.cpp Library.cpp)
set(TYNDALL_OFFSCREEN_SCENE_SOURCES FileIo.cpp Tool.cpp) # what they take of ../scene
