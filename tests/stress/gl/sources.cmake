# GL under stress: random states, failures and losses, many effects and sizes, shared contexts.
set(TYNDALL_GL_STRESS_TESTS
  ${CMAKE_CURRENT_LIST_DIR}/ContextLossTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/HiddenFunctionTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ManyEffectsTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/RandomFaultTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/RandomGlState.cpp
  ${CMAKE_CURRENT_LIST_DIR}/RandomGlState.h
  ${CMAKE_CURRENT_LIST_DIR}/RandomStateTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SharedContextTest.cpp)
