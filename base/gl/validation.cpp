#include "base/gl/validation.h"

#include "base/gl/pass.h"
#include "gles_shaders/shaders.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <span>
#include <utility>

namespace mfar::gpu {
namespace {

class ReadFrom {
public:
    explicit ReadFrom(GLuint framebuffer) {
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before_);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    }
    ReadFrom(const ReadFrom&) = delete;
    ReadFrom& operator=(const ReadFrom&) = delete;
    ~ReadFrom() { glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before_)); }

private:
    GLint before_ = 0;
};

class MappedBuffer {
public:
    explicit MappedBuffer(GLuint buffer) {
        glBindBuffer(GL_COPY_READ_BUFFER, buffer);
        glGetBufferParameteriv(GL_COPY_READ_BUFFER, GL_BUFFER_SIZE, &bytes_);
        data_ = static_cast<const std::uint8_t*>(
            glMapBufferRange(GL_COPY_READ_BUFFER, 0, bytes_, GL_MAP_READ_BIT));
        if (data_ == nullptr) throw GlError("the GPU buffer cannot be mapped for validation");
    }
    MappedBuffer(const MappedBuffer&) = delete;
    MappedBuffer& operator=(const MappedBuffer&) = delete;
    ~MappedBuffer() {
        glUnmapBuffer(GL_COPY_READ_BUFFER);
        glBindBuffer(GL_COPY_READ_BUFFER, 0);
    }

    [[nodiscard]] std::span<const std::uint8_t> bytes() const {
        return {data_, static_cast<std::size_t>(bytes_)};
    }

private:
    GLint bytes_ = 0;
    const std::uint8_t* data_ = nullptr;
};

Size sizeOf(GLuint texture) {
    GLint before = 0, width = 0, height = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &before);
    glBindTexture(GL_TEXTURE_2D, texture);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &height);
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before));
    return {width, height};
}

bool storesFloats(GLenum format) {
    const auto texels = static_cast<TexelFormat>(format);
    return texels == TexelFormat::R16F || texels == TexelFormat::Rg16F ||
           texels == TexelFormat::Rgba16F || texels == TexelFormat::R32F ||
           texels == TexelFormat::Rg32F || texels == TexelFormat::Rgba32F;
}

double valueAt(const std::uint8_t* at, bool isFloat) {
    if (isFloat) {
        float value = 0;
        std::memcpy(&value, at, sizeof value);
        return value;
    }
    std::uint32_t value = 0;
    std::memcpy(&value, at, sizeof value);
    return value;
}

}  // namespace

std::string describe(const ValidationFault& f) {
    std::array<char, 256> text{};
    const bool stated = f.range.low < f.range.high || f.range.low != 0;
    std::snprintf(text.data(), text.size(), "%s wrote %s(%d, %d)[%d] = %.9g", f.pass.c_str(),
                  f.output.c_str(), f.x, f.y, f.component, f.value);
    std::string out = text.data();
    if (stated) {
        std::snprintf(text.data(), text.size(), ", expected %g..%g", f.range.low, f.range.high);
        out += text.data();
    }
    return out + ", frame " + std::to_string(f.frame);
}

Validation::Validation() {
    assert(detail::validation == nullptr);
    detail::validation = this;
}

Validation::~Validation() {
    detail::validation = nullptr;
}

Validation* Validation::active() {
    return detail::validation;
}

std::vector<ValidationFault> Validation::takeFaults() {
    reported_.clear();
    return std::exchange(faults_, {});
}

void Validation::report(ValidationFault fault) {
    if (std::exchange(reported_[fault.pass + "/" + fault.output], true)) return;
    fault.frame = frame_;
    faults_.push_back(std::move(fault));
}

const std::vector<PassOutput>& Validation::outputs(const Program& program) {
    const std::string key = program.name() + "#" + std::to_string(program.id());
    const auto known = outputs_.find(key);
    if (known != outputs_.end()) return known->second;
    return outputs_[key] = outputsOf(program.id(), shaders::source(program.name()));
}

void Validation::beforePass(const Program& program, std::initializer_list<Binding> bindings) {
    before_.clear();
    for (const PassOutput& output : outputs(program))
        for (const Binding& bound : bindings)
            if (bound.index == output.index && bound.kind == Binding::Kind::Storage &&
                output.kind == PassOutput::Kind::Storage && !before_.contains(bound.id)) {
                const MappedBuffer mapped(bound.id);
                before_[bound.id].assign(mapped.bytes().begin(), mapped.bytes().end());
            }
}

void Validation::check(const Program& program, std::initializer_list<Binding> bindings,
                       const Framebuffer* target) {
    const std::string& pass = program.name();
    ++counts_[pass].runs;
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    for (const PassOutput& output : outputs(program)) {
        if (output.kind == PassOutput::Kind::Colour && target != nullptr)
            checkColour(pass, output, *target);
        for (const Binding& bound : bindings) {
            if (bound.index != output.index) continue;
            if (bound.kind == Binding::Kind::Storage && output.kind == PassOutput::Kind::Storage)
                checkStorage(pass, output, bound.id);
            if (bound.kind == Binding::Kind::ImageWrite && output.kind == PassOutput::Kind::Image &&
                storesFloats(bound.format))
                checkImage(pass, output, bound.id);
        }
    }
}

