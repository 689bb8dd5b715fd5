// Functions on the four quarters of a pixel. The quarters are packed surfaces in the order of
// textureGather(). Needs warp_surface.glsl.

// Returns the number of the object that covers the most quarters, or 0 without an object.
uint mostOf(uvec4 s) {
    uint id = 0u;
    int most = 0;
    for (int i = 0; i < 4; ++i) {
        uint own = surfaceId(s[i]);
        ivec4 same = ivec4(equal(s & 0xffu, uvec4(own)));
        int count = same.x + same.y + same.z + same.w;
        bool more = own != 0u && own != kCatcher && count > most;
        most = more ? count : most;
        id = more ? own : id;
    }
    return id;
}

// Returns the centre of the quarters that show surface `id`: offset from the pixel's centre [px],
// and z [m]. z is 0 if no quarter shows the surface.
vec3 middleOf(uvec4 s, uint id) {
    vec4 own = vec4(equal(s & 0xffu, uvec4(id)));
    float count = dot(own, vec4(1.0));
    vec4 z = uintBitsToFloat(s & 0xffffff00u);
    vec2 sum = vec2(dot(own, vec4(-0.25, 0.25, 0.25, -0.25)), dot(own, vec4(0.25, 0.25, -0.25, -0.25)));
    return count > 0.0 && id != 0u ? vec3(sum, dot(own, z)) / count : vec3(0.0);
}
