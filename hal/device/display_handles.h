#pragma once

namespace mfar {

/// Deleter of a C handle: std::unique_ptr<drmModeRes, FreedBy<drmModeFreeResources>>.
template <auto Free>
struct FreedBy {
    template <class T>
    void operator()(T* handle) const {
        Free(handle);
    }
};

}  // namespace mfar