void Validation::checkStorage(const std::string& pass, const PassOutput& output, GLuint buffer) {
    const MappedBuffer mapped(buffer);
    const std::uint8_t* data = mapped.bytes().data();
    const auto guarded = guarded_.find(buffer);
    const std::size_t bytes = guarded != guarded_.end() ? guarded->second : mapped.bytes().size();
    if (bytes >= output.offset + 4UL * output.components) {
        const std::size_t room = (bytes - output.offset) / output.stride;
        const std::size_t count = output.count > 0 ? std::min(output.count, room) : room;
        checkValues(pass, output, data + output.offset, before_.at(buffer).data() + output.offset,
                    count, {});
        counts_[pass].values += static_cast<long>(count);
    }
    if (guarded != guarded_.end()) checkGuard(pass, buffer, data + bytes);
}

void Validation::checkGuard(const std::string& pass, GLuint buffer, const std::uint8_t* end) {
    for (std::size_t i = 0; i < kGuardBytes; ++i) {
        if (end[i] == 0xFF) continue;
        report({pass, "guard", static_cast<int>(buffer), static_cast<int>(i), 0,
                static_cast<double>(end[i])});
        return;
    }
}

void Validation::checkImage(const std::string& pass, const PassOutput& output, GLuint texture) {
    const Size size = sizeOf(texture);
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    {
        const ReadFrom from(framebuffer);
        glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture,
                               0);
        checkPixels(pass, output, {0, 0, size.width, size.height});
    }
    glDeleteFramebuffers(1, &framebuffer);
}

// Only pixels inside the scissor rectangle are checked, because the pass wrote no others.
void Validation::checkColour(const std::string& pass, const PassOutput& output,
                             const Framebuffer& target) {
    std::array<GLint, 4> box{0, 0, target.size().width, target.size().height};
    if (glIsEnabled(GL_SCISSOR_TEST) == GL_TRUE) {
        std::array<GLint, 4> scissor{};
        glGetIntegerv(GL_SCISSOR_BOX, scissor.data());
        const int x1 = std::min(box[2], scissor[0] + scissor[2]);
        const int y1 = std::min(box[3], scissor[1] + scissor[3]);
        box = {std::max(scissor[0], 0), std::max(scissor[1], 0), 0, 0};
        box[2] = x1 - box[0];
        box[3] = y1 - box[1];
    }
    if (box[2] <= 0 || box[3] <= 0) return;
    if (output.index == 0) counts_[pass].pixels += static_cast<long>(box[2]) * box[3];
    const ReadFrom from(target.id());
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + output.index;
    GLint type = 0;
    glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, attachment,
                                          GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
    if (type != GL_FLOAT) return;
    glReadBuffer(attachment);
    checkPixels(pass, output, {box[0], box[1], box[2], box[3]});
    glReadBuffer(GL_COLOR_ATTACHMENT0);
}

void Validation::checkPixels(const std::string& pass, const PassOutput& output, const Area& area) {
    const auto count = static_cast<std::size_t>(area.width) * area.height;
    std::vector<float> values(4 * count);
    glReadPixels(area.x0, area.y0, area.width, area.height, GL_RGBA, GL_FLOAT, values.data());
    PassOutput texels = output;
    texels.stride = 4 * sizeof(float);
    checkValues(pass, texels, reinterpret_cast<const std::uint8_t*>(values.data()), nullptr, count,
                area);
    counts_[pass].values += static_cast<long>(count);
    if (output.kind == PassOutput::Kind::Image && output.index == 0)
        counts_[pass].pixels += static_cast<long>(count);
}

void Validation::checkValues(const std::string& pass, const PassOutput& output,
                             const std::uint8_t* first, const std::uint8_t* before,
                             std::size_t count, const Area& area) {
    if (!output.isFloat && output.ranges.empty()) return;
    for (std::size_t i = 0; i < count; ++i) {
        for (int c = 0; c < output.components; ++c) {
            const std::size_t offset = i * output.stride + 4UL * c;
            if (before != nullptr && std::memcmp(first + offset, before + offset, 4) == 0) continue;
            const double value = valueAt(first + offset, output.isFloat);
            ValueRange range{};
            if (!output.ranges.empty())
                range = output.ranges[std::min<std::size_t>(c, output.ranges.size() - 1)];
            const bool sound = output.ranges.empty() ? std::isfinite(value)
                                                     : value >= range.low && value <= range.high;
            if (sound) continue;
            const int at = static_cast<int>(i);
            report({pass, output.name, area.x0 + (area.width > 0 ? at % area.width : at),
                    area.y0 + (area.width > 0 ? at / area.width : 0), c, value, range});
            return;
        }
    }
}

}  // namespace mfar::gpu
