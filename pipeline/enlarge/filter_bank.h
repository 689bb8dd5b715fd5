#pragma once

#include "base/rows.h"
#include "pipeline/enlarge/filter_layout.h"

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace mfar {

/// Stored filters are unusable. The message names them and the reason.
class FilterBankError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// How strongly a trusted still guides the finest detail of the video itself; see
/// params::kGuideReach. Both factors 0: no guidance. Both are alike where the sensors have the same
/// exposure.
struct Guidance {
    float still = 0;  ///< share of the still's detail that is added, [0, 1]
    float video = 0;  ///< share of the video's own detail that is removed, [0, kMost]

    static constexpr float kMost = 2;
    [[nodiscard]] bool any() const { return still > 0 || video > 0; }
    [[nodiscard]] bool isValid() const {
        return still >= 0 && still <= 1 && video >= 0 && video <= kMost;
    }
    bool operator==(const Guidance&) const = default;
};

/// The variance of the video's finest detail that a correctly matched still usually leaves
/// unexplained, see params::kFineRoom: noise + share * that detail's variance. Noise 0: not known.
struct FineMatch {
    float noise = 0;  ///< [grey levels^2], [0, kMostNoise]
    float share = 0;  ///< [0, 1]

    static constexpr float kMostNoise = 4096;
    [[nodiscard]] bool isKnown() const { return noise > 0; }
    [[nodiscard]] bool isValid() const {
        return noise >= 0 && noise <= kMostNoise && share >= 0 && share <= 1;
    }
    bool operator==(const FineMatch&) const = default;
};

/// Filters of the learned enlarger, one per class, see filter_layout.h; with the guidance and the
/// usual match of a still. Immutable.
class FilterBank {
public:
    /// Weights of a class, with 16384 as one, halved because the residuals of both classes are
    /// added.
    using Filter = std::array<std::int16_t, enlarge::kFilterSize>;

    /// `unique`: kUnique filters, first those of the gradient classes. Throws FilterBankError.
    explicit FilterBank(std::span<const Filter> unique, const Guidance& guidance = {},
                        const FineMatch& fineMatch = {});
    /// The shipped filters: learned by mfar-train-enlarger, part of the program.
    [[nodiscard]] static const FilterBank& prior();

    /// Unique per bank: users compare it to see whether their copy is up to date.
    [[nodiscard]] std::uint64_t number() const { return number_; }
    /// A row per class.
    [[nodiscard]] Rows<const std::int16_t> gradient() const { return gradient_.rows(); }
    [[nodiscard]] Rows<const std::int16_t> curvature() const { return curvature_.rows(); }
    /// None for the shipped filters: guidance depends on the noise and sharpness of both sensors.
    [[nodiscard]] const Guidance& guidance() const { return guidance_; }
    /// Unknown for the shipped filters, for the same reason.
    [[nodiscard]] const FineMatch& fineMatch() const { return fineMatch_; }
    /// Keys' cubic on the same grid, minus the pixel, as a filter with 16384 as one, not halved.
    [[nodiscard]] const std::int16_t* cubic() const { return cubic_[0]; }

private:
    std::uint64_t number_;
    Guidance guidance_;
    FineMatch fineMatch_;
    AlignedRows<std::int16_t> gradient_, curvature_, cubic_;
};

/// The stored form: "mfarfilt", then little-endian 32-bit numbers: version, number of gradient and
/// of curvature filters, taps, phases; then the weights, 16 bits each; then the FNV-1a sum of all
/// that.
[[nodiscard]] std::vector<std::uint8_t> storedFilters(std::span<const FilterBank::Filter> unique);
/// Reads the stored form. `name` is for messages. Throws FilterBankError for incomplete data.
[[nodiscard]] std::vector<FilterBank::Filter> readFilters(std::span<const std::uint8_t> bytes,
                                                          const std::string& name);

}  // namespace mfar
