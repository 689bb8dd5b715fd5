#pragma once

#include <string>
#include <vector>

namespace mfar {

/// State shared by the tests and the library in fake_gl.cpp, which exports fakeGl().
struct FakeGl {
    std::string unknown{};        ///< name for which eglGetProcAddress() returns null
    int others = 0;               ///< calls of functions that are not exported
    float depth = 0;              ///< argument of glClearDepthf()
    std::vector<int> integers{};  ///< arguments of glTexSubImage3D(), in order
    const void* pixels = nullptr;
};

}  // namespace mfar
