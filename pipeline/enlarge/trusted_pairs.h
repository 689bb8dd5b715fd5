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

/// A matched still, sampled at the sub-pixels of a video frame, with the brightness of the video.
/// The still is warped by the look-ups, after a correction of their sub-pixel errors. Its tone
/// curve and its mean over larger areas are fitted to the video, so that gain and gamma of the
/// sensors leave no offset. Differences in blur and noise remain, because the filters must learn
/// them.
class TrustedPairs {
public:
    /// After a request of `stop`, the constructor returns soon and no pixel is trusted.
    explicit TrustedPairs(const MatchedPictures& pictures, std::stop_token stop = {});

    [[nodiscard]] Size size() const { return video_; }
    /// True if still and video agree around the pixel, except for noise and blur.
    [[nodiscard]] bool trusts(int x, int y) const { return trusted_[y][x] != 0; }
    /// Returns the still minus the video enlarged by Keys' cubic, at the pixel's sub-pixels [grey
    /// levels].
    [[nodiscard]] Phases target(int x, int y) const;
    [[nodiscard]] double trustedShare() const { return trustedShare_; }
    /// Variance of the still among a pixel's sub-pixels, divided by the variance of the video
    /// enlarged by Keys' cubic. It is measured over trusted pixels with structure. The still is no
    /// sharper than the video if the result is at most one.
    [[nodiscard]] double sharpness() const { return sharpness_; }
    /// The pairs of grey levels from which the tone curve was fitted.
    [[nodiscard]] const ToneSums& toneSums() const { return toneSums_; }

private:
    /// Sums of products of the still's gradient (x, y) and the pictures' difference e.
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
    Plane mean_;  // video minus seen_, averaged over a larger area
    ToneSums toneSums_;
    ToneSums::Curve tone_{};  // video grey level for each still grey level
    double trustedShare_ = 0, sharpness_ = 0;
};

}  // namespace mfar::enlarge
