#include "pipeline/simd/still_noise.h"

#include "base/rows.h"
#include "pipeline/flow/luma_image.h"
#include "pipeline/simd/luma_filters.h"
#include "pipeline/simd/still_luma.h"

#include <algorithm>
#include <cmath>

namespace mfar::simd {
namespace {

// The noise is measured in at most kBands bands of kBandRows pixel rows each. The copy of a band at
// half size has 10 rows: one row of BlockNoise's 8x8 blocks, and one pixel row above and below it.
constexpr int kBands = 24, kBandRows = 20;
constexpr int kPadding = 64;  // StillLuma::row() writes beyond the end of a row [px]

}  // namespace

double noiseOfStill(const ImageView& still) {
    const auto [width, height] = still.size;
    if (width < kBandRows || height < kBandRows) return 0;
    const int bands = std::min(kBands, height / kBandRows);
    const StillLuma luma(still);
    StillLuma::Scratch scratch(width);
    AlignedRows<std::uint8_t> band({width + kPadding, kBandRows}), half({width, kBandRows / 2});
    BlockNoise whole, fromHalf;
    for (int i = 0; i < bands; ++i) {
        const int first = i * (height - kBandRows) / std::max(bands - 1, 1);
        for (int y = 0; y < kBandRows; ++y)
            luma.row(first + y, scratch, band[y]);
        for (int y = 0; y < kBandRows / 2; ++y)
            halveRow(band[2 * y], band[2 * y + 1], static_cast<std::size_t>(width / 2), half[y]);
        whole.add({band[0], band.pitch(), {width, kBandRows}});
        fromHalf.add({half[0], half.pitch(), {width / 2, kBandRows / 2}});
    }
    const double fine = whole.take(), coarse = fromHalf.take();
    return std::sqrt(std::max(fine * fine - coarse * coarse, 0.0) * 4 / 3);
}

}  // namespace mfar::simd
