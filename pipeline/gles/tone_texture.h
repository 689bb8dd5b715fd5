#pragma once

#include "base/gl/texture.h"
#include "pipeline/enlarge/still_tone.h"

namespace mfar {

/// A tone curve as a texture, see still_tone.glsl.
class ToneTexture {
public:
    explicit ToneTexture(const StillTone& tone = {})
        : texture_({StillTone::kLevels, 1}, gpu::TexelFormat::R8, gpu::Filter::Linear) {
        set(tone);
    }

    void set(const StillTone& tone) {
        tone_ = tone;
        texture_.upload({tone_.levels.data(), StillTone::kLevels});
    }
    [[nodiscard]] const gpu::Texture& texture() const { return texture_; }
    [[nodiscard]] const StillTone& tone() const { return tone_; }

private:
    StillTone tone_;
    gpu::Texture texture_;
};

}  // namespace mfar
