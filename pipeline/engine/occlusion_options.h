#pragma once

#include "base/geometry.h"

namespace mfar {

/// When a real surface hides a virtual one. The sigma of a comparison is that of the difference of
/// both inverse depths: the real one's as given, the virtual one's by `virtualSigma`.
struct CompositeOptions {
    /// How much nearer than the virtual surface the real one must be to hide any of it [sigmas]; so
    /// a table does not hide the bottom of an object standing on it.
    double bias = 0.5;
    /// Additional distance until all of it is hidden [sigmas], at least 0.01.
    double softness = 1;
    /// Standard deviation of virtual depth, due to the error of the pose [share of the depth].
    double virtualSigma = 0.003;
    /// Distance of two colours (RGB, Euclidean) at which the weight of a depth sample is multiplied
    /// by exp(-1/2) [grey levels], above 0.
    double likeness = 12;

    /// True when a single real sample (inverse depth and its sigma [1/m]) completely hides a
    /// surface at inverse depth `inverse` [1/m].
    [[nodiscard]] bool hides(double rho, double sigma, double inverse) const {
        const double sigmas = bias + softness;
        return rho - sigmas * sigma >= inverse * (1 + sigmas * virtualSigma);
    }
};

/// Throws std::invalid_argument for an option that is not finite or out of its range.
void validate(const CompositeOptions& options);

/// The output pixels that depend on these pixels of a virtual layer.
[[nodiscard]] PixelRect layerInOutput(const PixelRect& layerPixels, Size layer, Size output);

}  // namespace mfar
