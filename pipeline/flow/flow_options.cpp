#include "pipeline/flow/flow_options.h"

#include <stdexcept>
#include <string>

namespace mfar {
namespace {

void require(bool holds, const char* option, const char* range) {
    if (!holds) throw std::invalid_argument(std::string(option) + " must be in " + range);
}

bool isWithin(int value, int least, int most) {
    return value >= least && value <= most;
}

}  // namespace

void validate(const Flow2dOptions& o) {
    require(isWithin(o.levels, 1, 6), "levels of the 2-D flow", "[1, 6]");
    require(isWithin(o.searchRadius, 0, 40), "searchRadius", "[0, 40]");
    require(isWithin(o.candidates, 1, 4), "candidates", "[1, 4]");
    require(isWithin(o.steps, 0, 16), "steps", "[0, 16]");
    require(isWithin(o.propagations, 0, 8), "propagations", "[0, 8]");
    require(isWithin(o.coarsestPropagations, 0, 8), "coarsestPropagations", "[0, 8]");
    require(isWithin(o.planeFits, 0, 2), "planeFits", "[0, 2]");
}

void validate(const EpipolarOptions& o) {
    require(isWithin(o.levels, 1, 4), "levels of the epipolar search", "[1, 4]");
    require(o.longestParallax > 0 && o.longestParallax <= 1, "longestParallax", "(0, 1]");
    require(isWithin(o.windowRadius, 0, 8), "windowRadius", "[0, 8]");
    require(isWithin(o.stepPenalty, 1, 30), "stepPenalty", "[1, 30]");
    require(isWithin(o.jumpPenalty, 1, 60), "jumpPenalty", "[1, 60]");
    require(isWithin(o.finest, 0, 2), "finest", "[0, 2]");
    require(isWithin(o.mostPredicted, 0, 60), "mostPredicted", "[0, 60]");
}

Flow2dOptions changed(const Flow2dOptions& now, const Flow2dOptions& wanted) {
    Flow2dOptions out = validated(wanted);
    out.levels = now.levels;
    return out;
}

EpipolarOptions changed(const EpipolarOptions& now, const EpipolarOptions& wanted) {
    EpipolarOptions out = validated(wanted);
    out.levels = now.levels;
    out.longestParallax = now.longestParallax;
    return out;
}

}  // namespace mfar
