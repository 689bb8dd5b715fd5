#include "tests/measure/bench/pareto_stages.h"

namespace mfar::bench {

// The default comes first, as pointsOf() requires. The order of the others has no meaning.
std::vector<QualitySetting> qualitySettings() {
    const Flow2dOptions quick2d{.candidates = 2, .steps = 2, .planeFits = 1};
    const Flow2dOptions quickest2d{
        .searchRadius = 5, .candidates = 1, .steps = 1, .coarsestPropagations = 2, .planeFits = 0};
    std::vector<QualitySetting> out{
        {"detail", {}},
        {"blend", {.mode = SuperResMode::Blend}},
        {"off", {.mode = SuperResMode::Off}},
        {"off-linear", {.mode = SuperResMode::Off, .cubic = false}},
        {"detail-2d", {.alongLines = false}},
        {"no-filters", {.learned = false}},
        {"lines-half-no-filters", {.learned = false, .epipolar = {.finest = 1}}},
        {"lines-half", {.epipolar = {.finest = 1}}},
        {"predicted-15", {.epipolar = {.mostPredicted = 15}}},
        {"predicted-30", {.epipolar = {.mostPredicted = 30}}},
        {"no-plane-fits", {.flow2d = {.planeFits = 0}}},
        {"one-plane-fit", {.flow2d = {.planeFits = 1}}},
        {"lines-quarter", {.epipolar = {.finest = 2}}},
        {"half-of-tiles", {.detailShare = 0.5}},
        {"lines-half-tiles-70", {.epipolar = {.finest = 1}, .detailShare = 0.7}},
        {"lines-half-tiles-40", {.epipolar = {.finest = 1}, .detailShare = 0.4}},
        {"lines-quarter-tiles-70", {.epipolar = {.finest = 2}, .detailShare = 0.7}},
        {"lines-quarter-tiles-40", {.epipolar = {.finest = 2}, .detailShare = 0.4}},
        {"lines-quarter-tiles-25",
         {.flow2d = {.planeFits = 1}, .epipolar = {.finest = 2}, .detailShare = 0.25}},
        {"lines-quarter-tiles-12",
         {.flow2d = {.planeFits = 1}, .epipolar = {.finest = 2}, .detailShare = 0.12}},
        {"lines-quarter-tiles-5",
         {.flow2d = {.planeFits = 1}, .epipolar = {.finest = 2}, .detailShare = 0.05}},
        {"lines-half-15",
         {.flow2d = {.planeFits = 1}, .epipolar = {.finest = 1, .mostPredicted = 15}}},
        {"lines-half-30",
         {.flow2d = {.planeFits = 0}, .epipolar = {.finest = 1, .mostPredicted = 30}}},
        {"quick-2d", {.alongLines = false, .flow2d = quick2d}},
        {"quickest-2d", {.alongLines = false, .flow2d = quickest2d}},
        {"blend-quickest-2d",
         {.mode = SuperResMode::Blend, .alongLines = false, .flow2d = quickest2d}},
    };
    return out;
}

}  // namespace mfar::bench
