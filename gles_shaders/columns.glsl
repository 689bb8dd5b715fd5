// Reads the picture that superres_vertical.frag (variant without LEARNED) enlarged along columns.
layout(binding = 0) uniform sampler2D columns;

vec4 columnAt(ivec2 p) {
    return texelFetch(columns, p, 0);
}
