# Scene, medium and image files. The executable links tyndall_scene, tyndall_scene_generators and nlohmann_json, has
# tests/ among its include folders and TYNDALL_SHARED_DIR defined as a string.
set(TYNDALL_UNIT_SCENE_SOURCES
  ${CMAKE_CURRENT_LIST_DIR}/AnimationTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/BrokenFilesTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/CameraLightTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/FileIoTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/FogTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/GeometryTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/GltfFile.cpp
  ${CMAKE_CURRENT_LIST_DIR}/GltfFile.h
  ${CMAKE_CURRENT_LIST_DIR}/HostileImageTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ImageFileTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/InvalidCorpusTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/MaterialTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/MediumFileTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/NodeTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/OrreryTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ProgramFilesTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SampleFilesTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SceneRules.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SceneRules.h
  ${CMAKE_CURRENT_LIST_DIR}/SmokeTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/WrittenScenesTest.cpp)
