# Views, shadow fitting and the geometry under them.
set(TYNDALL_UNIT_VIEW_SOURCES
  ${CMAKE_CURRENT_LIST_DIR}/TestConvexPolygon.cpp
  ${CMAKE_CURRENT_LIST_DIR}/TestProjection.cpp
  ${CMAKE_CURRENT_LIST_DIR}/TestShadowViews.cpp
  ${CMAKE_CURRENT_LIST_DIR}/TestView.cpp
  ${CMAKE_CURRENT_LIST_DIR}/TestWorldGeometry.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ViewScenes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ViewScenes.h)
