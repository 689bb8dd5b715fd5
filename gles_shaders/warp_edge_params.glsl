// Parameters of the shaders that sharpen the layer while the camera rests (warp_edges.comp,
// warp_sharpen.comp).
#include "pipeline/warp/pass_params.h"

layout(std140, binding = 0) uniform Params {
    RefineEdges params;
};

ivec2 firstPixel() {
    return ivec2(params.bounds.x0, params.bounds.y0);
}
ivec2 endPixel() {
    return ivec2(params.bounds.x1, params.bounds.y1);
}
