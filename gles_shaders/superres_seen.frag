// Where the video is enlarged by filters and not sharpened: luma that each video pixel shows of the still.
// In: look-ups, raised luma of the still. Out: luma [1/64 grey level].
#include "tile_params.glsl"
#include "still_seen.glsl"
#include "pipeline/engine/params/enlarge.h"

layout(location = 0) out ivec4 seen;

void main() {
    seen = ivec4(255.0 * float(kPassScale) * stillSeen() + 0.5);
}
