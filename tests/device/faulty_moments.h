#pragma once

// Functions of the library faulty_gl.cpp. Tests in the same process find them with dlsym() and call
// them on the picture thread.
extern "C" {

/// Forgets the recorded moments. From now on, the context is lost at the first moment of this name;
/// null: at none. A moment is a GL call that selects a program, creates textures, moves data,
/// draws, computes, or creates or awaits a fence.
__attribute__((visibility("default"))) void mfarFaultyGlLoseAt(const char* name);
/// Name of moment i, such as "glUseProgram flow_search.comp": the call and the shader used last.
/// Null if fewer moments were recorded.
__attribute__((visibility("default"))) const char* mfarFaultyGlMoment(int i);
}

namespace mfar::faulty {

bool isLostAt(const char* function);

void attached(unsigned program, unsigned shader);
void sourceOf(unsigned shader, const char* text);
void used(unsigned program);

}  // namespace mfar::faulty
