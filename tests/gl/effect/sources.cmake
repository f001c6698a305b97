# Tests of the effect, for the executable that includes this file.
set(TYNDALL_GL_EFFECT_TESTS
  ${CMAKE_CURRENT_LIST_DIR}/AirlightTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/CompositeTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ConventionTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/DriverFailureTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/EffectContextTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/EpipolarTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ExactTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/FakeContext.cpp
  ${CMAKE_CURRENT_LIST_DIR}/FrameTexturesTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/FrameValuesTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/NonFiniteTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/RefusalRig.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SceneRig.cpp
  ${CMAKE_CURRENT_LIST_DIR}/StabilityTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/StateTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SymmetryTest.cpp)
