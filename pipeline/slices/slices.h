#pragma once

#include "base/geometry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// The order in which a picture's samples are taken.
enum class Slicing {
    /// A few samples of every pixel per turn: the picture is soon complete, and every turn makes it
    /// less noisy.
    Time,
    /// All samples of a tile, then of the next tile: the picture is complete only at the end.
    Spatial,
};

struct SliceOptions {
    Slicing slicing = Slicing::Time;
    int samples = 64;        ///< largest number of samples per pixel
    int samplesPerTurn = 2;  ///< samples per pixel in one portion, for both values of `slicing`
    /// A pixel gets no more samples if its standard error [grey levels] and those of the adjacent
    /// pixels in the tile are below this limit. The neighbours count, because the estimate of a
    /// single pixel may be low by chance. 0: every pixel gets all samples.
    float threshold = 1;
    int leastSamples = 16;  ///< from this number of samples on, an estimated error is trusted
    bool operator==(const SliceOptions&) const = default;
};

/// A portion of work: `samples` further samples for each pixel, or only a ray through the centre of
/// each pixel if `samples` is 0. The span is valid until done().
struct Slice {
    std::span<const std::uint32_t> pixels;  ///< row-major indices
    int samples = 0;
    std::uint32_t tile = 0;  ///< index of the tile in Morton order
};

/// What Slices must know about a pixel.
struct PixelState {
    float error = 0;         ///< standard error [grey levels]; infinite if unknown
    float samples = 0;       ///< number of samples from which the error was estimated
    bool untouched = false;  ///< the pixel has shown no object and no changed light so far
};
using PixelStates = std::function<PixelState(std::uint32_t)>;

/// Divides the rendering of a picture into portions for several threads. Tiles have 8x8 pixels.
/// Tiles, and the pixels in a tile, are in Morton order (G. M. Morton, "A computer oriented
/// geodetic data base", 1966), so that rays that are traced together hit the same objects.
/// The number of samples of a pixel depends only on the errors in its tile. It is therefore the
/// same for both values of Slicing, and does not depend on which thread gets which portion.
///
/// Slicing::Time begins with a turn that traces a ray through every pixel's centre. Pixels whose
/// error is small after this turn get no samples. The first samples are taken in the next three
/// turns: in one pixel of 16, in one pixel of 4, and in all pixels; these pixels are evenly spread.
/// Tiles that are untouched after the first two of these three turns are left out of the third.
///
/// Only one thread at a time may call it. Only begin() allocates memory.
class Slices {
public:
    /// Throws std::invalid_argument if an option is out of range.
    explicit Slices(const SliceOptions& options);

    /// Which pixels of a tile are sampled.
    enum class Density : unsigned char {
        None,
        Quarter,  ///< the pixels with even column and even row
        Full,
    };
    /// Begins a picture. `densityOf` returns the density of each tile in `bounds`. Without
    /// `densityOf`, all tiles have density Full. All portions of the previous picture must be done.
    void begin(const PixelRect& bounds, Size picture,
               const std::function<Density(const PixelRect& tile)>& densityOf = {});

    /// The next portion. It has at most about `mostSamples` samples (pixels times samples per
    /// pixel), but at least one pixel. It has no pixels if all work is done or if the rest of the
    /// work must wait for outstanding portions.
    [[nodiscard]] Slice next(std::int64_t mostSamples);

    /// Reports that a portion was traced.
    void done(const Slice& slice, const PixelStates& states);

    /// Whether no portion is outstanding and every pixel either has samples() samples or needs no
    /// more. Then the picture may be shown. Also true before the first turn.
    [[nodiscard]] bool turnComplete() const;
    /// Number n of samples after the last complete turn: each pixel had n samples, or fewer if it
    /// needed no more. Slicing::Spatial has only one turn.
    [[nodiscard]] int samples() const { return samples_; }
    /// Number of complete turns. In Slicing::Time, turn 1 is the ray through the centres, and turns
    /// 2 to 4 take the first samples.
    [[nodiscard]] int turns() const { return turnComplete() ? turn_ : std::max(turn_ - 1, 0); }
    [[nodiscard]] bool finished() const { return unfinished_ == 0; }

    [[nodiscard]] std::size_t pixels() const { return pixels_.size(); }
    /// Number of samples that all pixels together got since begin().
    [[nodiscard]] std::uint64_t traced() const { return traced_; }
    /// Share of the samples that are done or not needed, in [0, 1]; 1 when finished.
    [[nodiscard]] double progress() const;

private:
    struct Tile {
        std::uint32_t first = 0, count = 0;  ///< in pixels_: first pixel, number of pixels
        /// Number of pixels that get more samples; they are the tile's first pixels in pixels_.
        std::uint32_t active = 0;
        /// Number of active pixels handed out in this round. A round gives each active pixel the
        /// samples of one turn.
        std::uint32_t handed = 0;
        std::uint32_t most = 0;  ///< upper limit of `handed` in this turn
        std::uint32_t out = 0;   ///< number of outstanding portions
        int samples = 0;         ///< number of samples that each active pixel has
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
    std::vector<std::uint32_t> open_;   ///< Slicing::Spatial: indices of tiles in progress
    std::vector<std::uint64_t> order_;  ///< sorted Morton codes of the tiles
    int width_ = 1;
    std::uint32_t cursor_ = 0;  ///< index of the first tile with pixels to hand out in this turn
    int samples_ = 0, turn_ = 0;
    /// unfinished_: number of tiles that need more samples. ofTurn_: number of tiles with work left
    /// in this turn.
    std::size_t unfinished_ = 0, ofTurn_ = 0;
    /// traced_: number of samples that were traced. settled_: number of samples that are not
    /// needed.
    std::uint64_t traced_ = 0, settled_ = 0;
};

}  // namespace mfar
