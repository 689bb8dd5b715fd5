#pragma once

#include "pipeline/epipolar/epipolar_lens.h"

#include <cstdint>

namespace mfar {

/// Costs of one pixel, whose census is `own`, at SemiGlobal::kLabels evenly spaced points of a
/// segment in the still, ends included: differences from the nearest pixels' census. Half of the
/// bits where there is none. `size` of the still. The segment is short, so the lens may be taken as
/// straight along it.
void costsAlong(EpipolarLens::Point from, EpipolarLens::Point to, std::uint32_t own,
                const std::uint32_t* still, Size size, std::uint8_t* out);

/// Takes what the segments one pixel to either side of the same one cost, where that is less.
void takeLesserBeside(EpipolarLens::Point from, EpipolarLens::Point to, std::uint32_t own,
                      const std::uint32_t* still, Size size, std::uint8_t* costs);

}  // namespace mfar
