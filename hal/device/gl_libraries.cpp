#include "hal/device/gl_libraries.h"

#include <EGL/egl.h>

#include <dlfcn.h>
#include <stdexcept>
#include <string_view>

namespace mfar {
namespace {

constexpr const char* kAdvice = "; install libegl1 and libgles2, or use the SIMD engine";

using gl_libraries::Function;

// A library is never closed, because drivers leave threads and thread-local data behind.
void* opened(const std::string& name) {
    void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) return library;
    const char* error = dlerror();
    std::string_view why = error != nullptr ? error : "unknown error";
    if (why.starts_with(name + ": ")) why.remove_prefix(name.size() + 2);
    throw std::runtime_error(name + " cannot be loaded: " + std::string(why) + kAdvice);
}

Function findIn(void* library, const char* name) {
    return reinterpret_cast<Function>(dlsym(library, name));
}

}  // namespace

void loadGlLibraries(const GlLibraryNames& names) {
    void* egl = opened(names.egl);
    void* gles = opened(names.gles);
    // Only eglGetProcAddress must exist. Old versions of EGL lack some of the other functions, but
    // those are never called.
    gl_libraries::connectEgl([egl](const char* name) { return findIn(egl, name); });
    if (findIn(egl, "eglGetProcAddress") == nullptr)
        throw std::runtime_error(names.egl + " has no eglGetProcAddress" + kAdvice);
    // Functions are looked up in two ways, because neither finds all of them. Before EGL 1.5,
    // eglGetProcAddress need not find GLES functions. The GLES libraries of some vendors export
    // only the functions of version 2.0.
    const std::string missing = gl_libraries::connectGles([gles](const char* name) {
        const Function function = findIn(gles, name);
        return function != nullptr ? function : eglGetProcAddress(name);
    });
    if (!missing.empty())
        throw std::runtime_error(names.gles + " has no " + missing +
                                 ": it is older than OpenGL ES 3.1" + kAdvice);
}

}  // namespace mfar
