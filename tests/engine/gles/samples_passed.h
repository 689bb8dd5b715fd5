#pragma once

#include "base/gl/gl.h"

namespace mfar {

template <class F>
bool drewAnything(F&& work) {
    GLuint query = 0;
    glGenQueries(1, &query);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, query);
    work();
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    GLuint any = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &any);
    glDeleteQueries(1, &query);
    return any != 0;
}

}  // namespace mfar
