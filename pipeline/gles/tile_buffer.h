#pragma once

#include "base/gl/buffer.h"
#include "pipeline/plan/tile_work.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar {

/// The plan of a frame on the GPU. Needs a current context for its whole lifetime.
class TileBuffer {
public:
    /// Every tile is changed and matched until the first set().
    explicit TileBuffer(Size video);

    /// Uploads the plan if it differs from the last one.
    void set(const TileWork& work);
    [[nodiscard]] bool holds(const TileWork& work) const;

    [[nodiscard]] const TileWork& work() const { return work_; }
    /// uvec2 header: how the frame is drawn (0: only changed tiles; 1: whole; 2: enlarged as a
    /// whole, with detail in a list of tiles), number of changed tiles; then uvec2 per tile,
    /// row-major: changed, matched.
    [[nodiscard]] const gpu::Buffer& buffer() const { return buffer_; }

private:
    using Entries = std::vector<std::array<std::uint32_t, 2>>;

    TileWork work_;
    Entries entries_, uploaded_;
    gpu::Buffer buffer_;
};

}  // namespace mfar
