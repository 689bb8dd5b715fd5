// A libGLESv2.so.2 to be found before the real one (LD_LIBRARY_PATH), whose functions it uses by
// libEGL. The words of the file MFAR_FAULTY_GL say what is wrong, from now on:
//   never   no fence is signalled, and what waits for the GPU does not return
//   lost    the context is lost
//   hang    drawing does not return

#include <EGL/egl.h>
#include <GLES3/gl31.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <dlfcn.h>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <thread>

namespace {

constexpr GLenum kContextLost = 0x0507;

bool is(std::string_view fault) {
    const char* file = std::getenv("MFAR_FAULTY_GL");
    std::ifstream in(file != nullptr ? file : "");
    return std::find(std::istream_iterator<std::string>(in), {}, fault) !=
           std::istream_iterator<std::string>();
}

template <class Function>
Function real(const char* name) {
    static void* const egl = dlopen("libEGL.so.1", RTLD_NOW);
    static const auto find =
        reinterpret_cast<decltype(&eglGetProcAddress)>(dlsym(egl, "eglGetProcAddress"));
    return reinterpret_cast<Function>(find(name));
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) GLsync glFenceSync(GLenum condition, GLbitfield flags) {
    static const auto call = real<decltype(&glFenceSync)>("glFenceSync");
    return is("lost") ? nullptr : call(condition, flags);
}

__attribute__((visibility("default"))) GLenum glClientWaitSync(GLsync sync, GLbitfield flags,
                                                               GLuint64 timeout) {
    static const auto call = real<decltype(&glClientWaitSync)>("glClientWaitSync");
    if (is("lost")) return GL_WAIT_FAILED;
    const auto end = std::chrono::steady_clock::now() + std::chrono::nanoseconds(timeout);
    while (is("never")) {
        const auto left = end - std::chrono::steady_clock::now();
        if (left <= std::chrono::nanoseconds(0)) return GL_TIMEOUT_EXPIRED;
        std::this_thread::sleep_for(
            std::min<std::chrono::nanoseconds>(left, std::chrono::milliseconds(5)));
    }
    return call(sync, flags, timeout);
}

__attribute__((visibility("default"))) void glDrawArrays(GLenum mode, GLint first, GLsizei count) {
    static const auto call = real<decltype(&glDrawArrays)>("glDrawArrays");
    while (is("hang"))
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    call(mode, first, count);
}

// Of a renderer that is no software.
__attribute__((visibility("default"))) const GLubyte* glGetString(GLenum name) {
    static const auto call = real<decltype(&glGetString)>("glGetString");
    constexpr const char* kRenderer = "pretended GPU";
    return name == GL_RENDERER ? reinterpret_cast<const GLubyte*>(kRenderer) : call(name);
}

__attribute__((visibility("default"))) void glFinish() {
    static const auto call = real<decltype(&glFinish)>("glFinish");
    while (is("never"))
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    call();
}

__attribute__((visibility("default"))) GLenum glGetError() {
    static const auto call = real<decltype(&glGetError)>("glGetError");
    return is("lost") ? kContextLost : call();
}
}
