#pragma once

#include "base/geometry.h"

namespace mfar {

/// Options that decide when a real surface hides a virtual one. The difference of their inverse
/// depths is measured in sigmas. One sigma is the standard deviation of this difference. It is
/// computed from the standard deviation of the real depth, which is measured with the depth, and
/// from that of the virtual depth, virtualSigma.
struct CompositeOptions {
    /// If the real surface is nearer than the virtual one by less than this [sigmas], it hides
    /// nothing. So a table does not hide the bottom of an object that stands on it.
    double bias = 0.5;
    /// The real surface hides the virtual one completely if it is nearer by at least bias +
    /// softness [sigmas]. Between `bias` and this limit, it hides it partly. At least 0.01.
    double softness = 1;
    /// Standard deviation of the virtual depth [fraction of the depth]. It is caused by the error
    /// of the pose.
    double virtualSigma = 0.003;
    /// A depth sample has less weight if its video colour differs from the colour of the output
    /// pixel. At this distance of the two colours (RGB, Euclidean) [grey levels], the weight is
    /// multiplied by exp(-1/2). At least 0.1.
    double likeness = 12;

    /// True if a sample of the real depth (inverse depth and its sigma [1/m]) on its own completely
    /// hides a virtual surface at inverse depth `inverse` [1/m].
    [[nodiscard]] bool hides(double inverseDepth, double sigma, double inverse) const {
        const double sigmas = bias + softness;
        return inverseDepth - sigmas * sigma >= inverse * (1 + sigmas * virtualSigma);
    }
};

/// Throws std::invalid_argument if an option is not finite or out of range.
void validate(const CompositeOptions& options);

/// Returns the output pixels that depend on the pixels `layerPixels` of a virtual layer.
[[nodiscard]] PixelRect layerInOutput(const PixelRect& layerPixels, Size layer, Size output);

}  // namespace mfar
