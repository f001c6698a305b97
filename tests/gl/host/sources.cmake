# Tests of host/gl, for the executable that includes this file.
set(TYNDALL_GL_HOST_TESTS
  ${CMAKE_CURRENT_LIST_DIR}/ContextTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/EglDeviceTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ObjectsTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SceneDepthTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ShadowMapTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SmallScenes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SmallScenes.h
  ${CMAKE_CURRENT_LIST_DIR}/SmokeTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/StrandTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SurfaceTest.cpp)
