#include "tests/measure/bench/gpu_timer.h"

#include <string_view>

namespace mfar::gpu {
namespace {

// Constants of EXT_disjoint_timer_query, which the core header lacks. ARB_timer_query gives
// kTimeElapsed the same value and lacks kGpuDisjoint.
constexpr GLenum kTimeElapsed = 0x88BF;
constexpr GLenum kGpuDisjoint = 0x8FBB;

bool hasExtension(std::string_view wanted) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const GLubyte* name = glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (name != nullptr && reinterpret_cast<const char*>(name) == wanted) return true;
    }
    return false;
}

}  // namespace

Timer::Timer() : disjointKnown_(hasExtension("GL_EXT_disjoint_timer_query")) {
    if (disjointKnown_ || hasExtension("GL_ARB_timer_query")) glGenQueries(1, &query_);
    checkErrors("Timer");
}

Timer::~Timer() {
    if (query_ != 0) glDeleteQueries(1, &query_);
}

void Timer::start() {
    if (query_ == 0) return;
    GLint changed = 0;
    if (disjointKnown_) glGetIntegerv(kGpuDisjoint, &changed);  // reading this flag resets it
    glBeginQuery(kTimeElapsed, query_);
}

void Timer::stop() {
    if (query_ != 0) glEndQuery(kTimeElapsed);
}

std::optional<double> Timer::read() const {
    if (query_ == 0) return std::nullopt;
    GLuint done = GL_FALSE;
    glGetQueryObjectuiv(query_, GL_QUERY_RESULT_AVAILABLE, &done);
    if (done == GL_FALSE) return std::nullopt;
    GLint changed = 0;
    if (disjointKnown_) glGetIntegerv(kGpuDisjoint, &changed);
    if (changed != 0) return std::nullopt;
    GLuint nanoseconds = 0;
    glGetQueryObjectuiv(query_, GL_QUERY_RESULT, &nanoseconds);
    return nanoseconds * 1e-6;
}

}  // namespace mfar::gpu
