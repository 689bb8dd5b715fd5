#pragma once

#include "base/gl/pass_outputs.h"

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace mfar::gpu {

class Framebuffer;
class Program;
struct Binding;

/// Reports that a pass wrote a wrong value (NaN, infinity, or a value outside the range that its
/// shader states) or wrote beyond the end of a buffer.
struct ValidationFault {
    std::string pass;
    std::string output;  ///< variable in the shader; "guard": a write beyond the end of a buffer
    /// Position of the texel. For a buffer, x is the index of the element. If `output` is "guard",
    /// x is the name of the GL buffer and y is the number of the guard byte.
    int x = 0, y = 0;
    int component = 0;
    double value = 0;
    ValueRange range{};  ///< the allowed range; {0, 0}: any finite value is allowed
    long frame = 0;
};
[[nodiscard]] std::string describe(const ValidationFault& fault);

/// While a Validation object exists, the outputs of its thread's passes (outputsOf()) are read back
/// and checked. Images and colours are checked only if their texture stores floats. In a storage
/// buffer, only the values that the pass changed are checked: the rest of the buffer may come from
/// other passes, which have other ranges of values. A Buffer that is created while a Validation
/// object exists is followed by guard bytes. They must not change; read as floats, they are NaN. A
/// Texture of half floats that is created while a Validation object exists is filled with NaN, so
/// that reading texels that no pass wrote becomes visible. Validation makes a pass ten times as
/// slow. Without Validation, a pass only tests a pointer twice. The passes' GL context must be
/// current. The state of that context is restored. A thread has at most one Validation.
///
///     gpu::Validation validation;     // before the Pipeline is made
///     ... frames ...
///     for (const auto& fault : validation.takeFaults()) log(describe(fault));
class Validation {
public:
    Validation();
    Validation(const Validation&) = delete;
    Validation& operator=(const Validation&) = delete;
    ~Validation();

    /// Returns the faults since the last call, at most one (the first) for each output of a pass.
    [[nodiscard]] std::vector<ValidationFault> takeFaults();
    void nextFrame() { ++frame_; }

    struct Count {
        long runs = 0;
        long values = 0;  ///< number of texels and buffer elements that were read back
        long pixels = 0;  ///< number of pixels that were drawn or written to images
    };
    [[nodiscard]] const std::map<std::string, Count>& counts() const { return counts_; }

    static constexpr std::size_t kGuardBytes = 256;

    // Only Buffer, Texture and the passes call the following functions.
    static Validation* active();
    void guard(GLuint buffer, std::size_t bytes) { guarded_[buffer] = bytes; }
    /// Copies the storage buffers that the pass is about to write.
    void beforePass(const Program& program, std::initializer_list<Binding> bindings);
    void check(const Program& program, std::initializer_list<Binding> bindings,
               const Framebuffer* target);

private:
    struct Area {
        int x0 = 0, y0 = 0, width = 0, height = 0;
    };
    const std::vector<PassOutput>& outputs(const Program& program);
    void checkStorage(const std::string& pass, const PassOutput& output, GLuint buffer);
    void checkGuard(const std::string& pass, GLuint buffer, const std::uint8_t* end);
    void checkImage(const std::string& pass, const PassOutput& output, GLuint texture);
    void checkColour(const std::string& pass, const PassOutput& output, const Framebuffer& target);
    void checkPixels(const std::string& pass, const PassOutput& output, const Area& area);
    /// Checks `count` values. `before` holds the values from before the pass; values that did not
    /// change are not checked. If `before` is null, all values are checked.
    void checkValues(const std::string& pass, const PassOutput& output, const std::uint8_t* first,
                     const std::uint8_t* before, std::size_t count, const Area& area);
    void report(ValidationFault fault);

    std::map<std::string, Count> counts_;
    std::map<std::string, std::vector<PassOutput>> outputs_;
    std::map<GLuint, std::size_t> guarded_;
    std::map<GLuint, std::vector<std::uint8_t>> before_;  ///< storage buffers before the pass
    std::map<std::string, bool> reported_;
    std::vector<ValidationFault> faults_;
    long frame_ = 0;
};

}  // namespace mfar::gpu
