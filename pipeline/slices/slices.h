#pragma once

#include "base/geometry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Order in which the samples of a picture are taken.
enum class Slicing {
    Time,     ///< a few samples of every pixel per turn: complete soon, then less noisy with every
              ///< turn
    Spatial,  ///< tile after tile with all its samples: complete only at the end
};

struct SliceOptions {
    Slicing slicing = Slicing::Time;
    int samples = 64;        ///< per pixel, at most
    int samplesPerTurn = 2;  ///< per pixel in one portion, in both orders
    /// Standard error [grey levels] below which a pixel gets no more samples, if its neighbours in
    /// the tile are below it as well: the estimate of a single pixel may be low by chance. 0: every
    /// pixel gets all samples.
    float threshold = 1;
    int leastSamples = 16;  ///< before an estimated error is trusted
    bool operator==(const SliceOptions&) const = default;
};

/// A portion of work: `samples` more for each pixel; 0: only a ray through its centre. The span is
/// valid until done().
struct Slice {
    std::span<const std::uint32_t> pixels;  ///< row-major indices
    int samples = 0;
    std::uint32_t tile = 0;  ///< index of its tile in Morton order
};

/// State of a pixel.
struct PixelState {
    float error = 0;         ///< standard error [grey levels], infinity if unknown
    float samples = 0;       ///< that the error was estimated from
    bool untouched = false;  ///< nothing was seen in it so far
};
using PixelStates = std::function<PixelState(std::uint32_t)>;

/// Cuts the rendering of a picture into portions for several threads. Tiles are 8x8 pixels in
/// Morton order (G. M. Morton, "A computer oriented geodetic data base", 1966), and so are the
/// pixels in them: rays that are traced together meet the same objects. The number of samples of a
/// pixel depends only on the errors in its tile, so it is the same in both orders and for any
/// distribution of the work.
///
/// Slicing::Time begins with a ray through every pixel's centre, after which pixels with a small
/// error are left out. The first samples come in three turns: one pixel in 16, one in 4, and all,
/// spread evenly. Tiles that are untouched after the first of these turns are left out of the last.
///
/// One caller at a time; only begin() allocates.
class Slices {
public:
    /// Throws std::invalid_argument for numbers out of range.
    explicit Slices(const SliceOptions& options);

    /// Density of the samples in a tile.
    enum class Density : unsigned char {
        None,
        Quarter,  ///< pixels of even column and row
        Full,
    };
    /// Begins a picture. `densityOf` returns the density of each tile in `bounds`; without it,
    /// Full. All portions handed out before must be done.
    void begin(const PixelRect& bounds, Size picture,
               const std::function<Density(const PixelRect& tile)>& densityOf = {});

    /// The next portion, at most about `mostSamples` (pixels times samples, at least one pixel). No
    /// pixels: all is done, or the rest waits for outstanding portions.
    [[nodiscard]] Slice next(std::int64_t mostSamples);

    /// Reports that the portion was traced.
    void done(const Slice& slice, const PixelStates& states);

    /// Whether no portion is outstanding and every pixel has samples() samples, or needs no more.
    /// The picture may be shown then. Also true before the first turn.
    [[nodiscard]] bool turnComplete() const;
    /// Samples that every pixel had, or did not need, after the last complete turn. Spatial slices
    /// have one turn.
    [[nodiscard]] int samples() const { return samples_; }
    /// Complete turns. Slicing::Time: turn 1 is the ray through the centres, 2 to 4 take the first
    /// samples.
    [[nodiscard]] int turns() const { return turnComplete() ? turn_ : std::max(turn_ - 1, 0); }
    [[nodiscard]] bool finished() const { return unfinished_ == 0; }

    [[nodiscard]] std::size_t pixels() const { return pixels_.size(); }
    /// Pixels times samples done, since begin().
    [[nodiscard]] std::uint64_t traced() const { return traced_; }
    /// Share of the samples that may have to be traced, [0, 1]; 1 when finished.
    [[nodiscard]] double progress() const;

private:
    struct Tile {
        std::uint32_t first = 0, count = 0;  ///< in pixels_
        std::uint32_t active = 0;            ///< number of pixels, moved to the front, that get
                                             ///< more samples
        std::uint32_t handed = 0;            ///< number of active pixels handed out for their next
                                             ///< samples
        std::uint32_t most = 0;              ///< upper limit of `handed` in this turn
        std::uint32_t out = 0;               ///< portions that are outstanding
        int samples = 0;                     ///< of each active pixel
    };

    void addTile(const PixelRect& tile, Density density);
    void beginTurn();
    [[nodiscard]] int samplesOfTurn() const;
    [[nodiscard]] std::uint32_t mostOfTurn(const Tile& tile) const;
    [[nodiscard]] bool looks() const;
    [[nodiscard]] int step(const Tile& tile) const;
    Slice part(std::uint32_t tile, std::int64_t mostSamples);
    Slice nextOfTurn(std::int64_t mostSamples);
    Slice nextOfTiles(std::int64_t mostSamples);
    void endRound(Tile& tile, const PixelStates& states);
    void dropActive(Tile& tile, std::uint32_t kept);
    [[nodiscard]] bool isUntouched(const Tile& tile, const PixelStates& states) const;
    [[nodiscard]] std::uint32_t keepNoisy(Tile& tile, const PixelStates& states);

    const SliceOptions options_;
    std::vector<std::uint32_t> pixels_;
    std::vector<Tile> tiles_;
    std::vector<std::uint32_t> open_;   ///< spatial: tiles that are begun and not finished
    std::vector<std::uint64_t> order_;  ///< Morton code and place of the tiles
    int width_ = 1;
    std::uint32_t cursor_ = 0;  ///< the first tile that was not handed out in this turn
    int samples_ = 0, turn_ = 0;
    std::size_t unfinished_ = 0, ofTurn_ = 0;  ///< tiles; tiles whose turn is not over
    std::uint64_t traced_ = 0, settled_ = 0;   ///< settled: samples that pixels do not need
};

}  // namespace mfar
