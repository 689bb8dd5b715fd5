// Second pass of the warp for simple pixels. A pixel is simple if one surface fills it, and if the
// four texels around the looked-up position in the traced picture show this surface at the same
// depth. The shadow catcher is simple also where these texels show no surface. If it is a plane, it
// is simple wherever each of the texels shows the catcher or no surface: no depths are compared,
// because all points of a plane belong to the same surface. All other pixels with a surface are
// left to warp_rest.comp. An object's colour is its paint in the traced light, or the traced colour
// if the picture has no light.
// In: silhouette and paint at twice the layer's resolution; the traced picture.
// Out: colour, RGBA8 premultiplied; z [m], 0 if the colour is empty; state = (0, 1 if the pixel is
// left to warp_rest.comp, 0, number of the surface that fills a simple pixel).
// Source: eq. 5 of the paper (docs/paper.md).
// Range: depth 0..1e6
// Variant: #define MOVING
#include "warp_view_params.glsl"
#include "warp_view.glsl"
#include "warp_surface.glsl"
#include "warp_light.glsl"

layout(binding = 0) uniform usampler2D silhouette;
layout(binding = 1) uniform sampler2D rays;
layout(binding = 2) uniform sampler2D colours;
layout(binding = 3) uniform usampler2D surfaces;  // packed by packSurface(); number 254: unknown
layout(binding = 7) uniform sampler2D diffusePaint;
layout(binding = 8) uniform sampler2D facingPaint;
layout(binding = 9) uniform sampler2D diffuseLight;  // see struct Light
layout(binding = 10) uniform sampler2D specularLight;
layout(location = 0) out vec4 colour;
layout(location = 1) out float depth;
layout(location = 2) out vec4 state;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec2 ray = texelFetch(rays, p, 0).rg;
    uvec4 s = textureGather(silhouette, gl_FragCoord.xy / vec2(layerSize()));
    uint id = surfaceId(s.x);
    bool whole = all(equal(s & 0xffu, uvec4(id)));
    float z = 0.25 * dot(uintBitsToFloat(s & 0xffffff00u), vec4(1.0));
    bool open = whole && id == 0u;
    z = open ? planeDepth(ray) : z;
    id = open ? kCatcher : id;
    bool empty = open && z == 0.0;
    vec3 at = inView(0, id, z * vec3(ray, 1.0));
    // The corner at which the four texels meet. The gather samples exactly there, so that rounding
    // in the texture unit cannot select other texels.
    vec2 corner = floor(at.xy) + 1.0;
    uvec4 t = textureGather(surfaces, corner / vec2(tracedSize()));
    vec4 off = abs(uintBitsToFloat(t & 0xffffff00u) - at.z);
    bool same = all(equal(t & 0xffu, uvec4(id))) && all(lessThan(off, vec4(kSameDepth * at.z)));
    uint plane = params.plane.offset != 0.0 ? kCatcher : 0u;
    uvec4 others = mix(t, uvec4(0u), equal(t & 0xffu, uvec4(plane)));
    bool bare = id == kCatcher && all(equal(others, uvec4(0u)));
    bool inner = all(greaterThan(corner, vec2(0.0))) && all(lessThan(corner, vec2(tracedSize())));
    bool plain = whole && !empty && at.z > 0.0 && inner && (same || bare);
    vec2 texel = (at.xy + 0.5) / vec2(tracedSize());
    vec4 found = textureLod(colours, texel, 0.0);
    if (params.tracedIsLit != 0 && id != kCatcher) {
        vec2 here = gl_FragCoord.xy / vec2(layerSize());
        Paint paint = Paint(textureLod(diffusePaint, here, 0.0).rgb, textureLod(facingPaint, here, 0.0).rgb);
        found = litColour(paint, Light(textureLod(diffuseLight, texel, 0.0), textureLod(specularLight, texel, 0.0)));
    }
    colour = plain ? found : vec4(0.0);
    depth = plain && isShown(found) ? (id == kCatcher ? (1.0 - kShadowLift) * z : z) : 0.0;
    state = empty ? vec4(0.0) : plain ? vec4(0.0, 0.0, 0.0, float(id) / 255.0) : vec4(0.0, 1.0, 0.0, 0.0);
}
