include(${CMAKE_CURRENT_LIST_DIR}/linkHeaders.cmake)
linkHeaders(glm::glm /usr/include/glm)
