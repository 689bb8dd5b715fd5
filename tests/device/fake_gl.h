#pragma once

#include <string>
#include <vector>

namespace mfar {

/// What the tests and the library in fake_gl.cpp, which exports fakeGl(), know of each other.
struct FakeGl {
    std::string unknown{};        ///< function that eglGetProcAddress() does not find
    int others = 0;               ///< calls of functions that are not exported
    float depth = 0;              ///< of glClearDepthf()
    std::vector<int> integers{};  ///< of glTexSubImage3D(), in order
    const void* pixels = nullptr;
};

}  // namespace mfar
