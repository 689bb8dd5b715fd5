cmake_minimum_required(VERSION 3.25)

# cmake -DHEADER=/usr/include/GLES3/gl31.h -DINCLUDE=GLES3/gl31.h -DMACRO=GL_APICALL -DNAME=Gles
#       -DOUT=file.cpp [-DVISIBILITY=default] -P forwarders.cmake
# Writes a C++ file that defines every function that a Khronos header declares. Each function jumps
# through a table, which connectNAME() fills. HEADER must be the header that the sources are
# compiled with (host or sysroot). Khronos' headers have one prototype per line:
#   GL_APICALL void GL_APIENTRY glUniform1fv (GLint location, GLsizei count, const GLfloat *value);

cmake_policy(VERSION 3.25)

# "GLint location, const GLchar *const*string" becomes "location, string".
function(parameter_names parameters out_var)
    set(names "")
    if(NOT parameters STREQUAL "void")
        string(REPLACE "," ";" parameters "${parameters}")
        foreach(parameter IN LISTS parameters)
            if(NOT parameter MATCHES "[ *]([A-Za-z_][A-Za-z_0-9]*)$")
                message(FATAL_ERROR "${HEADER}: a parameter without a name: ${parameter}")
            endif()
            list(APPEND names ${CMAKE_MATCH_1})
        endforeach()
    endif()
    list(JOIN names ", " names)
    set(${out_var} "${names}" PARENT_SCOPE)
endfunction()

file(READ "${HEADER}" text)
string(REPLACE ";" "\n" text "${text}") # semicolons separate the elements of a list here
string(REGEX MATCHALL "\n${MACRO} [^\n]*" lines "${text}")
set(table "")
set(connections "")
set(functions "")
foreach(line IN LISTS lines)
    if(NOT line MATCHES "^\n${MACRO} (.+[ *])([A-Z_]+) ([A-Za-z_0-9]+) *\\(([^()]+)\\)$")
        message(FATAL_ERROR "${HEADER}: not a prototype on one line:${line}")
    endif()
    string(STRIP "${CMAKE_MATCH_1}" result)
    set(function ${CMAKE_MATCH_3})
    set(parameters "${CMAKE_MATCH_4}")
    parameter_names("${parameters}" names)
    string(APPEND table "    decltype(&::${function}) ${function} = nothing;\n")
    string(APPEND connections "    connector(library.${function}, \"${function}\");\n")
    string(APPEND functions
           "${result} ${function}(${parameters}) { return mfar::library.${function}(${names}); }\n")
endforeach()
if(functions STREQUAL "")
    message(FATAL_ERROR "${HEADER}: no prototypes that begin with ${MACRO}")
endif()

if(NOT VISIBILITY)
    set(VISIBILITY hidden) # so that libraries loaded later do not use these functions
endif()
file(WRITE "${OUT}" "// Made by forwarders.cmake. NOLINTBEGIN
#define ${MACRO} __attribute__((visibility(\"${VISIBILITY}\")))
#include <${INCLUDE}>

#include \"hal/device/gl_libraries.h\"

namespace mfar {
namespace {

using gl_libraries::nothing;

struct {
${table}} library;

}  // namespace

std::string gl_libraries::connect${NAME}(const FindFunction& find) {
    Connector connector{find, {}};
${connections}    return connector.missing;
}

}  // namespace mfar

extern \"C\" {
${functions}}
// NOLINTEND
")
