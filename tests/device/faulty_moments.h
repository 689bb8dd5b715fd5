#pragma once

// Functions of the library in faulty_gl.cpp, which tests in the same process find with dlsym(). GL
// thread.
extern "C" {

/// Forgets the recorded moments (GL calls that move or compute something) and loses the context at
/// the first moment of this name; null: never.
__attribute__((visibility("default"))) void mfarFaultyGlLoseAt(const char* name);
/// The name of the i-th moment, "glUseProgram flow_search.comp"; the shader is the last used one.
/// Null: fewer moments were recorded.
__attribute__((visibility("default"))) const char* mfarFaultyGlMoment(int i);
}

namespace mfar::faulty {

/// Records a moment. True: the context is lost now.
bool isLostAt(const char* function);

// Tracks which shader a program contains.
void attached(unsigned program, unsigned shader);
void sourceOf(unsigned shader, const char* text);
void used(unsigned program);

}  // namespace mfar::faulty
