#pragma once

#include <functional>
#include <string>
#include <type_traits>

namespace mfar {

struct GlLibraryNames {
    std::string egl = "libEGL.so.1";
    std::string gles = "libGLESv2.so.2";
};

/// Loads the EGL and GLES libraries at run time, so that programs also start on machines without
/// them. The program itself defines the functions of <EGL/egl.h> and <GLES3/gl31.h>. Before this
/// call, they do nothing and return zero; after it, they jump to the library's functions. No other
/// thread may call them during this call. Throws std::runtime_error with the missing library and
/// the package to install.
void loadGlLibraries(const GlLibraryNames& names = {});

namespace gl_libraries {

using Function = void (*)();
using FindFunction = std::function<Function(const char* name)>;

/// Makes the functions of one header jump to the functions that `find` returns. Returns the name of
/// the first function that `find` did not find, or an empty text. forwarders.cmake generates the
/// code.
std::string connectEgl(const FindFunction& find);
std::string connectGles(const FindFunction& find);

/// Until the libraries are loaded, every EGL and GLES function jumps here.
template <class Result, class... Arguments>
Result nothing(Arguments... /*unused*/) {
    if constexpr (!std::is_void_v<Result>) return Result{};
}

struct Connector {
    const FindFunction& find;
    std::string missing;

    template <class Result, class... Arguments>
    void operator()(Result (*&entry)(Arguments...), const char* name) {
        if (const Function found = find(name))
            entry = reinterpret_cast<Result (*)(Arguments...)>(found);
        else if (missing.empty())
            missing = name;
    }
};

}  // namespace gl_libraries
}  // namespace mfar
