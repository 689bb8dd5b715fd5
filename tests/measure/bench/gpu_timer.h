#pragma once

#include "base/gl/gl.h"

#include <optional>

namespace mfar::gpu {

/// Time the GPU spends on what is issued between start() and stop(), measured by the GPU itself and
/// read later, so that nothing waits. Optional: needs EXT_disjoint_timer_query (OpenGL ES) or
/// ARB_timer_query (OpenGL); where neither exists, everything is a no-op and read() gives nothing.
class Timer {
public:
    Timer();
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;
    ~Timer();

    [[nodiscard]] bool available() const { return query_ != 0; }
    /// One measurement at a time, and one Timer at a time in a context.
    void start();
    void stop();
    /// Milliseconds of the last measurement; nothing while it is not finished, and nothing when the
    /// GPU changed its clock meanwhile.
    [[nodiscard]] std::optional<double> read() const;

private:
    GLuint query_ = 0;
    bool disjointKnown_ = false;  // the context can tell a change of clock (OpenGL ES only)
};

}  // namespace mfar::gpu
