#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/flow.h"
#include "pipeline/gles/tile_buffer.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// On the GPU, finds the tiles whose flow along epipolar lines does not fit the pictures. For each
/// pyramid level, lists the groups of 4x4 cells that the 2-D search must process.
class TileLists {
public:
    /// `vectors`: index in `cells` of the first flow vector. `errors`: index of the first two-way
    /// error.
    struct Field {
        const gpu::Buffer& cells;
        int vectors, errors;
    };

    /// `cells` is the number of columns and rows at the finest pyramid level.
    TileLists(Size cells, int levels);

    /// Replaces all lists. They are empty if no tile is matched. `tiles` gives the noise.
    void find(const Field& field, const TileBuffer& tiles);
    void clear();

    /// Positions of groups of 4x4 cells, packed by tiles.glsl. The list of a pyramid level begins
    /// at index first(level).
    [[nodiscard]] const gpu::Buffer& lists() const { return lists_; }
    [[nodiscard]] int first(int level) const { return levels_[level].first; }
    /// Commands of the indirect dispatches: 16 bytes for each pyramid level, finest level first.
    [[nodiscard]] const gpu::Buffer& commands() const { return commands_; }

    /// Length of the list of tiles that the last find() or clear() replaced. Does not wait for the
    /// GPU.
    [[nodiscard]] int countBefore() const { return countBefore_; }
    /// Number of listed tiles. Waits for the GPU.
    [[nodiscard]] int count() const;
    /// Returns a flag for each tile, row-major: true if the tile is listed. Waits for the GPU.
    [[nodiscard]] std::vector<bool> read() const;

private:
    struct Level {
        Size groups;
        int first;
    };

    Size cells_, tiles_;
    std::vector<Level> levels_;
    int countBefore_ = 0;
    gpu::Buffer flags_, commands_, lists_;
    gpu::ComputePass<params::FlagTiles> flag_;
    gpu::ComputePass<params::ListTiles> list_;
};

}  // namespace mfar
