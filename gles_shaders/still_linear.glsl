// Interpolates the still's luma linearly in single precision, because texture filters may have only
// 8 bits of precision.

float linearly(sampler2D still, vec2 uv) {
    vec2 size = vec2(textureSize(still, 0)), p = uv * size;
    // `corner` is where the four nearest pixels meet.
    vec2 corner = floor(p + 0.5), t = p + 0.5 - corner;
    vec4 four = textureGather(still, corner / size);
    vec2 columns = mix(four.wz, four.xy, t.y);
    return mix(columns.x, columns.y, t.x);
}
