#pragma once

#include "pipeline/enlarge/filter_bank.h"

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

// Least squares for the filters of the learned enlarger: sums over pixels, class by class, in
// double precision and in a fixed order, so that the same pixels give the same bits.

namespace mfar::enlarge {

/// Differences of the neighbours to the pixel [grey levels], in the order of kTapAt.
using Taps = Eigen::Matrix<double, kTaps, 1>;
/// Residual of the cubic at the sub-pixels, row-major [grey levels].
using Phases = Eigen::Matrix<double, kPhases, 1>;
/// Weights of a filter whose output is used alone: not halved.
using ClassWeights = Eigen::Matrix<double, kTaps, kPhases>;

/// A stored filter, and the symmetry that maps the picture onto it.
struct UniqueClass {
    int number;  ///< [0, kUnique)
    Symmetry same;
};
/// `number`: class number of simd::classRow().
[[nodiscard]] UniqueClass uniqueByGradient(int number);
[[nodiscard]] UniqueClass uniqueByCurvature(int number);

[[nodiscard]] FilterBank::Filter roundedFilter(const ClassWeights& weights);
[[nodiscard]] ClassWeights weightsOf(const FilterBank::Filter& filter);

/// Normal equations of one class.
struct ClassSums {
    Eigen::Matrix<double, kTaps, kTaps> taps = Eigen::Matrix<double, kTaps, kTaps>::Zero();
    ClassWeights products = ClassWeights::Zero();
    double squares = 0;  ///< of the targets
    double pixels = 0;

    void add(const Taps& steps, const Phases& target);
    void add(const ClassSums& other);
    /// Multiplies all sums by `share`.
    void fade(double share);
    /// The sums, plus those of the same pictures turned by 180 degrees, which have the same
    /// classes.
    [[nodiscard]] ClassSums turnedToo() const;
    /// Sum of the squared errors that these weights leave on the pixels summed up.
    [[nodiscard]] double errorOf(const ClassWeights& weights) const;
};

/// Normal equations of all classes. Pixels are summed up in groups, which is faster.
class SumsOfClasses {
public:
    SumsOfClasses();

    void add(const UniqueClass& to, const Taps& steps, const Phases& target);
    void fade(double share);
    void add(const SumsOfClasses& other);
    [[nodiscard]] const ClassSums& operator[](int unique) const;
    [[nodiscard]] ClassSums& edit(int unique);

private:
    static constexpr int kGroup = 32;
    struct Group {
        Eigen::Matrix<double, kTaps, kGroup> steps;
        Eigen::Matrix<double, kPhases, kGroup> targets;
        int size = 0;
    };
    void finish(int unique) const;

    // Mutable: reads finish groups that are not summed up yet.
    mutable std::vector<ClassSums> sums_;
    mutable std::vector<Group> groups_;
};

}  // namespace mfar::enlarge
