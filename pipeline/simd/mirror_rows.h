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
    /// Two words per table: index of the table's first texel, and texels per side.
    const std::int32_t* tables;
    /// For each roughness, as a byte, light is interpolated between two tables. tableOf: index of
    /// the sharper table. shareOf: weight of the less sharp table.
    const std::int32_t* tableOf;
    const float* shareOf;
    /// For each roughness, as a byte: width of the reflection lobe, at least the sun's width.
    const float* alphaOf;
    float sun[3], irradiance[3];
    float least, exposure;
    float axes[3][3];  ///< columns: camera axes in the world
    /// Vector in the world from the traced picture's camera to the eye that sees the light [m].
    float eye[3];
};

/// A row of pixels of a traced picture.
struct MirrorRow {
    int count;
    const std::uint32_t* packed;  ///< surfaces, see TracedPicture::packed
    const GlossWords* gloss;
    const float *rayX, *rayY;  ///< normalised rays of the pixels
};

/// The specular light of a pixel in two light words. `share` is the share of the mirrored sky that
/// no object hides; `rest` is the remaining specular light. The free bits of the two words have the
/// share of the sun that no object hides.
struct MirrorParts {
    std::uint32_t share = 0, rest = 0;
};

// splitMirrored() and joinMirrored() skip pixels without gloss. The arrays of surfaces, gloss, rays
// and parts must have 7 entries more than the row has pixels; these are read but not written.
/// Splits the specular light that the traced picture's camera sees into its parts.
void splitMirrored(const MirrorRow& row, const MirrorInput& input, const LightWords* light,
                   MirrorParts* out);
/// Computes from the parts the specular light that another eye sees. Does not change the veil of
/// `light`.
void joinMirrored(const MirrorRow& row, const MirrorInput& input, const MirrorParts* parts,
                  LightWords* light);

}  // namespace mfar::simd
