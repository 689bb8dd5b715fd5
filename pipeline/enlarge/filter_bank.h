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

/// Stored filters cannot be used. The message says which and why.
class FilterBankError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Filters of the learned enlarger, one for each class, see filter_layout.h, and how far a still
/// guides what the video shows, too. Immutable.
class FilterBank {
public:
    /// Weights of a class, with 16384 as one, halved: the residuals of both classes are added.
    using Filter = std::array<std::int16_t, enlarge::kFilterSize>;

    /// `unique`: kUnique filters, those by gradient first. `guidance`: see guidance(). Throws
    /// FilterBankError.
    explicit FilterBank(std::span<const Filter> unique, float guidance = 0);
    /// What the product ships: learned by mfar-train-enlarger, part of the program.
    [[nodiscard]] static const FilterBank& prior();

    /// Another one than that of any other bank: tells whether a copy of this one is up to date.
    [[nodiscard]] std::uint64_t number() const { return number_; }
    /// A row per class.
    [[nodiscard]] Rows<const std::int16_t> gradient() const { return gradient_.rows(); }
    [[nodiscard]] Rows<const std::int16_t> curvature() const { return curvature_.rows(); }
    /// Share of the video's finest detail that gives way to what the still shows of it, where that
    /// is trusted: [0, 1]; see params::kGuideReach. 0 for the shipped filters: it depends on how
    /// noisy and how sharp both sensors are.
    [[nodiscard]] float guidance() const { return guidance_; }
    /// Keys' cubic on the same grid, less the pixel, as a filter: with 16384 as one, not halved.
    [[nodiscard]] const std::int16_t* cubic() const { return cubic_[0]; }

private:
    std::uint64_t number_;
    float guidance_;
    AlignedRows<std::int16_t> gradient_, curvature_, cubic_;
};

/// The stored form: "mfarfilt", then little-endian 32-bit numbers: version, filters by gradient and
/// by curvature, taps, phases; the weights, 16 bits each; the FNV-1a sum of all that.
[[nodiscard]] std::vector<std::uint8_t> storedFilters(std::span<const FilterBank::Filter> unique);
/// Reads it. `name` is for messages. Throws FilterBankError for anything that is not whole.
[[nodiscard]] std::vector<FilterBank::Filter> readFilters(std::span<const std::uint8_t> bytes,
                                                          const std::string& name);

}  // namespace mfar
