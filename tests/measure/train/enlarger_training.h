#pragma once

#include "pipeline/enlarge/class_sums.h"
#include "tests/measure/train/training_pair.h"

#include <vector>

namespace mfar::train {

/// Trains the learned enlarger: finds the filters of every class by least squares, from pairs of
/// pictures. Sums are in double precision and in a fixed order, so that equal pairs give
/// bit-identical filters.
class EnlargerTraining {
public:
    EnlargerTraining();

    /// `heldOut`: the pair is used to check filters, not to learn them.
    void add(const TrainingPair& pair, bool heldOut);

    struct Outcome {
        std::vector<FilterBank::Filter> filters;  ///< kUnique filters, see FilterBank
        int used = 0;                             ///< number of classes whose filter is not zero
        /// Sums of squared errors on the held-out pairs: [0] of the gradient classes, [1] of the
        /// curvature classes.
        double cubicError[2] = {}, error[2] = {};
    };
    /// `ridge`: weight of the regularisation, relative to the pairs' sums [grey levels^2]. The
    /// filter of a class is zero if it is not better than the cubic on the held-out pairs, or if
    /// the class has too few pixels.
    [[nodiscard]] Outcome solve(double ridge) const;

private:
    static void accumulate(std::vector<enlarge::ClassSums>& to, const enlarge::UniqueClass& of,
                           const enlarge::Taps& steps, const enlarge::Phases& target);

    std::vector<enlarge::ClassSums> learned_, checked_;  // indexed by unique class
};

}  // namespace mfar::train
