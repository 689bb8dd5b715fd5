#pragma once

#include <functional>
#include <string>
#include <utility>

// Faults that clang-tidy must find. The comment behind each fault names the check that finds it.
namespace mfar::planted {

#define MFAR_TWICE(x) (x * 2)  // bugprone-macro-parentheses

struct name_of_a_struct {  // readability-identifier-naming
    int value = 0;
};

inline std::size_t lengthOf(std::string text) {  // performance-unnecessary-value-param
    return text.size();
}

template <typename T>
std::string used(T text) {
    std::string taken = std::move(text);
    return taken + text;  // bugprone-use-after-move
}

template <typename T>
class Halves {
public:
    double half() const {
        return value_ / 2;  // bugprone-integer-division
    }

private:
    T value_ = 3;
};

}  // namespace mfar::planted

template <>
struct std::hash<mfar::planted::name_of_a_struct> {
    std::size_t operator()(const mfar::planted::name_of_a_struct& of) const {
        const int* none = 0;  // modernize-use-nullptr
        return none == nullptr ? static_cast<std::size_t>(of.value) : 0;
    }
};
