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

/// Thrown if stored filters cannot be used. The message names the filters and the reason.
class FilterBankError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// How strongly a trusted still replaces the finest detail of the video; see params::kGuideReach.
/// If both factors are 0, there is no guidance. The factors are similar if both sensors have the
/// same exposure.
struct Guidance {
    float still = 0;  ///< share of the still's detail that is added, [0, 1]
    float video = 0;  ///< share of the video's detail that is removed, [0, kMost]

    static constexpr float kMost = 2;
    [[nodiscard]] bool any() const { return still > 0 || video > 0; }
    [[nodiscard]] bool isValid() const {
        return still >= 0 && still <= 1 && video >= 0 && video <= kMost;
    }
    bool operator==(const Guidance&) const = default;
};

/// How much of the video's finest detail a correctly matched still usually leaves unexplained. The
/// unexplained variance is noise + share * (variance of the finest detail); see params::kFineRoom.
/// If noise is 0, the usual unexplained variance is not known.
struct FineMatch {
    float noise = 0;  ///< part that does not depend on the detail [grey levels^2], [0, kMostNoise]
    float share = 0;  ///< unexplained share of the detail's variance, [0, 1]

    static constexpr float kMostNoise = 4096;
    [[nodiscard]] bool isKnown() const { return noise > 0; }
    [[nodiscard]] bool isValid() const {
        return noise >= 0 && noise <= kMostNoise && share >= 0 && share <= 1;
    }
    bool operator==(const FineMatch&) const = default;
};

/// The filters of the learned enlarger, one per class (see filter_layout.h), with the Guidance,
/// the FineMatch and the StillTone that were learned from the same sensors. Immutable.
class FilterBank {
public:
    /// Weights of the filter of a class. The weights are halved, because the residuals of both
    /// classes of a pixel are added. A halved weight of one is stored as 16384.
    using Filter = std::array<std::int16_t, enlarge::kFilterSize>;

    /// `unique`: kUnique filters, those of the gradient classes first. Throws FilterBankError.
    explicit FilterBank(std::span<const Filter> unique, const Guidance& guidance = {},
                        const FineMatch& fineMatch = {}, const StillTone& tone = {});
    /// The shipped filters. They were learned by mfar-train-enlarger and are part of the program.
    [[nodiscard]] static const FilterBank& prior();

    /// A number that differs for every bank, so that code that keeps a copy can see whether it is
    /// up to date.
    [[nodiscard]] std::uint64_t number() const { return number_; }
    /// The filters of the gradient classes and of the curvature classes, one row per class.
    [[nodiscard]] Rows<const std::int16_t> gradient() const { return gradient_.rows(); }
    [[nodiscard]] Rows<const std::int16_t> curvature() const { return curvature_.rows(); }
    /// The guidance. It is zero for the shipped filters, because it depends on the noise and
    /// sharpness of both sensors.
    [[nodiscard]] const Guidance& guidance() const { return guidance_; }
    /// The FineMatch. It is unknown for the shipped filters, because it depends on the noise and
    /// sharpness of both sensors.
    [[nodiscard]] const FineMatch& fineMatch() const { return fineMatch_; }
    /// The tone curve of the stills. The shipped filters leave stills as they are.
    [[nodiscard]] const StillTone& tone() const { return tone_; }
    /// Keys' cubic minus the pixel itself, as a filter with the same taps and sub-pixels. Its
    /// weights are not halved; a weight of one is stored as 16384.
    [[nodiscard]] const std::int16_t* cubic() const { return cubic_[0]; }

private:
    std::uint64_t number_;
    Guidance guidance_;
    FineMatch fineMatch_;
    StillTone tone_;
    AlignedRows<std::int16_t> gradient_, curvature_, cubic_;
};

/// Returns the filters in their stored form: "mfarfilt", then little-endian 32-bit numbers
/// (version, number of gradient filters, number of curvature filters, taps, phases), then the
/// weights, 16 bits each, then the FNV-1a checksum of all of this.
[[nodiscard]] std::vector<std::uint8_t> storedFilters(std::span<const FilterBank::Filter> unique);
/// Reads filters from their stored form. `name`: the name of the filters in error messages. Throws
/// FilterBankError if the data is incomplete.
[[nodiscard]] std::vector<FilterBank::Filter> readFilters(std::span<const std::uint8_t> bytes,
                                                          const std::string& name);

}  // namespace mfar
