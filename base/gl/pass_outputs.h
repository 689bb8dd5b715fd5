#pragma once

#include "base/gl/gl.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mfar::gpu {

/// What a value may be, bounds included.
struct ValueRange {
    double low, high;
};

/// A variable that a shader writes.
struct PassOutput {
    enum class Kind { Storage, Image, Colour };
    Kind kind;
    std::string name;  ///< as in the shader
    GLuint index;      ///< of the storage block's binding, image unit or colour attachment
    /// Of each component, as the shader's header says in a line
    /// "// Range: name low..high, low..high"; the last holds for all further components. Empty: any
    /// finite value.
    std::vector<ValueRange> ranges;
    // Where a storage block has it.
    bool isFloat = true;
    int components = 4;
    std::size_t offset = 0, stride = 0;  ///< [bytes]
    std::size_t count = 0;               ///< elements; 0: to the end of the buffer
};

/// The outputs of a linked program, whose compute or fragment shader has that text. Storage blocks
/// that the text calls readonly are none.
[[nodiscard]] std::vector<PassOutput> outputsOf(GLuint program, std::string_view text);

/// The ranges that a shader's text states for a variable.
[[nodiscard]] std::vector<ValueRange> statedRanges(std::string_view text, std::string_view name);

}  // namespace mfar::gpu
