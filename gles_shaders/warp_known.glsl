// Looks up the colours of surfaces in the traced picture and in re-rendered pictures. Needs
// warp_view_params.glsl, warp_view.glsl and warp_surface.glsl.
#include "warp_light.glsl"

layout(binding = 2) uniform sampler2D colours;
// WarpSurface: z [m], surface number, tolerance of z [m], 1 if known.
layout(binding = 3) uniform sampler2D surfaces;
layout(binding = 4) uniform sampler2D rerenderedColours;
layout(binding = 5) uniform sampler2D rerenderedSurfaces;
layout(binding = 7) uniform sampler2D diffusePaint;  // at twice the layer's resolution
layout(binding = 8) uniform sampler2D facingPaint;
layout(binding = 9) uniform sampler2D diffuseLight;  // see struct Light
layout(binding = 10) uniform sampler2D specularLight;
layout(binding = 11) uniform usampler2D rerenderedLights;  // LightWords

// Returns the mean paint of the quarters of pixel `p` that show the object `id`. `s`: the quarters
// in the order of textureGather().
Paint paintAt(ivec2 p, uvec4 s, uint id) {
    Paint sum = Paint(vec3(0.0), vec3(0.0));
    float count = 0.0;
    for (int i = 0; i < 4; ++i) {
        if (surfaceId(s[i]) != id) continue;
        ivec2 quarter = 2 * p + ivec2(i == 1 || i == 2, i < 2);
        sum.diffuse += texelFetch(diffusePaint, quarter, 0).rgb;
        sum.facing += texelFetch(facingPaint, quarter, 0).rgb;
        count += 1.0;
    }
    return Paint(sum.diffuse / max(count, 1.0), sum.facing / max(count, 1.0));
}

Light lightAt(bool ofTraced, ivec2 t) {
    if (ofTraced) return Light(texelFetch(diffuseLight, t, 0), texelFetch(specularLight, t, 0));
    return unpackWords(texelFetch(rerenderedLights, t, 0).rg);
}

// Interpolates the colour of surface `id` bilinearly at `at` (pixel, z). Of the four texels, only
// those that show this surface at this z are used. The rows of the picture begin at `firstRow`.
// `found` becomes the premultiplied colour. Returns the sum of the weights, or 0 if it is not above
// kLeastLookUpWeight. If `id` is the shadow catcher, a texel that shows no surface counts as a part
// of the catcher without shadow.
// The loop's length is a parameter, because compilers would unroll a loop of known length, and V3D
// and Mali would then spill registers.
float lookUp(bool ofTraced, int firstRow, vec3 at, float id, Paint paint, out vec4 found) {
    vec2 low = floor(at.xy), f = at.xy - low;
    ivec2 size = ofTraced ? tracedSize() : layerSize();
    bool isLit = (ofTraced ? params.tracedIsLit : params.rerenderedIsLit) != 0 && id != float(kCatcher);
    // Without light, the sum of the colours is in `light.diffuse`, which saves registers.
    Light light = Light(vec4(0.0), vec4(0.0));
    float weights = 0.0;
    for (int i = 0; i < params.texels; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        ivec2 t = ivec2(low) + side;
        bool within = at.z > 0.0 && all(greaterThanEqual(t, ivec2(0))) && all(lessThan(t, size));
        t = clamp(t, ivec2(0), size - 1) + ivec2(0, firstRow);
        vec4 s = ofTraced ? texelFetch(surfaces, t, 0) : texelFetch(rerenderedSurfaces, t, 0);
        bool same = s.y == id ? abs(s.x - at.z) < s.z : s.y == 0.0 && id == float(kCatcher);
        vec2 near = mix(1.0 - f, f, vec2(side));
        float w = within && same && s.w > 0.5 ? near.x * near.y : 0.0;
        weights += w;
        if (isLit) {
            Light own = lightAt(ofTraced, t);
            light.diffuse += w * own.diffuse;
            light.specular += w * own.specular;
        } else {
            light.diffuse += w * (ofTraced ? texelFetch(colours, t, 0) : texelFetch(rerenderedColours, t, 0));
        }
    }
    float scale = 1.0 / max(weights, 1e-6);
    light = Light(scale * light.diffuse, scale * light.specular);
    found = isLit ? litColour(paint, light) : light.diffuse;
    return weights > kLeastLookUpWeight ? weights : 0.0;
}

// Looks up the colour of surface `id` at `point` in the traced picture. If the traced picture does
// not show the point and the surface is an object, looks it up in the re-rendered pictures. `found`
// becomes the premultiplied colour. `paint` is used for objects only. Returns the share of the
// colour that is known, [0, 1].
float known(vec3 point, float id, Paint paint, out vec4 found) {
    vec3 at = inView(0, uint(id), point);
    if (lookUp(true, 0, at, id, paint, found) > 0.0) return 1.0;
    // Outside the traced picture, the shadow catcher's colour is unknown. It nevertheless counts as
    // known and transparent, so that it is not filled.
    found = vec4(0.0);
    if (id == float(kCatcher)) return at.z > 0.0 ? 0.0 : 1.0;
    // Re-rendered pictures fade in: their shares grow from 0 to 1. Of those that show the point,
    // the one with the largest share determines the colour.
    float share_ = 0.0;
    for (int i = 0; i < params.rerendered; ++i) {
        vec4 own;
        at = inView(i + 1, uint(id), point);
        if (params.views[i + 1].share <= share_ || lookUp(false, i * params.height, at, id, paint, own) == 0.0) continue;
        share_ = params.views[i + 1].share;
        found = own;
    }
    return share_;
}
