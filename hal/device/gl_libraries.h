#pragma once

#include <functional>
#include <string>
#include <type_traits>

namespace mfar {

/// As the dynamic linker knows them.
struct GlLibraryNames {
    std::string egl = "libEGL.so.1";
    std::string gles = "libGLESv2.so.2";
};

/// The functions of <EGL/egl.h> and <GLES3/gl31.h> are the program's own, each a jump to the
/// library's, which is loaded here and never unloaded: a machine without these libraries starts the
/// programs, too. Before, the functions do nothing and return zero, as libglvnd's without a
/// context. Must not run while another thread calls one of the functions.
/// Throws std::runtime_error that says what is missing and what to install.
void loadGlLibraries(const GlLibraryNames& names = {});

namespace gl_libraries {

using Function = void (*)();
/// Where a function is; null where there is none of this name.
using FindFunction = std::function<Function(const char* name)>;

/// Make the functions of one header jump to those found; the others stay as they are. Return the
/// name of the first that is not found, empty when all are there. Made by forwarders.cmake.
std::string connectEgl(const FindFunction& find);
std::string connectGles(const FindFunction& find);

/// What every function does at first.
template <class Result, class... Arguments>
Result nothing(Arguments... /*unused*/) {
    if constexpr (!std::is_void_v<Result>) return Result{};
}

struct Connector {
    const FindFunction& find;
    std::string missing;  ///< the first

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
