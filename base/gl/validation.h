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

/// A value that a pass must not write: NaN, infinite, or outside of the range that its shader
/// states.
struct ValidationFault {
    std::string pass;    ///< shader, e.g. "flow_search.comp"
    std::string output;  ///< the shader's variable, or "guard": a write beyond the end of a buffer
    int x = 0, y = 0;    ///< texel; in a buffer, x is the element
    int component = 0;
    double value = 0;
    ValueRange range{};  ///< zero where only finite values are required
    long frame = 0;      ///< number that nextFrame() counts
};
[[nodiscard]] std::string describe(const ValidationFault& fault);

/// While an object exists, everything that passes of its thread write is read back and checked, and
/// every Buffer created in that time is followed by guard bytes (NaN as floats) that must not
/// change. Without an object, a pass tests one pointer; with one, it is ten times as slow. Needs
/// the passes' context. One object a thread at a time; restores the GL state.
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

    /// The first bad value of each output since the last call; each output of a pass is reported
    /// once.
    [[nodiscard]] std::vector<ValidationFault> takeFaults();
    /// Increments the frame number that faults carry.
    void nextFrame() { ++frame_; }

    struct Count {
        long runs = 0;
        long values = 0;  ///< checked texels and elements of buffers
        long pixels = 0;  ///< pixels drawn or written to images
    };
    /// Keyed by the shader's name.
    [[nodiscard]] const std::map<std::string, Count>& counts() const { return counts_; }

    static constexpr std::size_t kGuardBytes = 256;

    // Called by Buffer and the passes.
    static Validation* active();
    /// Registers a buffer of this size, which guard bytes follow.
    void guard(GLuint buffer, std::size_t bytes) { guarded_[buffer] = bytes; }
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
    /// Reports the first of `count` elements that is invalid.
    void checkValues(const std::string& pass, const PassOutput& output, const std::uint8_t* first,
                     std::size_t count, const Area& area);
    void report(ValidationFault fault);

    std::map<std::string, Count> counts_;
    std::map<std::string, std::vector<PassOutput>> outputs_;  // key: shader
    std::map<GLuint, std::size_t> guarded_;
    std::map<std::string, bool> reported_;  // key: pass and output
    std::vector<ValidationFault> faults_;
    long frame_ = 0;
};

}  // namespace mfar::gpu
