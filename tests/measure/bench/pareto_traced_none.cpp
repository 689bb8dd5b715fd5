#include "tests/measure/bench/pareto_stages.h"
#include "tests/measure/eval/report.h"

// Used without Embree: there is no path tracer.
namespace mfar::bench {

ParetoStage warpStage(bool /*quick*/) {
    throw eval::EvalError("this program was built without a path tracer");
}

ParetoStage slicingStage(bool /*quick*/) {
    throw eval::EvalError("this program was built without a path tracer");
}

}  // namespace mfar::bench
