#pragma once

#include "pipeline/enlarge/class_sums.h"
#include "tests/measure/train/training_pair.h"

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
    static void accumulate(std::vector<enlarge::ClassSums>& to, const enlarge::UniqueClass& of,
                           const enlarge::Taps& steps, const enlarge::Phases& target);

    std::vector<enlarge::ClassSums> learned_, checked_;  // per unique class
};

}  // namespace mfar::train
