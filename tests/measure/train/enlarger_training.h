#pragma once

#include "pipeline/enlarge/class_sums.h"
#include "tests/measure/train/training_pair.h"

#include <vector>

namespace mfar::train {

/// Trains the learned enlarger: computes the filters of all classes by least squares from pairs of
/// pictures. Sums have a fixed order, so equal pairs give bit-identical filters.
class EnlargerTraining {
public:
    EnlargerTraining();

    /// `heldOut`: the pair only serves to check the filters; nothing is learned from it.
    void add(const TrainingPair& pair, bool heldOut);

    struct Outcome {
        std::vector<FilterBank::Filter> filters;  ///< kUnique filters, see FilterBank
        int used = 0;
        /// Sums of squared errors on held-out pairs, with Keys' cubic and with the learned filters.
        /// [0]: classes by gradient; [1]: classes by curvature.
        double cubicError[2] = {}, error[2] = {};
    };
    /// `ridge`: weight of the regularisation [grey levels^2]. A class's filter is zero if it is not
    /// better than the cubic on held-out pairs, or if the class has too few pixels.
    [[nodiscard]] Outcome solve(double ridge) const;

private:
    static void accumulate(std::vector<enlarge::ClassSums>& to, const enlarge::UniqueClass& of,
                           const enlarge::Taps& steps, const enlarge::Phases& target);

    std::vector<enlarge::ClassSums> learned_, checked_;
};

}  // namespace mfar::train
