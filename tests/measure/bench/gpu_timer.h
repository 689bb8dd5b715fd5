#pragma once

#include "base/gl/gl.h"

#include <optional>

namespace mfar::gpu {

/// Measures the time that the GPU spends on commands between start() and stop(). The GPU measures
/// it and the result is read later, so that nothing waits. Optional: needs EXT_disjoint_timer_query
/// (OpenGL ES) or ARB_timer_query (OpenGL); without them every call is a no-op and read() returns
/// nothing.
class Timer {
public:
    Timer();
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;
    ~Timer();

    [[nodiscard]] bool available() const { return query_ != 0; }
    /// One measurement at a time; only one Timer may measure in a context.
    void start();
    void stop();
    /// Milliseconds of the last measurement; empty while it is unfinished, or if the GPU changed
    /// its clock meanwhile.
    [[nodiscard]] std::optional<double> read() const;

private:
    GLuint query_ = 0;
    bool disjointKnown_ = false;  // the context reports a change of clock (OpenGL ES only)
};

}  // namespace mfar::gpu
