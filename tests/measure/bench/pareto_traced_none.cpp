#include "tests/measure/bench/pareto_stages.h"
#include "tests/measure/eval/report.h"

// Used instead of pareto_traced.cpp if Embree, and thus the path tracer, is missing.
namespace mfar::bench {

ParetoStage warpStage(bool /*quick*/) {
    throw eval::EvalError("--stages: warp needs the path tracer, but this program was built "
                          "without it (Debian: libembree-dev)");
}

ParetoStage slicingStage(bool /*quick*/) {
    throw eval::EvalError("--stages: slicing needs the path tracer, but this program was built "
                          "without it (Debian: libembree-dev)");
}

}  // namespace mfar::bench
