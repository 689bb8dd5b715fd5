#pragma once

#include "pipeline/engine/occlusion_options.h"
#include "pipeline/engine/params/occlusion.h"
#include "tests/oracle/picture.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

/// Oracle of how real surfaces hide virtual objects in the composite.
namespace mfar::twin {

struct RealSample {
    double inverseDepth, sigma;
};

/// Visibility (0 to 1) of a virtual surface at inverse depth `inverse`. An unknown real depth hides
/// nothing.
inline double visibleOver(const RealSample& real, double inverse, const CompositeOptions& o) {
    const bool known = real.inverseDepth > params::kLeastInverseDepth &&
                       real.inverseDepth < params::kMostInverseDepth &&
                       real.sigma > params::kLeastDepthSigma &&
                       real.sigma < params::kMostInverseDepth;
    if (!known) return 1;
    const double sigma = std::hypot(real.sigma, o.virtualSigma * inverse);
    const double t =
        std::clamp(((real.inverseDepth - inverse) / sigma - o.bias) / o.softness, 0.0, 1.0);
    return 1 - t * t * (3 - 2 * t);
}

struct Scene {
    TestPicture video, picture;
    std::vector<RealSample> real;

    [[nodiscard]] double visibility(int x, int y, double z, const CompositeOptions& o) {
        if (!(z > params::kLeastVirtualDepth && z < params::kMostVirtualDepth)) return 0;
        const double u = (x + 0.5) * video.size.width / picture.size.width - 0.5;
        const double v = (y + 0.5) * video.size.height / picture.size.height - 0.5;
        const int left = static_cast<int>(std::floor(u)) - 1;
        const int top = static_cast<int>(std::floor(v)) - 1;
        double sum = 0, weights = 0;
        for (int j = top; j < top + 4; ++j) {
            for (int i = left; i < left + 4; ++i) {
                const int qx = std::clamp(i, 0, video.size.width - 1);
                const int qy = std::clamp(j, 0, video.size.height - 1);
                const double tent = (2 - std::abs(i - u)) * (2 - std::abs(j - v));
                double unlike = 0;
                for (int c = 0; c < 3; ++c)
                    unlike += std::pow(double(video.at(qx, qy)[c]) - picture.at(x, y)[c], 2);
                const double w =
                    tent * tent *
                    (std::exp(-unlike / (2 * o.likeness * o.likeness)) + params::kLikenessFloor);
                sum += w * visibleOver(real[qy * 1UL * video.size.width + qx], 1 / z, o);
                weights += w;
            }
        }
        return sum / weights;
    }
};

}  // namespace mfar::twin
