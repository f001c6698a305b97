# Tests of tests/reference, for the unit test executable. It links tyndall_reference and tyndall_scene, has
# tests/ among its include folders and TYNDALL_SHARED_DIR defined as a string.
set(TYNDALL_UNIT_REFERENCE_SOURCES
  ${CMAKE_CURRENT_LIST_DIR}/CameraRaysTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/MapExactTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/MetricsTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/OpticsTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SceneExactTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/TruthTest.cpp)
