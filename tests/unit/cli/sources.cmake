# The tools as a user meets them. The executable lies beside them, depends on them (add_dependencies), and links tyndall_scene and nlohmann_json.
set(TYNDALL_UNIT_CLI_SOURCES
  ${CMAKE_CURRENT_LIST_DIR}/BadInputTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/ContextsTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/FailureReportTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/NotesTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/OutputsTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/RenderTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/RunTool.cpp
  ${CMAKE_CURRENT_LIST_DIR}/RunTool.h
  ${CMAKE_CURRENT_LIST_DIR}/ShareTest.cpp
  ${CMAKE_CURRENT_LIST_DIR}/StreamsTest.cpp)
