#pragma once

#include "pipeline/enlarge/filter_bank.h"

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

// Least squares for the filters of the learned enlarger. Each class sums over its pixels in double
// precision and in a fixed order, so that the same pixels give exactly the same filters.

namespace mfar::enlarge {

/// Differences between a pixel's neighbours and the pixel [grey levels], in the order of kTapAt.
using Taps = Eigen::Matrix<double, kTaps, 1>;
/// Differences of the true picture from the cubic enlargement at a pixel's sub-pixels, row-major
/// [grey levels].
using Phases = Eigen::Matrix<double, kPhases, 1>;
/// Weights of a filter that is used alone; they are not halved, unlike those of FilterBank::Filter.
using ClassWeights = Eigen::Matrix<double, kTaps, kPhases>;

/// A class whose filter is stored, and the symmetry that maps the picture onto that class.
struct UniqueClass {
    int number;  ///< [0, kUnique)
    Symmetry same;
};
/// `number`: number of the class according to simd::classRow().
[[nodiscard]] UniqueClass uniqueByGradient(int number);
[[nodiscard]] UniqueClass uniqueByCurvature(int number);

[[nodiscard]] FilterBank::Filter roundedFilter(const ClassWeights& weights);
[[nodiscard]] ClassWeights weightsOf(const FilterBank::Filter& filter);

/// Normal equations of one class.
struct ClassSums {
    Eigen::Matrix<double, kTaps, kTaps> taps = Eigen::Matrix<double, kTaps, kTaps>::Zero();
    ClassWeights products = ClassWeights::Zero();
    double squares = 0;  ///< sum of the squared targets
    double pixels = 0;

    void add(const Taps& steps, const Phases& target);
    void add(const ClassSums& other);
    /// Multiplies all sums by `share`.
    void fade(double share);
    /// Returns these sums plus those of the same pictures rotated by 180 degrees. The rotation does
    /// not change classes.
    [[nodiscard]] ClassSums turnedToo() const;
    /// Returns the sum of the squared errors that these weights leave on the summed pixels.
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

    // Mutable, because a read adds the groups that are still incomplete.
    mutable std::vector<ClassSums> sums_;
    mutable std::vector<Group> groups_;
};

}  // namespace mfar::enlarge
