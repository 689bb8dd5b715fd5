#pragma once

#include <span>
#include <vector>

namespace mfar::eval {

/// Whether a method knows where it is wrong (Ilg et al. 2018): pixels are taken away, those first
/// of which it is least certain, and the mean error of the rest is watched.
struct Sparsification {
    static constexpr int kSteps = 100;  ///< of the share that is taken away

    std::vector<double> byConfidence;  ///< mean error of the rest over that of all, from 1 on
    std::vector<double> byError;       ///< the same in the best possible order
    double ause = 0;                   ///< area between both curves; 0: the best order
    double ausePerRandom = 0;          ///< the same as a share of what a random order gets
};

/// `error` and `confidence` of each pixel, both finite, errors not negative. Only the order of the
/// confidences matters; equal ones are taken away evenly. Areas are NaN and curves empty without
/// any error. Throws std::invalid_argument for spans of different length and unsound values.
[[nodiscard]] Sparsification sparsification(std::span<const float> error,
                                            std::span<const float> confidence);

}  // namespace mfar::eval
