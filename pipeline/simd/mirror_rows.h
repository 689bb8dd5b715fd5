#pragma once

#include "base/light_word.h"
#include "base/mirror_light.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar::simd {

/// MirrorLight prepared for lanes.
struct MirrorInput {
    const std::uint32_t* texels;
    const std::int32_t* tables;   ///< two words each: first texel, edge
    const std::int32_t* tableOf;  ///< by a byte of roughness: the sharper of two tables
    const float* shareOf;         ///< and the weight of the other
    const float* alphaOf;         ///< and the width of the lobe, at least the sun's
    float sun[3], irradiance[3];
    float least, exposure;
    float axes[3][3];  ///< columns: camera axes in the world
    float eye[3];      ///< from the reference's eye to the eye that sees the light [m]
};

/// Pixels of a reference picture.
struct MirrorRow {
    int count;
    const std::uint32_t* packed;  ///< surfaces, see WarpReference::packed
    const GlossWords* gloss;
    const float *rayX, *rayY;  ///< normalised
};

/// Specular light of a pixel: the share of the mirrored sky that objects let through, and other
/// light, both light words. Their free bits hold the share of the sun.
struct MirrorParts {
    std::uint32_t share = 0, rest = 0;
};

// Both skip pixels without gloss. Surfaces, gloss, rays and parts need 7 entries to spare; none are
// written.
/// Splits specular light, seen from the reference's eye.
void splitMirrored(const MirrorRow& row, const MirrorInput& input, const LightWords* light,
                   MirrorParts* out);
/// Puts the parts together again for another eye; keeps the light's veil.
void joinMirrored(const MirrorRow& row, const MirrorInput& input, const MirrorParts* parts,
                  LightWords* light);

}  // namespace mfar::simd
