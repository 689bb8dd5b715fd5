#pragma once

#include <GLES3/gl31.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace mfar::gpu {

/// Reports that a GL call failed or that a shader did not compile or link.
class GlError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

inline constexpr GLenum kContextLost = 0x0507;

/// Returns the first error that the context has recorded since the last call, or GL_NO_ERROR. The
/// loop also ends at kContextLost, because glGetError() may return it on every call after the
/// context is lost.
[[nodiscard]] inline GLenum takeError() {
    const GLenum first = glGetError();
    for (GLenum next = first; next != GL_NO_ERROR && next != kContextLost;)
        next = glGetError();
    return first;
}
[[nodiscard]] inline std::string errorCode(GLenum error) {
    std::array<char, 16> code{};
    std::snprintf(code.data(), code.size(), "0x%04x", error);
    return code.data();
}

/// Throws GlError if the context has recorded an error. The message contains `where`. Too slow to
/// be called in every frame.
void checkErrors(const char* where);

}  // namespace mfar::gpu
