#pragma once

#include <string>
#include <vector>

namespace mfar::bench {

/// Rates at which one thread finds the first hits of a 640x480 camera's rays on a sphere. Measured
/// with the same rays for Embree's rtcIntersect1 in a plain loop, and for the product's camera
/// rays, which include the lens and are traced in packets. Also the rate of whole samples (paths)
/// of a matt surface in sunlight.
struct RayRates {
    int triangles = 0;
    double bare = 0, ours = 0;  ///< rays of plain Embree and of the product [Mray/s]
    double samples = 0;         ///< samples of the whole picture [Msample/s]
};

/// Root mean square error of the picture's radiance at 16 samples per pixel: of the product, and
/// with independent random samples.
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
