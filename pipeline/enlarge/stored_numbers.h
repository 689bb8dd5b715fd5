#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mfar::enlarge {

inline void putNumber(std::vector<std::uint8_t>& out, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i)
        out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

[[nodiscard]] inline std::uint64_t getNumber(const std::uint8_t* from, int bytes) {
    std::uint64_t out = 0;
    for (int i = 0; i < bytes; ++i)
        out |= static_cast<std::uint64_t>(from[i]) << (8 * i);
    return out;
}

[[nodiscard]] inline std::uint32_t fnv1a(std::span<const std::uint8_t> bytes) {
    std::uint32_t sum = 2166136261U;
    for (const std::uint8_t byte : bytes)
        sum = (sum ^ byte) * 16777619U;
    return sum;
}

}  // namespace mfar::enlarge
