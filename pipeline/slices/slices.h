#pragma once

#include "base/geometry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// In which order the samples of a picture are taken.
enum class Slicing {
    Time,  ///< a few samples of every pixel, turn after turn: soon complete, then ever less noisy
    Spatial,  ///< tile after tile with all its samples: complete only at the end
};

struct SliceOptions {
    Slicing slicing = Slicing::Time;
    int samples = 64;        ///< of a pixel, at most
    int samplesPerTurn = 2;  ///< of a pixel in one go, for both ways
    /// Standard error [grey levels] below which a pixel gets no more samples, if its neighbours in
    /// the tile are below it as well: one pixel alone may be calm by luck. 0: all get all.
    float threshold = 1;
    int leastSamples = 16;  ///< before an estimated error is believed
    bool operator==(const SliceOptions&) const = default;
};

/// A portion of work: `samples` more of each pixel; 0: a look through its centre. Borrowed: valid
/// until it is done.
struct Slice {
    std::span<const std::uint32_t> pixels;  ///< row-major indices
    int samples = 0;
    std::uint32_t tile = 0;  ///< which of the tiles in Morton order it is of
};

/// What is known of a pixel.
struct PixelState {
    float error = 0;         ///< standard error [grey levels], infinity where none is known
    float samples = 0;       ///< that the error is known by
    bool untouched = false;  ///< it shows nothing, as far as is known
};
using PixelStates = std::function<PixelState(std::uint32_t)>;

/// Cuts the rendering of a picture into portions, for several threads. Tiles are 8x8 pixels in
/// Morton order (G. M. Morton, "A computer oriented geodetic data base", 1966), and so are the
/// pixels in them: rays that are traced together meet the same things. A pixel's number of samples
/// depends on the errors in its tile alone, so it is the same for both ways of slicing and whoever
/// did the work.
///
/// Slices of time begin with a look through every pixel's centre, after which pixels that are known
/// well enough are left out. The first samples come in three turns, of one pixel in 16, one in 4
/// and all, spread evenly; tiles that the first of them show to be untouched are left out of the
/// last.
///
/// One caller at a time; no allocation but in begin().
class Slices {
public:
    /// Throws std::invalid_argument for numbers out of range.
    explicit Slices(const SliceOptions& options);

    /// How much of a tile is traced.
    enum class Density : unsigned char {
        None,
        Quarter,  ///< pixels of even column and row
        Full,
    };
    /// A new picture; `densityOf` tells of each tile in `bounds`, Full without it. What was handed
    /// out before must be done.
    void begin(const PixelRect& bounds, Size picture,
               const std::function<Density(const PixelRect& tile)>& densityOf = {});

    /// The next portion, at most about `mostSamples` (pixels times samples, at least one pixel). No
    /// pixels: everything is done or what is left waits for portions that are not.
    [[nodiscard]] Slice next(std::int64_t mostSamples);

    /// The portion was traced.
    void done(const Slice& slice, const PixelStates& states);

    /// Whether no portion is out and every pixel has samples(), or needed no more. The picture may
    /// be shown then. True before the first turn as well.
    [[nodiscard]] bool turnComplete() const;
    /// That every pixel has, or needed no more, since the last complete turn. Spatial slices have
    /// one turn.
    [[nodiscard]] int samples() const { return samples_; }
    /// Complete turns; of those of time, 1 is the look, 2 to 4 give the first samples.
    [[nodiscard]] int turns() const { return turnComplete() ? turn_ : std::max(turn_ - 1, 0); }
    [[nodiscard]] bool finished() const { return unfinished_ == 0; }

    [[nodiscard]] std::size_t pixels() const { return pixels_.size(); }
    /// Of pixels and samples done, since begin().
    [[nodiscard]] std::uint64_t traced() const { return traced_; }
    /// Share of the most that may have to be traced, [0, 1]; 1 when finished.
    [[nodiscard]] double progress() const;

private:
    struct Tile {
        std::uint32_t first = 0, count = 0;  ///< in pixels_
        std::uint32_t active = 0;            ///< of them, moved to the front, get more samples
        std::uint32_t handed = 0;            ///< of the active ones, for their next samples
        std::uint32_t most = 0;              ///< that are handed out in this turn
        std::uint32_t out = 0;               ///< portions that are not done
        int samples = 0;                     ///< of the active ones
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
    std::size_t unfinished_ = 0, ofTurn_ = 0;  ///< tiles; those whose turn is not over
    std::uint64_t traced_ = 0, settled_ = 0;   ///< settled: samples that pixels need no more
};

}  // namespace mfar
