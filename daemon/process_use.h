#pragma once

namespace mfar {

/// Resources used by this process so far. Zero where the kernel does not report them.
struct ProcessUse {
    double ms = 0;          ///< since the process started, in steps of the kernel's clock (10 ms)
    double cpuMs = 0;       ///< processor time of all threads together
    double residentMb = 0;  ///< resident memory now, programs and libraries included [1e6 B]
};

[[nodiscard]] ProcessUse processUse();

}  // namespace mfar
