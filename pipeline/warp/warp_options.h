#pragma once

namespace mfar {

/// What is done about pixels of a model that no picture shows. Cracks a pixel wide are always
/// closed.
enum class HoleFilling {
    None,      ///< they show nothing
    PushPull,  ///< filled from their surroundings
    Rerender,  ///< rendered for themselves, nothing until they arrive
    Both,      ///< rendered for themselves, filled until they arrive
};

struct WarpOptions {
    HoleFilling filling = HoleFilling::Both;
    /// Pixels rendered for themselves at a time, at most, from 1 on: 5 % of 640x480.
    int mostRequested = 15360;
    int holeSamples = 4;  ///< of each of them, [1, 4096]
    /// While the camera rests, this share of the objects' pixels is rendered for itself: those at
    /// edges, which the warp blurs; [0, 1], 0: none.
    double sharpenShare = 0.4;
    int sharpenSamples = 40;  ///< of each of them, [1, 4096]
    /// What was rendered appears over so many frames, [0, 100].
    int fadeFrames = 4;
    /// A pose that moves nothing of the reference by so much shows it as it is [px], [0, 10].
    double leastMotion = 0.1;
    bool operator==(const WarpOptions&) const = default;
};

/// Whether pixels are rendered for themselves.
[[nodiscard]] inline bool rerenders(HoleFilling filling) {
    return filling == HoleFilling::Rerender || filling == HoleFilling::Both;
}
/// Whether holes are filled from their surroundings.
[[nodiscard]] inline bool pushPulls(HoleFilling filling) {
    return filling == HoleFilling::PushPull || filling == HoleFilling::Both;
}

/// Throws std::invalid_argument that names the first option out of its range.
void validate(const WarpOptions& options);

}  // namespace mfar
