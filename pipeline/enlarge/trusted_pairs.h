#pragma once

#include "base/rows.h"
#include "pipeline/enlarge/class_sums.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/tone_sums.h"
#include "pipeline/enlarge/warped_grid.h"

#include <cstdint>
#include <stop_token>
#include <vector>

namespace mfar::enlarge {

/// A matched still, resampled at the sub-pixels of a video frame, with the brightness of the video.
/// First, sub-pixel errors of the look-ups are corrected, and the still is warped with the
/// corrected look-ups. Then, a tone curve and a local mean are fitted to the video, so that
/// different gain and gamma of the sensors cause no offset. Differences in blur and noise remain,
/// because the filters must learn them.
class TrustedPairs {
public:
    /// `pictures` must outlive this object. If `stop` is requested, the constructor returns soon,
    /// and the result must not be used.
    explicit TrustedPairs(const MatchedPictures& pictures, std::stop_token stop = {});

    [[nodiscard]] Size size() const { return video_; }
    /// True if still and video agree around the pixel, apart from noise and blur.
    [[nodiscard]] bool trusts(int x, int y) const { return trusted_[y][x] != 0; }
    /// Returns the still minus Keys' cubic enlargement of the video, at the sub-pixels of this
    /// pixel [grey levels].
    [[nodiscard]] Phases target(int x, int y) const;
    [[nodiscard]] double trustedShare() const { return trustedShare_; }
    /// Ratio of the still's sharpness to the video's. It is the variance of the still among the
    /// sub-pixels of a pixel, divided by the same variance of the video enlarged by Keys' cubic,
    /// over trusted pixels with structure. If it is at most one, the still is no sharper. It is 0
    /// if there is no such pixel.
    [[nodiscard]] double sharpness() const { return sharpness_; }
    /// The pairs of grey levels from which the tone curve was fitted.
    [[nodiscard]] const ToneSums& toneSums() const { return toneSums_; }

private:
    /// Sums of products of the still's gradient (x, y) and the difference e between video and
    /// still.
    struct ShiftSums {
        double xx = 0, xy = 0, yy = 0, xe = 0, ye = 0;
        void add(const ShiftSums& other) {
            xx += other.xx;
            xy += other.xy;
            yy += other.yy;
            xe += other.xe;
            ye += other.ye;
        }
    };
    using Plane = std::vector<float>;

    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * video_.width + x;
    }
    void findCells();
    void fitTone();
    void fitBlur();
    void fitMean();
    [[nodiscard]] std::vector<ShiftSums> shiftSums() const;
    void shift();
    void trust();
    void measureSharpness();
    [[nodiscard]] float toneOf(float value) const;
    [[nodiscard]] double videoAt(int x, int y) const;
    [[nodiscard]] Phases videoOf(int x, int y) const;
    [[nodiscard]] Phases stillOf(int x, int y) const;

    const MatchedPictures& in_;
    std::stop_token stop_;
    Size video_, cells_;
    AlignedRows<LookUpCell> lookUps_;
    AlignedRows<std::uint8_t> known_;
    AlignedRows<std::uint8_t> trusted_;
    WarpedGrid still_;
    Plane seen_;  // mean of the still over each pixel, with the video's tone and blur
    Plane mean_;  // video minus seen_, averaged over the surrounding 17x17 pixels
    ToneSums toneSums_;
    ToneSums::Curve tone_{};  // video grey level for each still grey level
    double trustedShare_ = 0, sharpness_ = 0;
};

}  // namespace mfar::enlarge
