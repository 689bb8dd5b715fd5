#include "tests/eval/warp.h"
#include "tests/eval/warp_scenes.h"

// Where there is no Embree, there is no path tracer.
namespace mfar::eval {

std::vector<std::string> warpSceneNames() {
    return {"still-life", "showpiece"};
}

Report evaluateWarp(const WarpRequest& /*request*/) {
    throw EvalError("this program was built without a path tracer");
}

}  // namespace mfar::eval
