#pragma once

#include "base/rows.h"
#include "pipeline/enlarge/filter_layout.h"
#include "pipeline/enlarge/still_tone.h"

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace mfar {

class FilterBankError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Learned factors that combine still and video at the video's resolution. `still` and `video`
/// determine how far the still's finest detail replaces the video's; see params::kGuideReach. These
/// two are similar if both sensors have the same exposure. `light` determines how a video
/// pixel averages what it sees; see params::kSeen. If all factors are zero, there is no guidance.
struct Guidance {
    float still = 0;  ///< added share of the still's detail, [0, 1]
    float video = 0;  ///< removed share of the video's detail, [0, kMost]
    float light = 0;  ///< 0: grey levels are averaged, 1: their squares, [0, kMost]

    static constexpr float kMost = 2;
    [[nodiscard]] bool any() const { return still > 0 || video > 0 || light > 0; }
    [[nodiscard]] bool isValid() const {
        return still >= 0 && still <= 1 && video >= 0 && video <= kMost && light >= 0 &&
               light <= kMost;
    }
    bool operator==(const Guidance&) const = default;
};

/// Variance of the video's finest detail that a correctly matched still usually leaves
/// unexplained: noise + share * (variance of the video's finest detail). See params::kFineRoom.
/// Until both numbers are learned, noise is 0.
struct FineMatch {
    float noise = 0;  ///< constant part [grey levels^2], [0, kMostNoise]
    float share = 0;  ///< unexplained share of the variance of the video's finest detail, [0, 1]

    static constexpr float kMostNoise = 4096;
    [[nodiscard]] bool isKnown() const { return noise > 0; }
    [[nodiscard]] bool isValid() const {
        return noise >= 0 && noise <= kMostNoise && share >= 0 && share <= 1;
    }
    bool operator==(const FineMatch&) const = default;
};

/// Filters of the learned enlarger, one per class (see filter_layout.h), with the Guidance,
/// FineMatch and StillTone learned from the same sensors. Immutable.
class FilterBank {
public:
    /// Weights of a class's filter. A weight w is stored as w * 16384 / 2. It is halved, because
    /// the residuals of a pixel's two classes are added to compute their mean.
    using Filter = std::array<std::int16_t, enlarge::kFilterSize>;

    /// `unique` contains the filters, gradient classes first. Throws FilterBankError if their
    /// number is not kUnique, if weights are too large, or if `guidance` or `fineMatch` is out of
    /// range.
    explicit FilterBank(std::span<const Filter> unique, const Guidance& guidance = {},
                        const FineMatch& fineMatch = {}, const StillTone& tone = {});
    /// The shipped filters, which are part of the program. They were learned by
    /// mfar-train-enlarger.
    [[nodiscard]] static const FilterBank& prior();

    /// A number that no other bank has. It shows whether a copy of the filters is up to date.
    [[nodiscard]] std::uint64_t number() const { return number_; }
    [[nodiscard]] Rows<const std::int16_t> gradient() const { return gradient_.rows(); }
    [[nodiscard]] Rows<const std::int16_t> curvature() const { return curvature_.rows(); }
    /// Guidance is zero for the shipped filters, because it must be learned for each pair of
    /// sensors: it depends on their noise and sharpness.
    [[nodiscard]] const Guidance& guidance() const { return guidance_; }
    /// FineMatch is unknown for the shipped filters, because it must be learned for each pair of
    /// sensors: it depends on their noise and sharpness.
    [[nodiscard]] const FineMatch& fineMatch() const { return fineMatch_; }
    /// The tone curve of the stills. With the shipped filters, it changes nothing.
    [[nodiscard]] const StillTone& tone() const { return tone_; }
    /// A filter whose result is Keys' cubic enlargement minus the pixel's own value, with the same
    /// taps and sub-pixels as the learned filters. A weight w is stored as w * 16384. (Weights of
    /// learned filters are stored as w * 16384 / 2, see Filter.)
    [[nodiscard]] const std::int16_t* cubic() const { return cubic_[0]; }

private:
    std::uint64_t number_;
    Guidance guidance_;
    FineMatch fineMatch_;
    StillTone tone_;
    AlignedRows<std::int16_t> gradient_, curvature_, cubic_;
};

/// Returns the filters in their stored form: "mfarfilt", little-endian 32-bit numbers (version,
/// number of gradient filters, number of curvature filters, taps, phases), 16-bit weights, then the
/// FNV-1a checksum of all bytes before the checksum.
[[nodiscard]] std::vector<std::uint8_t> storedFilters(std::span<const FilterBank::Filter> unique);
/// Reads filters from their stored form. Error messages contain `name`. Throws FilterBankError if
/// the data is damaged, or has another format version, other classes or other sizes.
[[nodiscard]] std::vector<FilterBank::Filter> readFilters(std::span<const std::uint8_t> bytes,
                                                          const std::string& name);

}  // namespace mfar
