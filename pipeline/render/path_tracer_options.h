#pragma once

#include <cstdint>

namespace mfar {

/// Region around a pixel from which its samples are drawn.
enum class PixelFilter {
    Box,   ///< the pixel itself
    Tent,  ///< falls to 0 at the neighbours' centres
};

struct PathTracerOptions {
    int maxDepth = 6;        ///< surfaces on a path, the camera's first included; [1, 64]
    int rouletteDepth = 3;   ///< surfaces after which a path may end by chance; at least 1
    float fireflyClamp = 0;  ///< upper limit of an indirect contribution's brightest channel; 0: no
                             ///< limit
    PixelFilter filter = PixelFilter::Box;
    std::uint32_t seed = 0;
    bool independentSamples = false;  ///< use independent random numbers instead of the Sobol
                                      ///< sequence
    float shadowReach = 3;  ///< radius around an object, in its radii, in which the catcher is
                            ///< traced; at least 1
    int buildThreads = 1;   ///< for the search structure; [1, 64]
    bool operator==(const PathTracerOptions&) const = default;
};

/// Throws std::invalid_argument that names the first option out of its range.
void validate(const PathTracerOptions& options);

}  // namespace mfar
