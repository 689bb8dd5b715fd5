// Unpacks the light on objects (LightWords of base/light_word.h), and computes the colour of
// objects in this light.

vec3 unpackLight(uint word) {
    // 127 is the bias of a float's exponent; 15 and 8 are kLightBias and kLightBits.
    float scale = uintBitsToFloat(((word >> 24) & 31u) + (127u - 15u - 8u) << 23);
    return scale * vec3(word & 255u, (word >> 8) & 255u, (word >> 16) & 255u);
}

// Alpha of `specular`: UnpackedLight::veil, the share of the specular light that does not depend on
// the surface's colour. Alpha of `diffuse`: 1.
struct Light {
    vec4 diffuse, specular;
};

Light unpackWords(uvec2 words) {
    float veil = float((words.x >> 29) << 3 | words.y >> 29) / 63.0;
    return Light(vec4(unpackLight(words.x), 1.0), vec4(unpackLight(words.y), veil));
}

struct Paint {
    vec3 diffuse, facing;  // linear, see base/paint_words.h
};

// Returns the colour of an opaque object [sRGB].
vec4 litColour(Paint paint, Light light) {
    vec3 mirrored = mix(paint.facing, vec3(1.0), light.specular.a) * light.specular.rgb;
    vec3 sent = clamp(paint.diffuse * light.diffuse.rgb + mirrored, 0.0, 1.0);
    vec3 encoded = 1.055 * pow(sent, vec3(1.0 / 2.4)) - 0.055;
    return vec4(mix(encoded, 12.92 * sent, lessThan(sent, vec3(0.0031308))), 1.0);
}
