# Views, shadow fitting and the geometry under them. The executable links tyndall_scene.
set(TYNDALL_UNIT_VIEW_SOURCES
  ${CMAKE_CURRENT_LIST_DIR}/AdviceTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ConvexPolygonTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ProjectionTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ShadowViewsTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SteadyViewsTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ViewScenes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ViewScenes.h
  ${CMAKE_CURRENT_LIST_DIR}/ViewTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/WorldGeometryTest.cpp)
