#pragma once

#include "pipeline/gles/luma_pyramids.h"
#include "pipeline/gles/tile_buffer.h"
#include "tests/engine/pictures.h"
#include "tests/oracle/luma.h"

#include <gtest/gtest.h>

namespace mfar {

/// Reads all pixels of one pyramid level. Checks that the level's margin repeats the border.
inline twin::Grey readLevel(const LumaPyramids& pyramids, const LumaLevel& level) {
    const auto words = pyramids.words().read<std::uint32_t>(
        static_cast<std::size_t>(level.pitch) * level.height, 4UL * level.offset);
    const auto stored = [&](int x, int y) {  // the stored columns begin at x = -8
        const std::uint32_t word = words[static_cast<std::size_t>(y) * level.pitch + (x + 8) / 4];
        return static_cast<double>((word >> (8 * (x & 3))) & 255U);
    };
    const twin::Grey out = twin::greyOf({level.width, level.height}, stored);
    for (int y = 0; y < level.height; ++y)
        for (int x = -8; x < 4 * level.pitch - 8; ++x)
            if (stored(x, y) != out.at(x, y)) {
                ADD_FAILURE() << "the margin does not repeat the border at " << x << ", " << y;
                return out;
            }
    return out;
}

struct LevelPair {
    LevelPair(const TestPicture& a, const TestPicture& b) : tiles(a.size), pyramids(a.size) {
        pyramids.buildVideo(uploaded(a));
        pyramids.buildSecond(uploaded(b));
    }
    [[nodiscard]] twin::Grey first(int level = 0) const {
        return readLevel(pyramids, pyramids.video()[level]);
    }
    [[nodiscard]] twin::Grey second(int level = 0) const {
        return readLevel(pyramids, pyramids.still()[level]);
    }

    TileBuffer tiles;
    LumaPyramids pyramids;
};

}  // namespace mfar
