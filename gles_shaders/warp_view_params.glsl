// Parameters of the shaders that look up warped pixels (warp_look_up.frag, warp_rest_list.comp,
// warp_rest.comp).
#include "pipeline/warp/pass_params.h"

layout(std140, binding = 0) uniform Params {
    LookUpViews params;
};

ivec2 tracedSize() {
    return ivec2(params.tracedWidth, params.tracedHeight);
}
ivec2 layerSize() {
    return ivec2(params.width, params.height);
}

// Returns z [m] at which a ray meets the shadow catcher's plane, or 0 if the plane is not visible
// along the ray.
float planeDepth(vec2 ray) {
    float facing = dot(vec3(params.plane.x, params.plane.y, params.plane.z), vec3(ray, 1.0));
    float z = params.plane.offset / (facing == 0.0 ? 1.0 : facing);
    return z > params.projections[1].nearPlane && z < 1e6 ? z : 0.0;
}
