#pragma once

#include "base/rows.h"
#include "pipeline/enlarge/class_sums.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/warped_grid.h"

#include <cstdint>
#include <stop_token>
#include <vector>

namespace mfar::enlarge {

/// What the still shows at the sub-pixels of a video frame that it was matched to, as the video's
/// sensor would show it: warped by the look-ups, shifted by the fraction of a pixel that they are
/// off, its tone fitted to the video's, and with the video's mean over larger areas. Sensors that
/// differ in gain and gamma leave no offset, those that differ in blur and noise do: that is to be
/// learned.
class TrustedPairs {
public:
    /// `stop`: ends soon, without anything that is trusted.
    explicit TrustedPairs(const MatchedPictures& pictures, std::stop_token stop = {});

    [[nodiscard]] Size size() const { return video_; }
    /// Whether both agree around a pixel up to noise and blur.
    [[nodiscard]] bool trusts(int x, int y) const { return trusted_[y][x] != 0; }
    /// What Keys' cubic of the video misses at the pixel's sub-pixels [grey levels].
    [[nodiscard]] Phases target(int x, int y) const;
    [[nodiscard]] double trustedShare() const { return trustedShare_; }
    /// Variance of the still within pixels of the video with structure, over that of the cubic: up
    /// to one where the still is no sharper than the video.
    [[nodiscard]] double sharpness() const { return sharpness_; }

private:
    /// Products of gradients and differences, summed up.
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
    /// A value of each pixel.
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
    AlignedRows<std::uint8_t> known_;    // of each cell: matched
    AlignedRows<std::uint8_t> trusted_;  // of each pixel
    WarpedGrid still_;
    Plane seen_;               // its means as the video's sensor sees it, in tone and blur
    Plane mean_;               // what that lacks over larger areas
    std::vector<float> tone_;  // of each grey level
    double trustedShare_ = 0, sharpness_ = 0;
};

}  // namespace mfar::enlarge
