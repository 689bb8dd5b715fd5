// Parameters of all shaders that draw tiles.
#include "pipeline/engine/params/detail.h"

layout(std140, binding = 0) uniform Params {
    DrawTiles params;
};

ivec2 videoSize() {
    return ivec2(params.videoWidth, params.videoHeight);
}
ivec2 cellCount() {
    return ivec2(params.cellColumns, params.cellRows);
}
