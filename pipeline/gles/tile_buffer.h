#pragma once

#include "base/gl/buffer.h"
#include "pipeline/plan/tile_work.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar {

/// The TileWork of a frame, stored on the GPU. This object needs a current GL context for its whole
/// lifetime.
class TileBuffer {
public:
    /// Until the first set(), every tile counts as changed and matched.
    explicit TileBuffer(Size video);

    void set(const TileWork& work);
    [[nodiscard]] bool holds(const TileWork& work) const;

    [[nodiscard]] const TileWork& work() const { return work_; }
    /// A uvec2 header, then one uvec2 per tile, row-major. Header x: 0 if only changed tiles are
    /// drawn, 1 if the whole frame is drawn, 2 if the whole frame is enlarged and detail is drawn
    /// in a list of tiles. Header y: number of changed tiles. Tile x: 1 if it changed. Tile y: 1 if
    /// it is matched.
    [[nodiscard]] const gpu::Buffer& buffer() const { return buffer_; }

private:
    using Entries = std::vector<std::array<std::uint32_t, 2>>;

    TileWork work_;
    Entries entries_, uploaded_;
    gpu::Buffer buffer_;
};

}  // namespace mfar
