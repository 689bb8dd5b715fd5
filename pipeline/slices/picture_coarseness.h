#pragma once

#include "pipeline/render/render_view.h"

#include <optional>

namespace mfar {

/// Processor time for tracing in each frame.
struct FrameBudget {
    double ms = 8;
    double extraMs = 0;  ///< more time in this frame, but not in later ones
    double secondsPerFrame = 1.0 / 30;
};

/// Chooses the resolution of traced pictures, so that on a slow processor a picture is not outdated
/// when it is shown. A picture of coarseness n has 2^(-n/2) times the camera's width and height.
class PictureCoarseness {
public:
    static constexpr int kCoarsest = 4;

    /// A picture should be shown within about `seconds` after its start. 0: every picture has
    /// coarseness 0.
    explicit PictureCoarseness(double seconds) : within_(seconds) {}

    /// Returns the coarseness of a picture that would have `pixels` traced pixels at coarseness 0.
    /// `waited`: if nothing is shown until the picture is, the time since its view was chosen [s].
    /// Then the limit is half of the usual time, less this time.
    [[nodiscard]] int chosen(double pixels, std::optional<double> waited = {}) const;
    /// True if the time that pictures take is unknown. Until then, chosen() returns kCoarsest.
    [[nodiscard]] bool lacksSpeed() const { return within_ > 0 && !(secondsPerPixel_ > 0); }
    /// Reports that a picture begins.
    void begin(int coarseness) { last_ = coarseness; }
    void setBudget(const FrameBudget& budget) { budget_ = budget; }
    /// Reports the time that a picture took from its start until it was shown [s].
    void learn(double pixels, int coarseness, double seconds);
    /// Reports the time that rays through the centres of `pixels` pixels took: `ms` of processor
    /// time, and `seconds` since the picture's start.
    void learnFromLook(double pixels, double ms, double seconds);

private:
    double within_;
    FrameBudget budget_;
    double secondsPerPixel_ = 0;  // 0: unknown
    int last_ = 0;
};

/// The same view at a picture's resolution.
[[nodiscard]] RenderView coarsened(const RenderView& view, int coarseness);

}  // namespace mfar
