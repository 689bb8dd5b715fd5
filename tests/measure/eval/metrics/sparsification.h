#pragma once

#include <span>
#include <vector>

namespace mfar::eval {

/// Tells if a method's confidence is low where its errors are large (Ilg et al. 2018). Pixels are
/// removed step by step, the least confident first, and the mean error of the others is recorded.
struct Sparsification {
    static constexpr int kSteps = 100;

    std::vector<double> byConfidence;  ///< mean error of the remaining pixels / of all pixels
    std::vector<double> byError;       ///< the same, if pixels with large errors are removed first
    double ause = 0;                   ///< area between both curves; 0: the best order
    double ausePerRandom = 0;          ///< `ause` divided by the `ause` of a random order
};

/// `error`, `confidence`: one finite value for each pixel. Errors must not be negative. Only the
/// order of the confidences matters; pixels with equal confidence are removed evenly. If all errors
/// are 0, the areas are NaN and the curves empty. Throws std::invalid_argument for spans of
/// different lengths and for invalid values.
[[nodiscard]] Sparsification sparsification(std::span<const float> error,
                                            std::span<const float> confidence);

}  // namespace mfar::eval
