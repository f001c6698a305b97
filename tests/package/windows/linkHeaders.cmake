# linkHeaders(TARGET FOLDER): an imported target for the headers in FOLDER, alone. Debian has them beside glibc's, which
# must not be seen.
function(linkHeaders target folder)
  get_filename_component(name ${folder} NAME)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/headers)
  file(CREATE_LINK ${folder} ${CMAKE_BINARY_DIR}/headers/${name} SYMBOLIC)
  add_library(${target} INTERFACE IMPORTED)
  target_include_directories(${target} INTERFACE ${CMAKE_BINARY_DIR}/headers)
endfunction()
