#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "tests/measure/train/training_pair.h"

#include <Eigen/Dense>

#include <vector>

namespace mfar::train {

/// Least squares for the filters of every class, from pairs of pictures: what the learned enlarger
/// is trained by. In double precision and in a fixed order: the same pairs give the same bits.
class EnlargerTraining {
public:
    EnlargerTraining();

    /// `heldOut`: to check filters on, not to learn from.
    void add(const TrainingPair& pair, bool heldOut);

    struct Outcome {
        std::vector<FilterBank::Filter> filters;  ///< kUnique, see FilterBank
        int used = 0;                             ///< number of classes that are not zero
        /// Sums of squares on the pairs held out, of the gradient's classes and of the curvature's.
        double cubicError[2] = {}, error[2] = {};
    };
    /// `ridge`: weight of zero against the pairs' sums [grey levels^2]. A class whose filter is no
    /// better than the cubic on the pairs held out, or that too few pixels have, gets zeros.
    [[nodiscard]] Outcome solve(double ridge) const;

private:
    using Taps = Eigen::Matrix<double, enlarge::kTaps, 1>;
    using Phases = Eigen::Matrix<double, enlarge::kPhases, 1>;
    struct Sums {
        Eigen::Matrix<double, enlarge::kTaps, enlarge::kTaps> taps;
        Eigen::Matrix<double, enlarge::kTaps, enlarge::kPhases> products;
        double squares = 0, pixels = 0;
    };
    using Weights = Eigen::Matrix<double, enlarge::kTaps, enlarge::kPhases>;

    static void accumulate(Sums& sums, const Taps& steps, const Phases& target,
                           const enlarge::Symmetry& same);
    [[nodiscard]] static Sums turnedToo(const Sums& sums);
    [[nodiscard]] static double errorOf(const Sums& sums, const Weights& weights);

    std::vector<Sums> learned_, checked_;  // per unique class
};

}  // namespace mfar::train
