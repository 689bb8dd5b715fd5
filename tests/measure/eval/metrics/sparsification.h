#pragma once

#include <span>
#include <vector>

namespace mfar::eval {

/// Whether a method knows where it is wrong (Ilg et al. 2018): pixels are removed in the order of
/// their uncertainty, the most uncertain first, and the mean error of the rest is recorded.
struct Sparsification {
    static constexpr int kSteps = 100;  ///< of the removed share

    std::vector<double> byConfidence;  ///< mean error of the remaining pixels over that of all,
                                       ///< starting at 1
    std::vector<double> byError;       ///< the same in the best possible order
    double ause = 0;                   ///< area between both curves; 0: the best order
    double ausePerRandom = 0;          ///< the same as a share of the area for a random order
};

/// `error` and `confidence` of each pixel: both finite, errors not negative. Only the order of the
/// confidences matters; equal ones are removed evenly. Areas are NaN and curves empty if there is
/// no error at all. Throws std::invalid_argument for spans of different length and invalid values.
[[nodiscard]] Sparsification sparsification(std::span<const float> error,
                                            std::span<const float> confidence);

}  // namespace mfar::eval
