// A picture on a screen: scaled into a rectangle, black around it.
// Each pixel is the mean of the picture over its footprint, at least one pixel of the picture wide:
// an area filter where the picture shrinks (nothing aliases), linear interpolation where it grows, a
// copy at equal size. Two neighbours are fetched at once, weighted by where between them is sampled;
// so the sampler must be linear and clamp to the edge. Values are averaged as they are stored.

layout(std140) uniform Params {
    ivec4 target;         // x, y, width, height of the rectangle [px of the screen]
    vec4 scaleFootprint;  // pixels of the picture per pixel of the screen; footprint [px of the picture]
    ivec4 source;         // width, height [px]; 1: write blue first; unused
};
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 colour;

// Length of the part of [lo, hi] in the texels `first` and `first + 1`.
vec2 overlap(float first, float lo, float hi) {
    vec2 begin = vec2(first, first + 1.0);
    return max(min(vec2(hi), begin + 1.0) - max(vec2(lo), begin), 0.0);
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy) - target.xy;
    colour = vec4(0.0, 0.0, 0.0, 1.0);
    if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, target.zw))) return;

    vec2 centre = (vec2(p) + 0.5) * scaleFootprint.xy;
    vec2 lo = centre - 0.5 * scaleFootprint.zw, hi = lo + scaleFootprint.zw;
    vec3 sum = vec3(0.0);
    for (float y = floor(lo.y); y < hi.y; y += 2.0) {
        vec2 wy = overlap(y, lo.y, hi.y);
        float weightY = wy.x + wy.y;
        for (float x = floor(lo.x); x < hi.x; x += 2.0) {
            vec2 wx = overlap(x, lo.x, hi.x);
            float weightX = wx.x + wx.y;
            vec2 at = vec2(x + wx.y / weightX, y + wy.y / weightY) + 0.5;
            sum += weightX * weightY * textureLod(picture, at / vec2(source.xy), 0.0).rgb;
        }
    }
    sum /= scaleFootprint.z * scaleFootprint.w;
    colour.rgb = source.z == 1 ? sum.bgr : sum;
}
