// What is sharpened in a picture at rest; mirrors EdgeRefiner's Params.
layout(std140, binding = 0) uniform Params {
    ivec4 bounds;  // pixels x0 <= x < x1, y0 <= y < y1
    ivec4 limits;  // width of the layer, pixels to show, least level of contrast, most pixels to list
    vec4 share;    // of what was rendered in what is shown, of the objects' pixels that are listed, -, -
};
