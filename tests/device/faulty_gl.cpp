// A libGLESv2.so.2 that is found before the real one, through LD_LIBRARY_PATH. It calls the real
// functions, which it finds through libEGL. The environment variable MFAR_FAULTY_GL names a file,
// whose words select the faults. The words may change at any time:
//   never      no fence is signalled: glClientWaitSync() times out, glFinish() does not return
//   hang       drawing does not return
//   lost WORD  each new WORD loses the current context once: its calls do nothing and return zero;
//              the next context works
//   broken     every context is lost at its first use
// A test in the same process may also make it lose contexts, see faulty_moments.h.

#include "hal/device/gl_libraries.h"
#include "tests/device/faulty_moments.h"

#include <EGL/egl.h>
#include <GLES3/gl31.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <dlfcn.h>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace {

using mfar::gl_libraries::Function;

constexpr GLenum kContextLost = 0x0507;

std::string words() {
    const char* file = std::getenv("MFAR_FAULTY_GL");
    std::ifstream in(file != nullptr ? file : "");
    std::string line;
    std::getline(in, line);
    return line;
}

bool is(std::string_view fault) {
    std::istringstream in(words());
    using Words = std::istream_iterator<std::string>;
    return std::find(Words(in), Words(), fault) != Words();
}

template <class F>
F real(const char* name) {
    static void* const egl = dlopen("libEGL.so.1", RTLD_NOW);
    static const auto find =
        reinterpret_cast<decltype(&eglGetProcAddress)>(dlsym(egl, "eglGetProcAddress"));
    return reinterpret_cast<F>(find(name));
}

std::uintptr_t nothing() {
    return 0;
}

Function workingOr(const char* name);
Function lostOr(const char* name);

/// Name of a buffer that lose() creates. The current context is the lost one if it has this buffer.
/// The address of the lost context would not identify it, because a new context may get the same
/// address.
GLuint mark = 0;

void lose() {
    if (mark != 0) return;
    real<decltype(&glGenBuffers)>("glGenBuffers")(1, &mark);
    GLint before = 0;
    real<decltype(&glGetIntegerv)>("glGetIntegerv")(GL_COPY_READ_BUFFER_BINDING, &before);
    const auto bind = real<decltype(&glBindBuffer)>("glBindBuffer");
    bind(GL_COPY_READ_BUFFER, mark);
    bind(GL_COPY_READ_BUFFER, static_cast<GLuint>(before));
    mfar::gl_libraries::connectGles(lostOr);
}

bool isLost() {
    if (mark == 0) return false;
    if (real<decltype(&glIsBuffer)>("glIsBuffer")(mark) == GL_TRUE) return true;
    mark = 0;
    mfar::gl_libraries::connectGles(workingOr);
    return false;
}

bool loseNow(const char* function) {
    static std::string last;
    const std::string now = words();
    const bool isNew = now != last && is("lost");
    last = now;
    if (mfar::faulty::isLostAt(function) || isNew || now == "broken") lose();
    return mark != 0;
}

template <class F, class... Arguments>
auto moment(const char* function, Arguments... arguments) {
    using Result = decltype(std::declval<F*>()(arguments...));
    if (loseNow(function)) return Result();
    return real<F*>(function)(arguments...);
}

void useProgram(GLuint program) {
    mfar::faulty::used(program);
    return moment<decltype(glUseProgram)>("glUseProgram", program);
}

void bufferSubData(GLenum target, GLintptr offset, GLsizeiptr size, const void* data) {
    return moment<decltype(glBufferSubData)>("glBufferSubData", target, offset, size, data);
}

void texSubImage2D(GLenum target, GLint level, GLint x, GLint y, GLsizei width, GLsizei height,
                   GLenum format, GLenum type, const void* pixels) {
    return moment<decltype(glTexSubImage2D)>("glTexSubImage2D", target, level, x, y, width, height,
                                             format, type, pixels);
}

