#pragma once

#include "pipeline/render/render_view.h"

namespace mfar {

/// Chooses the resolution of traced pictures, so that on a slow processor a picture is not outdated
/// when it is shown. A picture of coarseness n has 2^(-n/2) times the camera's width and height.
class PictureCoarseness {
public:
    static constexpr int kCoarsest = 4;

    /// A picture should be shown within about `seconds` after its start. 0: every picture has
    /// coarseness 0.
    explicit PictureCoarseness(double seconds) : within_(seconds) {}

    /// Returns the coarseness of a picture that would have `pixels` traced pixels at coarseness 0.
    [[nodiscard]] int chosen(double pixels) const;
    /// Reports that a picture begins.
    void begin(int coarseness) { last_ = coarseness; }
    /// Reports the time that a picture took from its start until it was shown [s].
    void learn(double pixels, int coarseness, double seconds);
    /// A picture that is not shown yet.
    struct Begun {
        double seconds;  ///< time since its start
        double looked;   ///< share of the pixels with a ray through their centre, [0, 1]
        /// Estimated time from the picture's start until it can be shown [s].
        [[nodiscard]] double expectedSeconds() const;
    };
    /// True if the picture should be replaced by a coarser one.
    [[nodiscard]] bool isTooSlow(int coarseness, const Begun& begun) const;

private:
    double within_;
    double secondsPerPixel_ = 0;  // 0: unknown
    int last_ = 0;
};

/// The same view at a picture's resolution.
[[nodiscard]] RenderView coarsened(const RenderView& view, int coarseness);

}  // namespace mfar
