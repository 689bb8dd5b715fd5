#pragma once

#include "base/geometry.h"

namespace mfar {

/// Options that decide when a real surface hides a virtual one. The difference of their inverse
/// depths is measured in sigmas. One sigma is the standard deviation of this difference, which
/// follows from the measured standard deviation of the real depth and from virtualSigma.
struct CompositeOptions {
    /// A real surface hides nothing if it is nearer than the virtual one by less than this
    /// [sigmas]. So a table does not hide the bottom of an object that stands on it.
    double bias = 0.5;
    /// A real surface that is nearer by at least bias + softness [sigmas] hides the virtual one
    /// completely. If it is nearer by less than this, but by more than `bias`, it hides the virtual
    /// one partly. `softness` is at least 0.01.
    double softness = 1;
    /// Standard deviation of the virtual depth, caused by the error of the pose [fraction of the
    /// depth].
    double virtualSigma = 0.003;
    /// Distance of two colours (RGB, Euclidean) [grey levels], at least 0.1. If the colours of a
    /// depth sample and of the output pixel differ by this, the sample's weight is exp(-1/2) of the
    /// weight for equal colours.
    double likeness = 12;

    /// True if a real surface with inverse depth `inverseDepth` and its standard deviation `sigma`
    /// [1/m] certainly hides a virtual surface at inverse depth `inverse` [1/m] completely.
    [[nodiscard]] bool hides(double inverseDepth, double sigma, double inverse) const {
        const double sigmas = bias + softness;
        return inverseDepth - sigmas * sigma >= inverse * (1 + sigmas * virtualSigma);
    }
};

/// Throws std::invalid_argument if an option is not finite or out of range.
void validate(const CompositeOptions& options);

/// Returns a rectangle with all output pixels that depend on the pixels `layerPixels` of a virtual
/// layer. `layer` and `output` are the pictures' sizes.
[[nodiscard]] PixelRect layerInOutput(const PixelRect& layerPixels, Size layer, Size output);

}  // namespace mfar
