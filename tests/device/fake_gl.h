#pragma once

#include <string>
#include <vector>

namespace mfar {

/// State that tests share with the library fake_gl.cpp, which exports fakeGl().
struct FakeGl {
    std::string unknown{};  ///< eglGetProcAddress() returns null for this name
    int others = 0;         ///< number of calls of functions that eglGetProcAddress() returned
    float depth = 0;
    std::vector<int> integers{};
    const void* pixels = nullptr;
};

}  // namespace mfar
