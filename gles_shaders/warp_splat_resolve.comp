// The depth that was splatted, as pictures. In: nearest[] of warp_splat.comp. Out: z [m] of the objects, of the
// catcher, 0 = nothing.
// Range: objects 0..1e6
// Range: catcher 0..1e6
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = 0) uniform Params {
    ivec4 bounds;  // pixels x0 <= x < x1, y0 <= y < y1
    ivec4 sizes;   // width, height of the layer, -, -
};
layout(std430, binding = 0) readonly buffer Nearest {
    uint nearest[];
};
layout(binding = 0, r32f) writeonly uniform image2D objects;
layout(binding = 1, r32f) writeonly uniform image2D catcher;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy) + bounds.xy;
    if (any(greaterThanEqual(p, bounds.zw))) return;
    int i = p.y * sizes.x + p.x;
    float z = uintBitsToFloat(nearest[i]), below = uintBitsToFloat(nearest[sizes.x * sizes.y + i]);
    imageStore(objects, p, vec4(z < 1e6 ? z : 0.0));
    imageStore(catcher, p, vec4(below < 1e6 ? below : 0.0));
}
