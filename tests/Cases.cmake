# Test cases one by one in ctest. tyndall_add_cases(TARGET PREFIX p [LABELS l...] [ENVIRONMENT e=v...] [SELECT spec...]
# [TIMEOUT s]) registers every case of a Catch2 executable that fits the selection as p.CASE; those
# tagged [slow] are labelled so, too. It may be called several times for one executable. The executable is asked for its
# cases after each link. (Catch2's own catch_discover_tests passes on one label and one variable at most, and breaks
# names at semicolons.)
function(tyndall_add_cases target)
  cmake_parse_arguments(arg "" "PREFIX;TIMEOUT" "LABELS;ENVIRONMENT;SELECT" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 1800)
  endif()
  set(file ${CMAKE_CURRENT_BINARY_DIR}/${arg_PREFIX}.cases.cmake)
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${file} VERBATIM
    COMMAND ${CMAKE_COMMAND} -DEXECUTABLE=$<TARGET_FILE:${target}> -DFILE=${file} -DPREFIX=${arg_PREFIX}
            -DTIMEOUT=${arg_TIMEOUT} "-DLABELS=${arg_LABELS}" "-DENVIRONMENT=${arg_ENVIRONMENT}"
            "-DSELECT=${arg_SELECT}" "-DOPTIONS=${TYNDALL_NO_TESTS_FAIL}"
            "-DLIST=${TYNDALL_LIST_TESTS}" -P ${PROJECT_SOURCE_DIR}/tests/Cases.cmake)
  if(sanitize IN_LIST arg_LABELS)
    add_dependencies(tyndall_sanitized_tests ${target})
  endif()
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${arg_PREFIX}.include.cmake)
  file(WRITE ${include} "include(\"${file}\" OPTIONAL RESULT_VARIABLE found)
if(NOT found) # not built yet: a run that meets this fails
  add_test(${arg_PREFIX} ${target}-is-not-built)
endif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()

# What follows runs after the link.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()

cmake_minimum_required(VERSION 3.22)
string(ASCII 2 semicolon)
string(ASCII 3 opening)
string(ASCII 4 closing)

# The cases that fit a selection, as a list; brackets and semicolons, which lists cannot hold, are stand-ins until use.
function(list_cases result)
  execute_process(COMMAND ${EXECUTABLE} ${LIST} ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(errors)
    message(FATAL_ERROR "${EXECUTABLE} does not list its cases: ${errors}")
  endif()
  string(REPLACE ";" "${semicolon}" output "${output}")
  string(REPLACE "[" "${opening}" output "${output}")
  string(REPLACE "]" "${closing}" output "${output}")
  string(REGEX REPLACE "\n+$" "" output "${output}")
  string(REPLACE "\n" ";" output "${output}")
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

function(restore result text)
  string(REPLACE "${semicolon}" ";" text "${text}")
  string(REPLACE "${opening}" "[" text "${text}")
  string(REPLACE "${closing}" "]" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Words, each as a bracket argument.
function(quote result)
  set(words "")
  foreach(word IN LISTS ARGN)
    string(APPEND words " [==[${word}]==]")
  endforeach()
  set(${result} "${words}" PARENT_SCOPE)
endfunction()

list_cases(all ${SELECT})
list_cases(slow ${SELECT} "[slow]")
if(NOT all)
  message(FATAL_ERROR "no case of ${EXECUTABLE} fits ${SELECT}")
endif()
quote(options ${OPTIONS})
set(script "")
foreach(case IN LISTS all)
  set(labels ${LABELS})
  set(cost 0)
  if(case IN_LIST slow) # first, so that none is left running alone at the end
    list(APPEND labels slow)
    list(REMOVE_DUPLICATES labels)
    set(cost 1000)
  endif()
  restore(name "${case}")
  string(REGEX REPLACE "(^-|[][,\\\\])" "\\\\\\1" argument "${name}") # what begins with "-" is no option
  string(APPEND script "add_test([==[${PREFIX}.${name}]==] [==[${EXECUTABLE}]==] [==[${argument}]==]${options})\n"
    "set_tests_properties([==[${PREFIX}.${name}]==] PROPERTIES TIMEOUT ${TIMEOUT} COST ${cost} SKIP_RETURN_CODE 77 "
    "LABELS [==[${labels}]==] ENVIRONMENT [==[${ENVIRONMENT}]==])\n")
endforeach()
file(WRITE ${FILE} "${script}")
