#pragma once

#include <EGL/egl.h>

#include <string_view>

namespace mfar {

/// Returns true if a list of EGL or GL extensions contains the name. `list` may be null.
[[nodiscard]] inline bool hasExtension(const char* list, std::string_view name) {
    const std::string_view all = list != nullptr ? list : "";
    for (std::size_t at = 0; (at = all.find(name, at)) != all.npos; at += name.size()) {
        const std::size_t end = at + name.size();
        if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) return true;
    }
    return false;
}

template <class F>
[[nodiscard]] F eglProc(const char* name) {
    return reinterpret_cast<F>(eglGetProcAddress(name));
}

}  // namespace mfar
