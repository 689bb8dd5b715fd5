#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Selects random indices with given probabilities. Similar random numbers select indices that are
/// near each other, so that well distributed numbers give well distributed indices.
class ShareTable {
public:
    ShareTable() = default;
    /// The weights must be finite and not negative. The table is empty if their sum is 0.
    explicit ShareTable(std::span<const double> weights);

    [[nodiscard]] bool empty() const { return ends_.empty(); }
    /// `rest` is the part of the random number that did not decide the index, uniform in [0, 1).
    struct Drawn {
        std::uint32_t index;
        float rest;
    };
    /// Selects an index by the random number `u` in [0, 1). `u` must have many more random bits
    /// than the largest index has. An index of weight 0 is never selected. The table must not be
    /// empty.
    [[nodiscard]] Drawn draw(double u) const;

private:
    std::vector<double> ends_;  // cumulative probabilities
};

}  // namespace mfar
