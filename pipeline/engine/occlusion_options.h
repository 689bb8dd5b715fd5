#pragma once

#include "base/geometry.h"

namespace mfar {

/// Options for when a real surface hides a virtual one. Both inverse depths are compared in sigmas,
/// the standard deviation of their difference. It follows from the sigma of the real depth, which
/// is given with it, and of the virtual depth, see virtualSigma.
struct CompositeOptions {
    /// If the real surface is nearer than the virtual one by less than this [sigmas], it hides
    /// nothing. So a table does not hide the bottom of an object that stands on it.
    double bias = 0.5;
    /// Additional distance [sigmas] from which on the real surface hides the virtual one
    /// completely; at least 0.01.
    double softness = 1;
    /// Standard deviation of the virtual depth, caused by the error of the pose [share of the
    /// depth].
    double virtualSigma = 0.003;
    /// Distance of two colours (RGB, Euclidean) [grey levels] at which the weight of a depth sample
    /// is multiplied by exp(-1/2); above 0.
    double likeness = 12;

    /// True if a single real sample (inverse depth and its sigma [1/m]) completely hides a virtual
    /// surface at inverse depth `inverse` [1/m].
    [[nodiscard]] bool hides(double inverseDepth, double sigma, double inverse) const {
        const double sigmas = bias + softness;
        return inverseDepth - sigmas * sigma >= inverse * (1 + sigmas * virtualSigma);
    }
};

/// Throws std::invalid_argument if an option is not finite or out of range.
void validate(const CompositeOptions& options);

/// Returns the output pixels that depend on these pixels of a virtual layer.
[[nodiscard]] PixelRect layerInOutput(const PixelRect& layerPixels, Size layer, Size output);

}  // namespace mfar
