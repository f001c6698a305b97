include(${CMAKE_CURRENT_LIST_DIR}/linkHeaders.cmake)
linkHeaders(Eigen3::Eigen /usr/include/eigen3/Eigen)
