#pragma once

namespace mfar {

/// Resources that this process has used so far. A value is 0 if the kernel does not report it.
struct ProcessUse {
    double ms = 0;  ///< time since the process started, in steps of 10 ms
    double cpuMs = 0;
    double residentMb = 0;  ///< resident memory, including program and libraries [1e6 bytes]
};

[[nodiscard]] ProcessUse processUse();

}  // namespace mfar
