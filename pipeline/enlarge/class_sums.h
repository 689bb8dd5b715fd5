#pragma once

#include "pipeline/enlarge/filter_bank.h"

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

// Least-squares fit of the filters of the learned enlarger. The sums over the pixels of each class
// are computed in double precision and in a fixed order, so that the same pixels give exactly the
// same filters.

namespace mfar::enlarge {

/// Differences between a pixel's neighbours and the pixel [grey levels], in the order of kTapAt.
using Taps = Eigen::Matrix<double, kTaps, 1>;
/// True picture minus the enlargement by Keys' cubic, at the sub-pixels of a pixel, row-major [grey
/// levels].
using Phases = Eigen::Matrix<double, kPhases, 1>;
/// Weights of a class's filter. Unlike those of FilterBank::Filter, they are not halved.
using ClassWeights = Eigen::Matrix<double, kTaps, kPhases>;

/// The stored filter that a class uses, and the symmetry that maps the class's pixels onto the
/// filter's own class. Only classes that no symmetry maps onto each other have stored filters.
struct UniqueClass {
    int number;  ///< index among the classes with stored filters, [0, kUnique)
    Symmetry same;
};
/// `number`: index of a class, as simd::classRow() computes it.
[[nodiscard]] UniqueClass uniqueByGradient(int number);
[[nodiscard]] UniqueClass uniqueByCurvature(int number);

[[nodiscard]] FilterBank::Filter roundedFilter(const ClassWeights& weights);
[[nodiscard]] ClassWeights weightsOf(const FilterBank::Filter& filter);

/// Normal equations of the least-squares fit for one class.
struct ClassSums {
    Eigen::Matrix<double, kTaps, kTaps> taps = Eigen::Matrix<double, kTaps, kTaps>::Zero();
    ClassWeights products = ClassWeights::Zero();
    double squares = 0;  ///< sum of the squared targets
    double pixels = 0;

    void add(const Taps& steps, const Phases& target);
    void add(const ClassSums& other);
    /// Multiplies all sums by the factor `share`.
    void fade(double share);
    /// Returns these sums plus the sums over the same pictures rotated by 180 degrees. The rotation
    /// does not change the class of any pixel.
    [[nodiscard]] ClassSums turnedToo() const;
    /// Returns the sum of the squared errors of a filter with these weights, over the pixels of the
    /// sums.
    [[nodiscard]] double errorOf(const ClassWeights& weights) const;
};

/// Normal equations of all classes. Pixels are collected and added in groups, which is faster.
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

    // These members are mutable, because operator[] first adds the pixels of an incomplete group to
    // the sums.
    mutable std::vector<ClassSums> sums_;
    mutable std::vector<Group> groups_;
};

}  // namespace mfar::enlarge
