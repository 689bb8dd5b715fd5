#pragma once

#include "base/light_word.h"
#include "base/mirror_light.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar::simd {

/// MirrorLight in the form that vector code reads.
struct MirrorInput {
    const std::uint32_t* texels;
    const std::int32_t* tables;   ///< two words per table: first texel, edge
    const std::int32_t* tableOf;  ///< for each byte of roughness: the sharper of two tables
    const float* shareOf;         ///< for each byte of roughness: weight of the other table
    const float* alphaOf;  ///< for each byte of roughness: width of the lobe, at least the sun's
    float sun[3], irradiance[3];
    float least, exposure;
    float axes[3][3];  ///< columns: camera axes in the world
    float eye[3];      ///< from the reference's eye to the eye that sees the light [m]
};

/// A row of pixels of a traced picture.
struct MirrorRow {
    int count;
    const std::uint32_t* packed;  ///< surfaces, see TracedPicture::packed
    const GlossWords* gloss;
    const float *rayX, *rayY;  ///< normalised
};

/// The specular light of a pixel in two light words: the share of the mirrored sky that no object
/// hides, and all other light. Their free bits have the share of the sun.
struct MirrorParts {
    std::uint32_t share = 0, rest = 0;
};

// Both functions skip pixels without gloss. Surfaces, gloss, rays and parts need 7 more entries
// than pixels; these are read but not written.
/// Splits the specular light that the reference's eye sees.
void splitMirrored(const MirrorRow& row, const MirrorInput& input, const LightWords* light,
                   MirrorParts* out);
/// Computes the specular light that another eye sees from the parts. Does not change the veil of
/// `light`.
void joinMirrored(const MirrorRow& row, const MirrorInput& input, const MirrorParts* parts,
                  LightWords* light);

}  // namespace mfar::simd
