#pragma once

#include "base/gl/gl.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mfar::gpu {

struct ValueRange {
    double low, high;
};

/// A variable that a shader writes.
struct PassOutput {
    enum class Kind { Storage, Image, Colour };
    Kind kind;
    std::string name;
    GLuint index;  ///< binding of the storage block, image unit, or colour attachment
    /// The allowed values, with one range per component. They are read from a line in the shader:
    /// "// Range: name low..high, low..high". The last range also applies to all further
    /// components. An empty list allows any finite value.
    std::vector<ValueRange> ranges;
    // Type and position of the variable in its storage block.
    bool isFloat = true;
    int components = 4;
    std::size_t offset = 0, stride = 0;  ///< [bytes]
    std::size_t count = 0;  ///< number of array elements; 0: as many as the buffer holds
};

/// Returns the outputs of a linked program that Validation can check: float and uint variables of
/// storage blocks, float images and float colours. `text` is the source of the program's compute or
/// fragment shader. Storage blocks that the shader declares readonly are excluded.
[[nodiscard]] std::vector<PassOutput> outputsOf(GLuint program, std::string_view text);

[[nodiscard]] std::vector<ValueRange> statedRanges(std::string_view text, std::string_view name);

}  // namespace mfar::gpu
