#pragma once

#include "base/gl/gl.h"

#include <optional>

namespace mfar::gpu {

/// Measures the GPU's time for the commands between start() and stop(). The result is read later,
/// so the CPU does not wait. Needs EXT_disjoint_timer_query (OpenGL ES) or ARB_timer_query
/// (OpenGL). Without them, calls do nothing and read() returns no value.
class Timer {
public:
    Timer();
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;
    ~Timer();

    [[nodiscard]] bool available() const { return query_ != 0; }
    /// Only one Timer of a context may measure at a time.
    void start();
    void stop();
    /// Time of the last measurement [ms]. Empty as long as the GPU has not finished, and if the GPU
    /// changed its clock during the measurement.
    [[nodiscard]] std::optional<double> read() const;

private:
    GLuint query_ = 0;
    bool disjointKnown_ = false;
};

}  // namespace mfar::gpu
