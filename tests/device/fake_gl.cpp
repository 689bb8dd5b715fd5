// Replaces libEGL and libGLESv2. It exports few functions, like old libraries of some vendors.
// Callers find the others through eglGetProcAddress().
#include "tests/device/fake_gl.h"

#include <EGL/egl.h>
#include <GLES3/gl31.h>

#include <string>

namespace {

mfar::FakeGl state;

void other() {
    ++state.others;
}

}  // namespace

extern "C" {
__attribute__((visibility("default"))) mfar::FakeGl* fakeGl() {
    return &state;
}

__eglMustCastToProperFunctionPointerType eglGetProcAddress(const char* name) {
    return state.unknown == name ? nullptr : other;
}

void glClearDepthf(GLfloat depth) {
    state.depth = depth;
}

GLuint glCreateShader(GLenum type) {
    return type + 1;
}

void glTexSubImage3D(GLenum target, GLint level, GLint x, GLint y, GLint z, GLsizei width,
                     GLsizei height, GLsizei depth, GLenum format, GLenum type,
                     const void* pixels) {
    state.integers = {
        static_cast<int>(target), level, x, y, z, width, height, depth, static_cast<int>(format),
        static_cast<int>(type)};
    state.pixels = pixels;
}
}
