// Parameters that all programs drawing tiles share; mirrors TileParams in superres/superres.h.
layout(std140, binding = 0) uniform Params {
    ivec4 video;  // width, height, cells a row, cell rows
    vec4 scale;   // video pixels per output pixel (x, y), 1 / still size (x, y)
    vec4 tune;    // strength of the sharpening, -, still px per output px (x, y)
};
