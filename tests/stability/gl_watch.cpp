#include "tests/stability/gl_watch.h"

#include "base/gl/gl.h"
#include "tests/stability/watched_shaders.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace mfar::stress {

GlWatch::GlWatch() : context_(createGlContext()) {
    const std::vector<std::uint32_t> zeros(kMostWatched);
    glGenBuffers(1, &outOfRange_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kWatchBinding, outOfRange_);
    glBufferData(GL_SHADER_STORAGE_BUFFER, 4L * kMostWatched, zeros.data(), GL_DYNAMIC_COPY);
    gpu::checkErrors("GlWatch");
}

GlWatch::~GlWatch() {
    glDeleteBuffers(1, &outOfRange_);
}

void GlWatch::frame(Checks& checks, long pixels) {
    for (const auto& fault : validation_.takeFaults())
        checks.fail(describe(fault));
    for (const auto& [pass, count] : validation_.counts()) {
        const Counted before = std::exchange(counted_[pass], {count.runs, count.pixels});
        if (count.runs > before.runs)
            checks.through(pass, std::max(pixels, count.pixels - before.pixels));
    }
    std::vector<std::uint32_t> counts(kMostWatched);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_COPY_READ_BUFFER, outOfRange_);
    const void* data = glMapBufferRange(GL_COPY_READ_BUFFER, 0, 4L * kMostWatched, GL_MAP_READ_BIT);
    std::memcpy(counts.data(), data, 4UL * kMostWatched);
    glUnmapBuffer(GL_COPY_READ_BUFFER);
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] > 0)
            checks.fail(watchedName(i) + ": " + std::to_string(counts[i]) +
                        " indices out of range");
    const std::vector<std::uint32_t> zeros(kMostWatched);
    glBufferSubData(GL_COPY_READ_BUFFER, 0, 4L * kMostWatched, zeros.data());
    glBindBuffer(GL_COPY_READ_BUFFER, 0);
    try {
        gpu::checkErrors("a case");
    } catch (const gpu::GlError& error) {
        checks.fail(error.what());
    }
}

}  // namespace mfar::stress
