#include "base/gl/gl.h"

namespace mfar::gpu {

void checkErrors(const char* where) {
    const GLenum error = takeError();
    if (error != GL_NO_ERROR) throw GlError("OpenGL error " + errorCode(error) + " in " + where);
}

}  // namespace mfar::gpu
