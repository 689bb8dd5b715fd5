#pragma once

#include <span>
#include <vector>

namespace mfar::eval {

/// Tells whether a method knows where it is wrong (Ilg et al. 2018). Pixels are removed by their
/// uncertainty, the most uncertain first; the mean error of the remaining ones is recorded.
struct Sparsification {
    static constexpr int kSteps = 100;  ///< number of steps in which all pixels are removed

    std::vector<double> byConfidence;  ///< mean error of the remaining pixels / of all pixels
    std::vector<double> byError;       ///< the same if the largest errors are removed first
    double ause = 0;                   ///< area between both curves; 0: no order is better
    double ausePerRandom = 0;          ///< `ause` divided by that of a random order
};

/// `error`, `confidence`: values of each pixel, finite; errors are not negative. Only the order of
/// the confidences matters; pixels with equal confidence are removed evenly. Without any error, the
/// areas are NaN and the curves empty. Throws std::invalid_argument for spans of different length
/// and for invalid values.
[[nodiscard]] Sparsification sparsification(std::span<const float> error,
                                            std::span<const float> confidence);

}  // namespace mfar::eval
