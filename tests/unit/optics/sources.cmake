set(TYNDALL_UNIT_OPTICS_SOURCES ${CMAKE_CURRENT_LIST_DIR}/AtmosphereTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/EyeLightTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/FrameBlockTest.cpp
                                 ${CMAKE_CURRENT_LIST_DIR}/LayersTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/LightBlockTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/LightVolumeTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/LowRankTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/MatricesTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/MeshBoxTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/MovedSlicesTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/OpticsCases.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/SampleBudgetTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/SharedLayoutTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/SliceRowsTest.cpp
                               ${CMAKE_CURRENT_LIST_DIR}/SlicesTest.cpp)
# Eigen's and the library's own headers, for these files only.
find_package(Eigen3 REQUIRED)
get_target_property(eigen_includes Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
set_source_files_properties(${TYNDALL_UNIT_OPTICS_SOURCES} PROPERTIES
  INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/effect/src;${PROJECT_SOURCE_DIR}/glsl"
  COMPILE_DEFINITIONS TYNDALL_SHARED_GLSL="${PROJECT_SOURCE_DIR}/glsl/shared.glsl"
  COMPILE_OPTIONS "-isystem${eigen_includes}")
