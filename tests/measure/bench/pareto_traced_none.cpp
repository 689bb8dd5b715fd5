#include "tests/measure/bench/pareto_stages.h"
#include "tests/measure/eval/report.h"

// Used instead of pareto_traced.cpp if Embree, and thus the path tracer, is missing.
namespace mfar::bench {

ParetoStage warpStage(bool /*quick*/) {
    throw eval::EvalError("this program was built without a path tracer");
}

ParetoStage slicingStage(bool /*quick*/) {
    throw eval::EvalError("this program was built without a path tracer");
}

}  // namespace mfar::bench
