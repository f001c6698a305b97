# Tests of the effect, for the executable that includes this file.
set(TYNDALL_GL_EFFECT_TESTS
  ${CMAKE_CURRENT_LIST_DIR}/AirlightTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ExactTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/StateTest.cpp)
