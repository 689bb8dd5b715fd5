#pragma once

namespace mfar {

/// What this process has taken so far. Zero where the kernel does not report it.
struct ProcessUse {
    double ms = 0;          ///< since the process began, in steps of the kernel's clock (10 ms)
    double cpuMs = 0;       ///< of processors, all threads together
    double residentMb = 0;  ///< memory that is in use now, programs and libraries included [1e6 B]
};

[[nodiscard]] ProcessUse processUse();

}  // namespace mfar
