#pragma once

namespace mfar {

/// A deleter for std::unique_ptr that calls a C function. Example: std::unique_ptr<drmModeRes,
/// FreedBy<drmModeFreeResources>>.
template <auto Free>
struct FreedBy {
    template <class T>
    void operator()(T* handle) const {
        Free(handle);
    }
};

}  // namespace mfar
