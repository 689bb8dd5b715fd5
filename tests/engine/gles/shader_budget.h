#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mfar {

/// Limits of shaders, because the software renderer accepts far more than the GPUs of boards.
/// Except kFileLines, they are guaranteed by OpenGL ES 3.1 for compute shaders. But a driver may
/// allow only four storage blocks and images together, and none in fragment shaders. Mesa's drivers
/// allow more.
struct ShaderBudget {
    static constexpr int kStorageBlocks = 4;  ///< number of blocks; each binding must be below it
    static constexpr int kImages = 4;         ///< number of images; each binding must be below it
    static constexpr int kInvocations = 128;  ///< invocations of a work group
    static constexpr int kSharedBytes = 16 * 1024;
    static constexpr int kFileLines = 150;  ///< lines of a file; a limit of this project
};

/// Returns the faults of a file in gles_shaders/: in its name, header comment, length, or number of
/// main functions. `text` is the file as it is, before includes are resolved. One line per fault.
[[nodiscard]] std::vector<std::string> shaderFileFaults(std::string_view name,
                                                        std::string_view text);

/// Faults of a text with resolved includes: precision, forbidden words, image access, unresolved
/// #include, and undeclared macros. A line "// Variant: #define NAME value" in the text must
/// declare each macro that an #if uses.
[[nodiscard]] std::vector<std::string> shaderTextFaults(std::string_view text);

/// Faults of the linked shader: its storage blocks, images, bindings, group size and shared memory,
/// or that it does not compile alone. `name` ends with .comp, .frag or .vert. `defines` as in
/// gpu::Program. Needs a current GL context.
[[nodiscard]] std::vector<std::string>
shaderProgramFaults(std::string_view name, std::string_view text, std::string_view defines);

/// The "#define NAME value\n" of every "// Variant:" line in the text, and "" for the shader
/// without defines.
[[nodiscard]] std::vector<std::string> shaderVariants(std::string_view text);

}  // namespace mfar
