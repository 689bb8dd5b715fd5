#include "base/gl/gl.h"

#include <array>
#include <cstdio>

namespace mfar::gpu {

void checkErrors(const char* where) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return;
    std::array<char, 16> code{};
    std::snprintf(code.data(), code.size(), "0x%04x", error);
    while (glGetError() != GL_NO_ERROR) {
    }
    throw GlError(std::string("OpenGL error ") + code.data() + " in " + where);
}

}  // namespace mfar::gpu