void* mapBufferRange(GLenum target, GLintptr offset, GLsizeiptr length, GLbitfield access) {
    return moment<decltype(glMapBufferRange)>("glMapBufferRange", target, offset, length, access);
}

void readPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
                void* pixels) {
    return moment<decltype(glReadPixels)>("glReadPixels", x, y, width, height, format, type,
                                          pixels);
}

void dispatchCompute(GLuint x, GLuint y, GLuint z) {
    return moment<decltype(glDispatchCompute)>("glDispatchCompute", x, y, z);
}

void genTextures(GLsizei count, GLuint* names) {
    return moment<decltype(glGenTextures)>("glGenTextures", count, names);
}

GLsync fenceSync(GLenum condition, GLbitfield flags) {
    return moment<decltype(glFenceSync)>("glFenceSync", condition, flags);
}

GLenum clientWaitSync(GLsync sync, GLbitfield flags, GLuint64 timeout) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::nanoseconds(timeout);
    while (is("never")) {
        const auto left = end - std::chrono::steady_clock::now();
        if (left <= std::chrono::nanoseconds(0)) return GL_TIMEOUT_EXPIRED;
        std::this_thread::sleep_for(
            std::min<std::chrono::nanoseconds>(left, std::chrono::milliseconds(5)));
    }
    return moment<decltype(glClientWaitSync)>("glClientWaitSync", sync, flags, timeout);
}

void drawArrays(GLenum mode, GLint first, GLsizei count) {
    while (is("hang"))
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return moment<decltype(glDrawArrays)>("glDrawArrays", mode, first, count);
}

void finish() {
    while (is("never"))
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    real<decltype(&glFinish)>("glFinish")();
}

GLenum getError() {
    return isLost() ? kContextLost : real<decltype(&glGetError)>("glGetError")();
}

// Reports the name of a hardware GPU. Programs call this function first on a new context. The call
// of isLost() below recognises the new context and connects the working functions again.
const GLubyte* getString(GLenum name) {
    if (isLost()) return nullptr;
    constexpr const char* kRenderer = "pretended GPU";
    return name == GL_RENDERER ? reinterpret_cast<const GLubyte*>(kRenderer)
                               : real<decltype(&glGetString)>("glGetString")(name);
}

void shaderSource(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
    mfar::faulty::sourceOf(shader, texts[count - 1]);
    real<decltype(&glShaderSource)>("glShaderSource")(shader, count, texts, lengths);
}

void attachShader(GLuint program, GLuint shader) {
    mfar::faulty::attached(program, shader);
    real<decltype(&glAttachShader)>("glAttachShader")(program, shader);
}

template <class F>
Function erased(F* function) {
    return reinterpret_cast<Function>(function);
}

Function workingOr(const char* name) {
    static const std::map<std::string_view, Function> ours{
        {"glUseProgram", erased(&useProgram)},
        {"glBufferSubData", erased(&bufferSubData)},
        {"glTexSubImage2D", erased(&texSubImage2D)},
        {"glMapBufferRange", erased(&mapBufferRange)},
        {"glReadPixels", erased(&readPixels)},
        {"glDispatchCompute", erased(&dispatchCompute)},
        {"glGenTextures", erased(&genTextures)},
        {"glFenceSync", erased(&fenceSync)},
        {"glClientWaitSync", erased(&clientWaitSync)},
        {"glDrawArrays", erased(&drawArrays)},
        {"glFinish", erased(&finish)},
        {"glGetError", erased(&getError)},
        {"glGetString", erased(&getString)},
        {"glShaderSource", erased(&shaderSource)},
        {"glAttachShader", erased(&attachShader)}};
    const auto found = ours.find(name);
    return found != ours.end() ? found->second : real<Function>(name);
}

Function lostOr(const char* name) {
    const std::string_view wanted = name;
    if (wanted == "glGetError") return erased(&getError);
    if (wanted == "glGetString") return erased(&getString);
    return erased(&nothing);
}

const bool kIsConnected = mfar::gl_libraries::connectGles(workingOr).empty();

}  // namespace
