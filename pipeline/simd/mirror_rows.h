#pragma once

#include "base/light_word.h"
#include "base/mirror_light.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar::simd {

struct MirrorInput {
    const std::uint32_t* texels;
    /// Two words per light table: index of its first texel, and texels per side.
    const std::int32_t* tables;
    /// For each roughness (a byte), light is interpolated between two tables. tableOf: index of the
    /// sharper table. shareOf: weight of the less sharp one.
    const std::int32_t* tableOf;
    const float* shareOf;
    /// Width of the reflection lobe for each roughness (a byte), at least the sun's width.
    const float* alphaOf;
    float sun[3], irradiance[3];
    float least, exposure;
    float axes[3][3];  ///< columns: the camera's axes in the world
    /// Vector from the traced picture's camera to the eye that sees the light, in the world [m].
    float eye[3];
};

struct MirrorRow {
    int count;
    const std::uint32_t* packed;  ///< surfaces, see TracedPicture::packed
    const GlossWords* gloss;
    const float *rayX, *rayY;  ///< normalised rays of the pixels
};

/// The specular light of a pixel as two light words. `share`: share of the mirrored sky that no
/// object hides. `rest`: the remaining specular light. The free bits of the two words contain the
/// share of the sun that no object hides.
struct MirrorParts {
    std::uint32_t share = 0, rest = 0;
};

// splitMirrored() and joinMirrored() skip pixels without gloss. The arrays of surfaces, gloss, rays
// and parts must have 7 more entries than the row has pixels. These 7 entries are never written.
/// Splits the specular light that the traced picture's camera sees into its parts.
void splitMirrored(const MirrorRow& row, const MirrorInput& input, const LightWords* light,
                   MirrorParts* out);
/// Computes from `parts` the specular light that another eye sees. The veil of `light` (the share
/// of specular light that does not depend on the surface's colour) stays unchanged.
void joinMirrored(const MirrorRow& row, const MirrorInput& input, const MirrorParts* parts,
                  LightWords* light);

}  // namespace mfar::simd
