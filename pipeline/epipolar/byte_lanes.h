#pragma once

#include <cstdint>
#include <cstring>

namespace mfar {

/// Sixteen bytes that the compiler keeps in one register (SSE2, NEON).
using Bytes16 = std::uint8_t __attribute__((vector_size(16)));

inline Bytes16 loadBytes(const std::uint8_t* from) {
    Bytes16 v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

inline void storeBytes(std::uint8_t* to, Bytes16 v) {
    std::memcpy(to, &v, sizeof v);
}

inline Bytes16 spread(std::uint8_t value) {
    return Bytes16{} + value;
}

inline Bytes16 lesser(Bytes16 a, Bytes16 b) {
    return a < b ? a : b;
}

/// The least of the sixteen, in every lane. The oldest x86 has no shuffle of single bytes: the last
/// exchange is one of shifts.
inline Bytes16 leastOf(Bytes16 v) {
    using Words8 = std::uint16_t __attribute__((vector_size(16)));
    Words8 w;
    const auto exchange = [&](Words8 other) {
        v = lesser(v, reinterpret_cast<Bytes16>(other));
        w = reinterpret_cast<Words8>(v);
    };
    w = reinterpret_cast<Words8>(v);
    exchange(__builtin_shufflevector(w, w, 4, 5, 6, 7, 0, 1, 2, 3));
    exchange(__builtin_shufflevector(w, w, 2, 3, 0, 1, 6, 7, 4, 5));
    exchange(__builtin_shufflevector(w, w, 1, 0, 3, 2, 5, 4, 7, 6));
    exchange((w << 8) | (w >> 8));
    return v;
}

}  // namespace mfar
