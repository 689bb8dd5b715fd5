#include "tests/measure/bench/render_bench.h"

namespace mfar::bench {

RenderFigures measureRender(bool /*quick*/) {
    return {};
}

}  // namespace mfar::bench
