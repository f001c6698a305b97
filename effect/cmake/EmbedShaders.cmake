# Writes OUTPUT, a C++ file that holds every shader of SHADERS (names relative to ROOT) with its #include lines resolved,
# each file at most once per shader, and without lines of comments: C++ promises no more than 65,536 characters.
# Those of public/ are written to the directory PUBLIC, too, with their comments, for engines that read files.
# Run as a script: cmake -DROOT=… -DOUTPUT=… -DPUBLIC=… "-DSHADERS=a;b" -P EmbedShaders.cmake
cmake_minimum_required(VERSION 3.22)

# Sets RESULT in the caller to the text of FILE with its includes in place; INCLUDED lists the files already in it.
function(resolve file result included_list)
  file(READ "${ROOT}/${file}" text)
  set(included ${${included_list}})
  list(APPEND included "${file}")
  string(REGEX MATCHALL "#include \"[^\"\n]+\"" lines "${text}")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "#include \"([^\"]+)\"" "\\1" name "${line}")
    set(body "")
    if(NOT name IN_LIST included)
      resolve("${name}" body included)
    endif()
    string(REPLACE "${line}" "${body}" text "${text}")
  endforeach()
  set(${result} "${text}" PARENT_SCOPE)
  set(${included_list} ${included} PARENT_SCOPE)
endfunction()

set(code "// Generated from glsl/ by EmbedShaders.cmake.\n#include \"gl/ShaderSources.h\"\n\n#include <cstring>\n\nnamespace tyndall {\nnamespace {\nstruct Entry {\n  const char* name;\n  const char* text;\n};\nconstexpr Entry kEntries[] = {\n")
foreach(shader IN LISTS SHADERS)
  set(seen "")
  resolve("${shader}" text seen)
  if(shader MATCHES "^public/(.*)")
    file(WRITE "${PUBLIC}/${CMAKE_MATCH_1}" "${text}")
  endif()
  string(REGEX REPLACE "\n *//[^\n]*" "" text "${text}")
  string(APPEND code "    {\"${shader}\", R\"glsl(${text})glsl\"},\n")
endforeach()
string(APPEND code "};\n} // namespace\n\nconst char* shaderSource(const char* name) {\n  for (const Entry& entry : kEntries)\n    if (std::strcmp(entry.name, name) == 0) return entry.text;\n  return nullptr;\n}\n\n} // namespace tyndall\n")
file(WRITE "${OUTPUT}.new" "${code}")
file(COPY_FILE "${OUTPUT}.new" "${OUTPUT}" ONLY_IF_DIFFERENT)
file(REMOVE "${OUTPUT}.new")
file(TOUCH_NOCREATE "${OUTPUT}")
