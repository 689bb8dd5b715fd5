#pragma once

// What tests in the same process find with dlsym() in the library of faulty_gl.cpp. GL thread.
extern "C" {

/// Forgets the moments so far, calls of GL that move or compute something, and loses the context at
/// the first that has this name; null: at none.
__attribute__((visibility("default"))) void mfarFaultyGlLoseAt(const char* name);
/// The name of the i-th moment, "glUseProgram flow_search.comp"; the shader is the last one that
/// was used. Null: there were fewer.
__attribute__((visibility("default"))) const char* mfarFaultyGlMoment(int i);
}

namespace mfar::faulty {

/// Counts one. True: the context is lost now.
bool isLostAt(const char* function);

// Which shader a program is made of.
void attached(unsigned program, unsigned shader);
void sourceOf(unsigned shader, const char* text);
void used(unsigned program);

}  // namespace mfar::faulty
