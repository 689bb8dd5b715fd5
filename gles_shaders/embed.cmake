cmake_minimum_required(VERSION 3.25)

# cmake -DOUT=file.cpp -DDIR=folder -DROOT=folder -DNAMES="a.comp,b.frag" -P embed.cmake
# Writes the sources of all shaders as strings into one C++ file. #include "x.glsl" is replaced by
# that file in DIR. #include "path/x.h" is replaced by that parameter header in ROOT, translated to
# GLSL. Each file is included only once per shader.

cmake_policy(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/params_to_glsl.cmake)

function(resolve name seen_var out_var)
    if(name MATCHES "\\.h$")
        params_to_glsl("${ROOT}" "${name}" text)
    else()
        file(READ "${DIR}/${name}" text)
    endif()
    string(REGEX MATCH "#include \"([^\"]+)\"[^\n]*\n" line "${text}")
    set(seen ${${seen_var}})
    while(line)
        set(inner ${CMAKE_MATCH_1})
        set(body "")
        if(NOT inner IN_LIST seen)
            list(APPEND seen ${inner})
            resolve(${inner} seen body)
        endif()
        string(REPLACE "${line}" "${body}" text "${text}")
        string(REGEX MATCH "#include \"([^\"]+)\"[^\n]*\n" line "${text}")
    endwhile()
    set(${seen_var} ${seen} PARENT_SCOPE)
    set(${out_var} "${text}" PARENT_SCOPE)
endfunction()

string(REPLACE "," ";" names "${NAMES}")
set(entries "")
foreach(name IN LISTS names)
    set(seen "")
    resolve(${name} seen text)
    string(APPEND entries "    {\"${name}\", R\"GLSL(${text})GLSL\"sv},\n")
endforeach()
file(WRITE "${OUT}" "#include \"gles_shaders/shaders.h\"

#include <array>
#include <stdexcept>
#include <string>

namespace mfar::shaders {
namespace {

using namespace std::string_view_literals;

constexpr Source kAll[] = {
${entries}};

}  // namespace

std::span<const Source> all() {
    return kAll;
}

std::string_view source(std::string_view name) {
    for (const Source& s : kAll)
        if (s.name == name) return s.text;
    throw std::out_of_range(\"no shader \" + std::string(name));
}

}  // namespace mfar::shaders
")
