// Parameters of the shaders that fill a warped picture's pixels without a known colour
// (warp_pull.comp, warp_fill.comp).
#include "pipeline/warp/pass_params.h"

layout(std140, binding = 0) uniform Params {
    FillHoles params;
};

ivec2 firstPixel() {
    return ivec2(params.bounds.x0, params.bounds.y0);
}
ivec2 endPixel() {
    return ivec2(params.bounds.x1, params.bounds.y1);
}
ivec2 originOf(HoleLevel level) {
    return ivec2(level.originX, level.originY);
}
