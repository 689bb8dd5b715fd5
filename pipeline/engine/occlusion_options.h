#pragma once

#include "base/geometry.h"

namespace mfar {

/// Options that decide when a real surface hides a virtual one. The difference of their inverse
/// depths is measured in sigmas. One sigma is the standard deviation of this difference. It follows
/// from the measured standard deviation of the real depth and from virtualSigma. No option may be
/// negative or above 1000.
struct CompositeOptions {
    /// A real surface that is nearer than the virtual one by less than this [sigmas] hides nothing.
    /// This prevents, for example, that a table hides the bottom of an object that stands on it.
    double bias = 0.5;
    /// A real surface that is nearer by at least bias + softness [sigmas] hides the virtual one
    /// completely. Between `bias` and bias + softness, it hides the virtual one partly. `softness`
    /// is at least 0.01.
    double softness = 1;
    /// Standard deviation of the virtual depth, as a fraction of the depth. It is caused by the
    /// error of the pose.
    double virtualSigma = 0.003;
    /// Width of the Gaussian by which depth samples are weighted according to their colour [grey
    /// levels], at least 0.1. A sample counts exp(-1/2) times as much as one of equal colour if its
    /// colour differs from that of the output pixel by this distance (RGB, Euclidean).
    double likeness = 12;

    /// True if a real surface certainly hides a virtual one completely. The real surface has the
    /// inverse depth `inverseDepth` with the standard deviation `sigma`, the virtual one has the
    /// inverse depth `inverse` [1/m].
    [[nodiscard]] bool hides(double inverseDepth, double sigma, double inverse) const {
        const double sigmas = bias + softness;
        return inverseDepth - sigmas * sigma >= inverse * (1 + sigmas * virtualSigma);
    }
};

/// Throws std::invalid_argument if an option is not finite or out of range.
void validate(const CompositeOptions& options);

/// Returns a rectangle with all output pixels that depend on the rectangle `layerPixels` of a
/// virtual layer. `layer` and `output` are the sizes of the two pictures.
[[nodiscard]] PixelRect layerInOutput(const PixelRect& layerPixels, Size layer, Size output);

}  // namespace mfar
