// The still's luma between pixels, in single precision: filters of textures may have 8 bits.

// `uv`: the place, as for a texture's filter.
float linearly(sampler2D still, vec2 uv) {
    vec2 size = vec2(textureSize(still, 0)), p = uv * size;
    vec2 corner = floor(p + 0.5), t = p + 0.5 - corner;  // of the four pixels around
    vec4 four = textureGather(still, corner / size);
    vec2 columns = mix(four.wz, four.xy, t.y);
    return mix(columns.x, columns.y, t.x);
}
