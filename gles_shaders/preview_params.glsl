// Parameters for drawing one virtual object in the preview (preview.vert, preview.frag).
#include "pipeline/composite/pass_params.h"

layout(std140, binding = 0) uniform Params {
    PreviewObject params;
};
