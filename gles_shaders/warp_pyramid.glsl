// The pyramid of push-pull filling (Gortler et al. 1996, section 3.5). The colours of objects and
// of the shadow catcher are stored separately, so that they do not mix. Needs
// warp_hole_params.glsl.

// A texel of the pyramid. It stands for an area of the picture. `object`: colour of the object that
// covers most of the area. `id`: number of this object. `catcher`: colour of the shadow catcher.
// `weights`: weights [0, 1] of both colours. Colours are premultiplied.
struct Area {
    vec4 object, catcher;
    uint id;
    vec2 weights;
};

Area unpackArea(uvec4 texel) {
    return Area(unpackUnorm4x8(texel.x), unpackUnorm4x8(texel.y), texel.z, unpackUnorm4x8(texel.w).xy);
}
uvec4 packArea(Area a) {
    return uvec4(packUnorm4x8(a.object), packUnorm4x8(a.catcher), a.id, packUnorm4x8(vec4(a.weights, 0.0, 0.0)));
}

// Merges four texels of the next finer pyramid level. An area gets the full weight if the colour of
// at least half of it is known. The texels stay packed until `best.id` is known, so that all values
// fit in the registers of a Mali.
Area merged(uvec4 parts[4]) {
    Area best = Area(vec4(0.0), vec4(0.0), 0u, vec2(0.0));
    for (int i = 0; i < 4; ++i) {
        float weight = 0.0;
        for (int j = 0; j < 4; ++j)
            if (parts[j].z == parts[i].z) weight += unpackUnorm4x8(parts[j].w).x;
        if (weight > best.weights.x) {
            best.weights.x = weight;
            best.id = parts[i].z;
        }
    }
    for (int i = 0; i < 4; ++i) {
        vec2 weights = unpackUnorm4x8(parts[i].w).xy;
        if (parts[i].z == best.id) best.object += weights.x * unpackUnorm4x8(parts[i].x);
        best.catcher += weights.y * unpackUnorm4x8(parts[i].y);
        best.weights.y += weights.y;
    }
    if (best.weights.x > 0.0) best.object /= best.weights.x;
    best.catcher /= max(best.weights.y, 1e-6);
    best.weights = min(0.5 * best.weights, vec2(1.0));
    return best;
}
