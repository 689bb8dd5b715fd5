#pragma once

#include "base/geometry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

enum class Slicing {
    /// A few samples of every pixel per turn. The picture is soon complete; each turn reduces its
    /// noise.
    Time,
    /// All samples of a tile, then of the next tile. The picture is complete only at the end.
    Spatial,
};

struct SliceOptions {
    Slicing slicing = Slicing::Time;
    int samples = 64;
    /// Samples per pixel in one portion, for both values of `slicing`.
    int samplesPerTurn = 2;
    /// A pixel gets no more samples if its standard error [grey levels] and those of its neighbours
    /// in the tile are below this limit. The neighbours count, because the estimate of one pixel
    /// may be low by chance. 0: every pixel gets all samples.
    float threshold = 1;
    int leastSamples = 16;  ///< number of samples from which an estimated error counts as reliable
    bool operator==(const SliceOptions&) const = default;
};

/// A portion of work: `samples` more samples for each pixel. If `samples` is 0, each pixel gets
/// only a ray through its centre. `pixels` is valid until done().
struct Slice {
    std::span<const std::uint32_t> pixels;
    int samples = 0;
    std::uint32_t tile = 0;
};

struct PixelState {
    float error = 0;         ///< standard error [grey levels]; infinite if unknown
    float samples = 0;       ///< number of samples from which `error` was computed
    bool untouched = false;  ///< the pixel has shown no object and no changed light
};
using PixelStates = std::function<PixelState(std::uint32_t)>;

/// Divides the rendering of a picture into portions for several threads.
///
/// Tiles have 8x8 pixels. They are in Morton order (G. M. Morton, "A computer oriented geodetic
/// data base", 1966), so that rays traced together hit the same objects. For the order of the
/// pixels in a tile, see sampling_order.h. The number of samples of a pixel depends on the options
/// and on the PixelStates in its tile, but not on the threads.
///
/// Slicing::Time begins with a turn that traces a ray through every pixel's centre. Pixels whose
/// error is small after this turn get no samples. The next three turns take the first samples: in
/// one pixel of 16, in one of 4, and in all pixels. If all pixels of a tile are untouched (see
/// PixelState) after the second of these three turns, the tile gets no more samples. With a
/// threshold of 0, no samples are omitted.
///
/// Only one thread at a time may call this class. With Slicing::Time, only begin() allocates
/// memory. With Slicing::Spatial, begin() and next() allocate memory.
class Slices {
public:
    explicit Slices(const SliceOptions& options);

    enum class Density : unsigned char {
        None,
        Quarter,  ///< pixels with even column and even row
        Full,
    };
    /// Begins a picture. All portions of the previous picture must be done. `densityOf` returns the
    /// density of each tile in `bounds`. Without it, all tiles have density Full.
    void begin(const PixelRect& bounds, Size picture,
               const std::function<Density(const PixelRect& tile)>& densityOf = {});

    /// Returns the next portion. It has at most `mostSamples` samples in total, but at least one
    /// pixel. It has no pixels if all work is done or the rest must wait for portions being traced.
    [[nodiscard]] Slice next(std::int64_t mostSamples);

    void done(const Slice& slice, const PixelStates& states);

    /// True after each turn (a pass over the pixels): no portion is being traced, and every pixel
    /// has samples() samples or needs no more. The picture may then be shown. Also true before the
    /// first turn.
    [[nodiscard]] bool turnComplete() const;
    /// Samples per pixel after the last complete turn. Pixels that needed no more have fewer. A
    /// turn is one pass over the picture; Slicing::Spatial has only one.
    [[nodiscard]] int samples() const { return samples_; }
    [[nodiscard]] int turns() const { return turnComplete() ? turn_ : std::max(turn_ - 1, 0); }
    [[nodiscard]] bool finished() const { return unfinished_ == 0; }

    [[nodiscard]] std::size_t pixels() const { return pixels_.size(); }
    [[nodiscard]] std::uint64_t traced() const { return traced_; }
    [[nodiscard]] double progress() const;

private:
    struct Tile {
        /// The tile's range in pixels_.
        std::uint32_t first = 0, count = 0;
        /// Number of pixels that get more samples. They come first in the range.
        std::uint32_t active = 0;
        /// Number of active pixels handed out in this round. A round gives samplesPerTurn samples
        /// to each active pixel. With Slicing::Time, the first round with samples takes three
        /// turns.
        std::uint32_t handed = 0;
        std::uint32_t most = 0;  ///< value of `handed` at which the current turn is complete
        std::uint32_t out = 0;   ///< number of portions being traced
        int samples = 0;         ///< number of samples of each active pixel
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
    std::vector<std::uint32_t> open_;  ///< tiles in progress, only for Slicing::Spatial
    std::vector<std::uint64_t> order_;
    int width_ = 1;
    std::uint32_t cursor_ = 0;  ///< index of the first tile with pixels to hand out in this turn
    int samples_ = 0, turn_ = 0;
    /// Numbers of tiles that need more samples, in total and in this turn.
    std::size_t unfinished_ = 0, ofTurn_ = 0;
    /// Numbers of traced samples and of samples that are not needed.
    std::uint64_t traced_ = 0, settled_ = 0;
};

}  // namespace mfar
