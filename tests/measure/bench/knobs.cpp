#include "tests/measure/bench/knobs.h"

#include <utility>

namespace mfar::bench {
namespace {

template <class Options, class Value>
Knob knob(const char* method, const char* name, Options PipelineOptions::* of,
          Value Options::* member, std::vector<double> values) {
    return {method, name, std::move(values),
            [=](const PipelineOptions& o) { return static_cast<double>(o.*of.*member); },
            [=](PipelineOptions& o, double v) { o.*of.*member = static_cast<Value>(v); }};
}

}  // namespace

std::vector<Knob> flowKnobs() {
    const auto flow2d = [](const char* name, int Flow2dOptions::* member,
                           std::vector<double> values) {
        return knob("flow2d", name, &PipelineOptions::flow2d, member, std::move(values));
    };
    const auto epipolar = [](const char* name, auto EpipolarOptions::* member,
                             std::vector<double> values) {
        return knob("epipolar", name, &PipelineOptions::epipolar, member, std::move(values));
    };
    return {
        flow2d("levels", &Flow2dOptions::levels, {3, 4, 6}),
        flow2d("searchRadius", &Flow2dOptions::searchRadius, {2, 5, 10, 20}),
        flow2d("candidates", &Flow2dOptions::candidates, {1, 2, 4}),
        flow2d("steps", &Flow2dOptions::steps, {1, 2, 4, 8}),
        flow2d("propagations", &Flow2dOptions::propagations, {0, 1, 2, 4}),
        flow2d("coarsestPropagations", &Flow2dOptions::coarsestPropagations, {0, 2, 4, 8}),
        flow2d("planeFits", &Flow2dOptions::planeFits, {0, 1, 2}),
        epipolar("levels", &EpipolarOptions::levels, {1, 2, 3, 4}),
        epipolar("longestParallax", &EpipolarOptions::longestParallax, {0.1, 0.2, 0.4, 0.8}),
        epipolar("windowRadius", &EpipolarOptions::windowRadius, {0, 1, 2, 4}),
        epipolar("stepPenalty", &EpipolarOptions::stepPenalty, {4, 8, 12, 20, 30}),
        epipolar("jumpPenalty", &EpipolarOptions::jumpPenalty, {15, 30, 45, 60}),
    };
}

}  // namespace mfar::bench
