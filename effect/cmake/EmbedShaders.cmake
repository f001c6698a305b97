# Writes OUTPUT, a C++ file that holds every shader of SHADERS (names relative to ROOT) with its #include lines resolved,
# each file at most once per shader, and without lines of comments. A text is kept in pieces that every compiler takes as a
# literal: C++ promises 65,536 characters, adjacent ones joined, and MSVC takes 16,380.
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

# Appends TEXT to the caller's `code` as literals of at most LONGEST bytes, each of whole lines.
function(append_literals text)
  set(longest 12000)
  string(LENGTH "${text}" length)
  while(length GREATER longest)
    string(SUBSTRING "${text}" 0 ${longest} piece)
    string(FIND "${piece}" "\n" end REVERSE)
    math(EXPR end "${end} + 1")
    string(SUBSTRING "${text}" 0 ${end} piece)
    string(SUBSTRING "${text}" ${end} -1 text)
    string(APPEND code "    R\"glsl(${piece})glsl\",\n")
    string(LENGTH "${text}" length)
  endwhile()
  string(APPEND code "    R\"glsl(${text})glsl\",\n")
  set(code "${code}" PARENT_SCOPE)
endfunction()

set(code "// Generated from glsl/ by EmbedShaders.cmake.\n#include \"gl/ShaderSources.h\"\n\nnamespace tyndall {\nnamespace {\n")
string(APPEND code "\n// Each shader: its name, the pieces of its text, null.\nconstexpr const char* kShaders[] = {\n")
foreach(shader IN LISTS SHADERS)
  set(seen "")
  resolve("${shader}" text seen)
  if(shader MATCHES "^public/(.*)")
    file(WRITE "${PUBLIC}/${CMAKE_MATCH_1}" "${text}")
  endif()
  string(REGEX REPLACE "\n *//[^\n]*" "" text "${text}")
  string(APPEND code "    \"${shader}\",\n")
  append_literals("${text}")
  string(APPEND code "    nullptr,\n")
endforeach()
string(APPEND code [[
};
} // namespace

std::string shaderSource(const std::string& name) {
  std::string text;
  bool found = false;
  for (std::size_t i = 0; i < sizeof(kShaders) / sizeof(kShaders[0]) && !found; ++i) {
    found = name == kShaders[i];
    for (++i; kShaders[i] != nullptr; ++i)
      if (found) text += kShaders[i];
  }
  return text;
}

} // namespace tyndall
]])
file(WRITE "${OUTPUT}.new" "${code}")
file(COPY_FILE "${OUTPUT}.new" "${OUTPUT}" ONLY_IF_DIFFERENT)
file(REMOVE "${OUTPUT}.new")
file(TOUCH_NOCREATE "${OUTPUT}")
