#pragma once

namespace mfar {

/// A deleter that calls a C function, e.g. std::unique_ptr<drmModeRes,
/// FreedBy<drmModeFreeResources>>.
template <auto Free>
struct FreedBy {
    template <class T>
    void operator()(T* handle) const {
        Free(handle);
    }
};

}  // namespace mfar
