#include "pipeline/enlarge/class_sums.h"

#include <algorithm>
#include <cmath>

namespace mfar::enlarge {
namespace {

template <class Classes>
UniqueClass uniqueOf(int number, int first) {
    const Symmetry same = Symmetry::of(number / Classes::kKinds, Classes::kAngles);
    return {first + same.unique * Classes::kKinds + number % Classes::kKinds, same};
}

}  // namespace

UniqueClass uniqueByGradient(int number) {
    return uniqueOf<GradientClasses>(number, 0);
}

UniqueClass uniqueByCurvature(int number) {
    return uniqueOf<CurvatureClasses>(number, kUniqueGradient);
}

FilterBank::Filter roundedFilter(const ClassWeights& weights) {
    FilterBank::Filter out;
    for (int tap = 0; tap < kTaps; ++tap)
        for (int phase = 0; phase < kPhases; ++phase) {
            const double value = std::round(weights(tap, phase) * kWeightScale / 2);
            out[filterIndex(tap, phase)] =
                static_cast<std::int16_t>(std::clamp(value, -32767.0, 32767.0));
        }
    return out;
}

ClassWeights weightsOf(const FilterBank::Filter& filter) {
    ClassWeights out;
    for (int tap = 0; tap < kTaps; ++tap)
        for (int phase = 0; phase < kPhases; ++phase)
            out(tap, phase) = 2.0 * filter[filterIndex(tap, phase)] / kWeightScale;
    return out;
}

void ClassSums::add(const Taps& steps, const Phases& target) {
    taps.noalias() += steps * steps.transpose();
    products.noalias() += steps * target.transpose();
    squares += target.squaredNorm();
    ++pixels;
}

void ClassSums::add(const ClassSums& other) {
    taps += other.taps;
    products += other.products;
    squares += other.squares;
    pixels += other.pixels;
}

void ClassSums::fade(double share) {
    taps *= share;
    products *= share;
    squares *= share;
    pixels *= share;
}

ClassSums ClassSums::turnedToo() const {
    ClassSums out = *this;
    const auto turned = [](int tap) {
        const Offset at = kTapAt[static_cast<std::size_t>(tap)];
        return tapAt({-at.x, -at.y});
    };
    for (int i = 0; i < kTaps; ++i) {
        for (int j = 0; j < kTaps; ++j)
            out.taps(i, j) += taps(turned(i), turned(j));
        for (int j = 0; j < kPhases; ++j)
            out.products(i, j) += products(turned(i), kPhases - 1 - j);
    }
    out.squares *= 2;
    return out;
}

double ClassSums::errorOf(const ClassWeights& weights) const {
    return squares - 2 * weights.cwiseProduct(products).sum() +
           weights.cwiseProduct(taps * weights).sum();
}

SumsOfClasses::SumsOfClasses() : sums_(kUnique), groups_(kUnique) {}

void SumsOfClasses::add(const UniqueClass& to, const Taps& steps, const Phases& target) {
    Group& group = groups_[static_cast<std::size_t>(to.number)];
    for (int i = 0; i < kTaps; ++i)
        group.steps(to.same.tap(i), group.size) = steps[i];
    for (int i = 0; i < kPhases; ++i)
        group.targets(to.same.phase(i), group.size) = target[i];
    if (++group.size == kGroup) finish(to.number);
}

void SumsOfClasses::finish(int unique) const {
    Group& group = groups_[static_cast<std::size_t>(unique)];
    if (group.size == 0) return;
    ClassSums& sums = sums_[static_cast<std::size_t>(unique)];
    const auto steps = group.steps.leftCols(group.size);
    const auto targets = group.targets.leftCols(group.size);
    sums.taps.noalias() += steps * steps.transpose();
    sums.products.noalias() += steps * targets.transpose();
    sums.squares += targets.squaredNorm();
    sums.pixels += group.size;
    group.size = 0;
}

const ClassSums& SumsOfClasses::operator[](int unique) const {
    finish(unique);
    return sums_[static_cast<std::size_t>(unique)];
}

ClassSums& SumsOfClasses::edit(int unique) {
    finish(unique);
    return sums_[static_cast<std::size_t>(unique)];
}

void SumsOfClasses::fade(double share) {
    for (int i = 0; i < kUnique; ++i)
        edit(i).fade(share);
}

void SumsOfClasses::add(const SumsOfClasses& other) {
    for (int i = 0; i < kUnique; ++i)
        edit(i).add(other[i]);
}

}  // namespace mfar::enlarge
