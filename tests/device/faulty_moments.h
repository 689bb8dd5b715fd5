#pragma once

#include <cstddef>

// What tests in the same process find with dlsym() in the library of faulty_gl.cpp. GL thread.
extern "C" {

/// Begins to count the moments at which the context may be lost, calls of GL that move or compute
/// something, and loses it at this one; none for a negative number.
__attribute__((visibility("default"))) void mfarFaultyGlLoseAt(int moment);
/// How many there were.
__attribute__((visibility("default"))) int mfarFaultyGlMoments();
/// "glUseProgram flow_search.comp"; the shader is the last one that was used.
__attribute__((visibility("default"))) const char* mfarFaultyGlMoment(int moment);
}

namespace mfar::faulty {

/// Counts one. True: the context is lost now.
bool isLostAt(const char* function);

// Which shader a program is made of.
void attached(unsigned program, unsigned shader);
void sourceOf(unsigned shader, const char* text);
void used(unsigned program);

}  // namespace mfar::faulty
