# What the effect decides without GL: profiles, tunings, bands of draws, sizes of textures, what is drawn anew.
set(TYNDALL_UNIT_EFFECT_SOURCES ${CMAKE_CURRENT_LIST_DIR}/BandPacesTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/BandsTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/InputChecksTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/MatrixTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/ProfilesTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/RangeTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/RedrawPlanTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/ResourcesTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/TuningTest.cpp)
set_source_files_properties(${TYNDALL_UNIT_EFFECT_SOURCES} PROPERTIES
  INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/effect/src;${PROJECT_SOURCE_DIR}/glsl"
  COMPILE_DEFINITIONS TYNDALL_RESOURCES_H="${PROJECT_SOURCE_DIR}/effect/src/plan/Resources.h")
