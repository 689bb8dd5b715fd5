#pragma once

#include "pipeline/enlarge/filter_bank.h"

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

// Least-squares fit of the learned enlarger's filters. The sums over each class's pixels are
// computed in double precision and in a fixed order, so that equal pixels give equal filters.

namespace mfar::enlarge {

/// The grey levels of a pixel's neighbours minus that of the pixel, in the order of kTapAt.
using Taps = Eigen::Matrix<double, kTaps, 1>;
/// One value for each sub-pixel of a pixel, row-major. The sums of this file use the grey level of
/// the true picture minus that of Keys' cubic enlargement.
using Phases = Eigen::Matrix<double, kPhases, 1>;
/// Weights of a class's filter as they are applied. (FilterBank::Filter stores halved weights.)
using ClassWeights = Eigen::Matrix<double, kTaps, kPhases>;

/// The stored filter of a class, and the symmetry that maps the class's pixels onto this filter.
/// Classes that a symmetry maps onto each other share one stored filter.
struct UniqueClass {
    int number;  ///< index of the stored filter, [0, kUnique)
    Symmetry same;
};
/// Returns the stored filter of the gradient class `number`, as simd::classRow() numbers classes.
[[nodiscard]] UniqueClass uniqueByGradient(int number);
/// The same for a curvature class.
[[nodiscard]] UniqueClass uniqueByCurvature(int number);

[[nodiscard]] FilterBank::Filter roundedFilter(const ClassWeights& weights);
[[nodiscard]] ClassWeights weightsOf(const FilterBank::Filter& filter);

struct ClassSums {
    Eigen::Matrix<double, kTaps, kTaps> taps = Eigen::Matrix<double, kTaps, kTaps>::Zero();
    ClassWeights products = ClassWeights::Zero();
    double squares = 0;
    double pixels = 0;

    void add(const Taps& steps, const Phases& target);
    void add(const ClassSums& other);
    void fade(double share);
    /// Returns the sums over the same pictures and their copies rotated by 180 degrees. A pixel has
    /// the same class in the picture and in the rotated copy. `pixels` is not doubled.
    [[nodiscard]] ClassSums turnedToo() const;
    /// Returns the sum of squared errors of a filter with these weights.
    [[nodiscard]] double errorOf(const ClassWeights& weights) const;
};

/// Normal equations of all classes. Pixels are added in groups, because adding them one by one is
/// slower.
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

    // Mutable, because operator[] adds pixels that wait in an incomplete group.
    mutable std::vector<ClassSums> sums_;
    mutable std::vector<Group> groups_;
};

}  // namespace mfar::enlarge
