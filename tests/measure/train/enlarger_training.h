#pragma once

#include "pipeline/enlarge/class_sums.h"
#include "tests/measure/train/training_pair.h"

#include <vector>

namespace mfar::train {

/// Trains the learned enlarger: least squares for the filters of every class, from pairs of
/// pictures. In double precision and in a fixed order, so that the same pairs give bit-identical
/// filters.
class EnlargerTraining {
public:
    EnlargerTraining();

    /// `heldOut`: used to check filters, not to learn.
    void add(const TrainingPair& pair, bool heldOut);

    struct Outcome {
        std::vector<FilterBank::Filter> filters;  ///< kUnique, see FilterBank
        int used = 0;                             ///< number of classes with a filter that is not
                                                  ///< zero
        /// Sums of squared errors on the held-out pairs, of the gradient classes and of the
        /// curvature classes.
        double cubicError[2] = {}, error[2] = {};
    };
    /// `ridge`: regularisation weight relative to the pairs' sums [grey levels^2]. A class gets
    /// zeros if its filter is no better than the cubic on the held-out pairs, or if too few pixels
    /// belong to it.
    [[nodiscard]] Outcome solve(double ridge) const;

private:
    static void accumulate(std::vector<enlarge::ClassSums>& to, const enlarge::UniqueClass& of,
                           const enlarge::Taps& steps, const enlarge::Phases& target);

    std::vector<enlarge::ClassSums> learned_, checked_;  // per unique class
};

}  // namespace mfar::train
