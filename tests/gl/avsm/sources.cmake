# Tests of adaptive volumetric shadow maps, for the executable that includes this file.
set(TYNDALL_GL_AVSM_TESTS
  ${CMAKE_CURRENT_LIST_DIR}/AvsmContextTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/AvsmFaultTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/AvsmRig.cpp
  ${CMAKE_CURRENT_LIST_DIR}/AvsmShaderTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/CaptureTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/CurveTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/EyeCurvesFrameTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/EyeCurvesTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/FogTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/FragmentTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ParticleTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ShaftTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/StreamTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/VolumeRig.cpp
  ${CMAKE_CURRENT_LIST_DIR}/VolumeTest.cpp)
