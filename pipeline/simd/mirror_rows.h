#pragma once

#include "base/light_word.h"
#include "base/mirror_light.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar::simd {

struct MirrorInput {
    const std::uint32_t* texels;
    /// Two values for each MirrorLight::Table: index of its first texel, and texels per side.
    const std::int32_t* tables;
    /// Light is interpolated between the tables with the indices tableOf[r] and tableOf[r] + 1,
    /// where r is the roughness as a byte. shareOf[r] is the weight of the second table.
    const std::int32_t* tableOf;
    const float* shareOf;
    /// GGX parameter alpha for each roughness (a byte), at least MirrorLight::leastSunAlpha.
    const float* alphaOf;
    float sun[3], irradiance[3];  ///< MirrorLight::towardsSun and sunIrradiance
    float least, exposure;        ///< MirrorLight::least and TracedPicture::exposure
    float axes[3][3];             ///< the camera's x, y and z axis in the world
    /// Vector from the traced picture's camera to the eye that sees the light, in the world [m].
    float eye[3];
};

struct MirrorRow {
    int count;
    const std::uint32_t* packed;  ///< surfaces, see TracedPicture::packed
    const GlossWords* gloss;
    const float *rayX, *rayY;  ///< rays (x, y, 1) through the pixels
};

/// The specular light of a pixel, split into parts. `share`: share of the mirrored sky that no
/// object hides, for each colour channel. `rest`: the specular light that exceeds the light
/// mirrored from sky and sun. Both are light words (base/light_word.h). Their free bits store the
/// share of the sun that no object hides.
struct MirrorParts {
    std::uint32_t share = 0, rest = 0;
};

// splitMirrored() and joinMirrored() skip pixels without gloss. The arrays of surfaces, gloss, rays
// and parts must have 7 more entries than the row has pixels. These 7 entries are never written.
/// Splits the specular light in `light`, as the traced picture's camera sees it, into MirrorParts.
void splitMirrored(const MirrorRow& row, const MirrorInput& input, const LightWords* light,
                   MirrorParts* out);
/// Writes the specular light that an eye at `input.eye` sees, computed from `parts`, into `light`.
/// The light's veil stays unchanged (see UnpackedLight).
void joinMirrored(const MirrorRow& row, const MirrorInput& input, const MirrorParts* parts,
                  LightWords* light);

}  // namespace mfar::simd
