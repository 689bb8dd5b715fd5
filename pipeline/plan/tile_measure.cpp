#include "pipeline/plan/tile_measure.h"

#include "pipeline/plan/tiles.h"
#include "pipeline/simd/tile_rows.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace mfar {
namespace {

/// Gives the pixels of a row of tiles in both pictures. Tiles at the right and lower border can
/// extend beyond the picture. There, the border pixels would be repeated, and a repeated difference
/// would look like a change. So the pixels outside are made equal in both pictures.
class TileRow {
public:
    TileRow(const RgbPlanes& now, const RgbPlanes& drawn, int row)
        : now_(now), drawn_(drawn), top_(kTileSize * row) {}

    [[nodiscard]] simd::TilePixels whole(int column, int tiles) const {
        simd::TilePixels out{};
        out.tiles = tiles;
        for (int channel = 0; channel < 3; ++channel)
            for (int y = 0; y < kTileSize; ++y) {
                const auto c = static_cast<std::size_t>(channel), i = static_cast<std::size_t>(y);
                out.now[c][i] = now_.row(channel, top_ + y) + kTileSize * column;
                out.drawn[c][i] = top_ + y < now_.size().height
                                      ? drawn_.row(channel, top_ + y) + kTileSize * column
                                      : out.now[c][i];
            }
        return out;
    }

    /// Returns the last tile of the row, which is partly outside the picture. The result points
    /// into this object.
    [[nodiscard]] simd::TilePixels cut(int column) {
        simd::TilePixels out = whole(column, 1);
        const auto inside = static_cast<std::size_t>(now_.size().width - kTileSize * column);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t y = 0; y < kTileSize; ++y) {
                std::uint8_t* to = drawnOfCut_[c][y].data();
                std::memcpy(to, out.drawn[c][y], inside);
                std::memcpy(to + inside, out.now[c][y] + inside, kTileSize - inside);
                out.drawn[c][y] = to;
            }
        return out;
    }

private:
    using TileBytes = std::array<std::array<std::uint8_t, kTileSize>, kTileSize>;

    const RgbPlanes &now_, &drawn_;
    int top_;
    std::array<TileBytes, 3> drawnOfCut_{};
};

}  // namespace

void measureTiles(const RgbPlanes& now, const RgbPlanes& drawn, const ChangeBounds& bounds,
                  Workers* workers, std::vector<TileMeasure>& out) {
    const Size tiles = now.tiles();
    out.resize(static_cast<std::size_t>(tiles.width) * tiles.height);
    const int wholeTiles = now.size().width / kTileSize;
    const auto measureRows = [&](int begin, int end) {
        for (int row = begin; row < end; ++row) {
            TileRow pixels(now, drawn, row);
            TileMeasure* to = &out[static_cast<std::size_t>(row) * tiles.width];
            for (int column = 0; column < wholeTiles; column += simd::kTileGroup) {
                const int count = std::min(simd::kTileGroup, wholeTiles - column);
                simd::measureTileGroup(pixels.whole(column, count), bounds, to + column);
            }
            if (wholeTiles < tiles.width)
                simd::measureTileGroup(pixels.cut(wholeTiles), bounds, to + wholeTiles);
        }
    };
    forRange(workers, tiles.height, 4, measureRows);
}

}  // namespace mfar
