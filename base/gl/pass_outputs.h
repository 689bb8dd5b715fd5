#pragma once

#include "base/gl/gl.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mfar::gpu {

/// Allowed range of a value, bounds included.
struct ValueRange {
    double low, high;
};

/// A variable that a shader writes.
struct PassOutput {
    enum class Kind { Storage, Image, Colour };
    Kind kind;
    std::string name;  ///< as in the shader's text
    GLuint index;      ///< storage block's binding, image unit or colour attachment
    /// One range per component, read from the line in the shader's header
    /// "// Range: name low..high, low..high"; the last holds for all further components. Empty: any
    /// finite value.
    std::vector<ValueRange> ranges;
    // Position in the storage block.
    bool isFloat = true;
    int components = 4;
    std::size_t offset = 0, stride = 0;  ///< [bytes]
    std::size_t count = 0;               ///< elements; 0: to the end of the buffer
};

/// The outputs of a linked program with this compute or fragment shader text. Storage blocks that
/// the text declares readonly are excluded.
[[nodiscard]] std::vector<PassOutput> outputsOf(GLuint program, std::string_view text);

/// The ranges that the shader's text states for the variable.
[[nodiscard]] std::vector<ValueRange> statedRanges(std::string_view text, std::string_view name);

}  // namespace mfar::gpu
