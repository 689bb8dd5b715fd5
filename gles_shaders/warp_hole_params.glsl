// What the passes over the holes of a warp share; mirrors HoleFiller::Params.
layout(std140, binding = 0) uniform Params {
    ivec4 bounds;     // pixels x0 <= x < x1, y0 <= y < y1
    ivec4 layer;      // width [px], 1 = holes beyond cracks are filled, level this pass makes, levels
    ivec4 levels[6];  // of the pyramid from 1 on: its first texel, columns, origin (x, y) in texels of the level
    ivec4 rows;       // of the level this pass makes and of the one below, -, -
};
const int kCrackLevels = 2;
