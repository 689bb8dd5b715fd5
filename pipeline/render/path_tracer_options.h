#pragma once

#include <cstdint>

namespace mfar {

/// The filter from which the positions of a pixel's samples are drawn.
enum class PixelFilter {
    Box,   ///< uniform over the pixel itself
    Tent,  ///< falls to 0 at the centres of the neighbouring pixels
};

struct PathTracerOptions {
    int maxDepth = 6;        ///< surfaces on a path, including the first; [1, 64]
    int rouletteDepth = 3;   ///< surfaces after which Russian roulette may end a path; at least 1
    float fireflyClamp = 0;  ///< limit of an indirect contribution's brightest channel; 0: no limit
    PixelFilter filter = PixelFilter::Box;
    std::uint32_t seed = 0;
    bool independentSamples = false;  ///< independent random numbers instead of the Sobol sequence
    float shadowReach = 3;  ///< the shadow catcher is traced within this radius around an object
                            ///< [object radii]; at least 1
    int buildThreads = 1;   ///< threads that build the search structure; [1, 64]
    bool operator==(const PathTracerOptions&) const = default;
};

/// Throws std::invalid_argument whose message names the first option that is out of range.
void validate(const PathTracerOptions& options);

}  // namespace mfar
