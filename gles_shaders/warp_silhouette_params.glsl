// Parameters of one mesh of the virtual scene.
#include "pipeline/warp/pass_params.h"

layout(std140, binding = 0) uniform Params {
    SilhouetteMesh params;
};
