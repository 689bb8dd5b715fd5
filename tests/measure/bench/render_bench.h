#pragma once

#include <string>
#include <vector>

namespace mfar::bench {

/// Rates of first hits of a 640x480 camera on a sphere, one thread, the same rays for all: Embree's
/// rtcIntersect1 in a plain loop; the product's camera rays, with lens and packets; and complete
/// samples in sunlight on a matt surface.
struct RayRates {
    int triangles = 0;
    double bare = 0, ours = 0;  ///< [Mray/s]
    double samples = 0;         ///< samples of the whole picture [Msample/s]
};

/// Root mean square error of the picture's radiance at 16 samples per pixel.
struct SamplingError {
    std::string scene;
    double ours = 0, independent = 0;
};

struct RenderFigures {
    std::vector<RayRates> rates;
    std::vector<SamplingError> errors;
};

/// `quick`: small pictures, only to check that the program runs. Empty if the path tracer is not
/// built.
[[nodiscard]] RenderFigures measureRender(bool quick);

}  // namespace mfar::bench
