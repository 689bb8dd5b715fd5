#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// The portable floor: limits that every OpenGL ES 3.1 driver guarantees. The software renderer
/// accepts far more, so tests check each shader against these numbers.
struct ShaderBudget {
    static constexpr int kStorageBlocks = 4;  ///< also the highest binding + 1
    static constexpr int kImages = 4;         ///< also the highest binding + 1
    static constexpr int kInvocations = 128;  ///< a group
    static constexpr int kSharedBytes = 16 * 1024;
    static constexpr int kFileLines = 150;
};

/// Faults of a file in gles_shaders/ (includes unresolved): name, header comment, length, number of
/// main functions. One line each.
[[nodiscard]] std::vector<std::string> shaderFileFaults(std::string_view name,
                                                        std::string_view text);

/// Faults in the resolved text: precision, forbidden words, image access, unresolved #include,
/// macros that are tested but not named by a line "// Variant: #define NAME value".
[[nodiscard]] std::vector<std::string> shaderTextFaults(std::string_view text);

/// Faults of the linked shader: compiles alone, storage blocks, images, bindings, group size,
/// shared memory. `name` ends with .comp, .frag or .vert. Needs a current context.
/// `defines` as in gpu::Program.
[[nodiscard]] std::vector<std::string>
shaderProgramFaults(std::string_view name, std::string_view text, std::string_view defines);

/// The "#define NAME value\n" of every "// Variant:" line of the text, and "" for the plain shader.
[[nodiscard]] std::vector<std::string> shaderVariants(std::string_view text);

}  // namespace mfar
