#pragma once

#include "base/geometry.h"

namespace mfar {

/// When a real thing hides a virtual one. A sample's sigma here is that of the difference of both
/// inverse depths: of the real one as given, of the virtual one by `virtualSigma`.
struct CompositeOptions {
    /// How much nearer than the virtual surface the real one must be to hide any of it [sigmas]:
    /// what stands on a table is not eaten by it.
    double bias = 0.5;
    /// From there on, how much nearer until all of it is hidden [sigmas], at least 0.01.
    double softness = 1;
    /// Standard deviation of virtual depth, by the pose it is drawn for [share of the depth].
    double virtualSigma = 0.003;
    /// Distance of two colours (RGB, Euclidean) at which a depth sample counts for
    /// exp(-1/2) of its weight [grey levels], above 0.
    double likeness = 12;

    /// Does a real sample (inverse depth and its sigma [1/m]) hide, by itself, a surface at inverse
    /// depth `inverse` [1/m] wholly?
    [[nodiscard]] bool hides(double rho, double sigma, double inverse) const {
        const double sigmas = bias + softness;
        return rho - sigmas * sigma >= inverse * (1 + sigmas * virtualSigma);
    }
};

/// Throws std::invalid_argument for an option that is not finite or out of its range.
void validate(const CompositeOptions& options);

/// The output pixels that pixels of a virtual layer are seen in.
[[nodiscard]] PixelRect layerInOutput(const PixelRect& layerPixels, Size layer, Size output);

}  // namespace mfar
