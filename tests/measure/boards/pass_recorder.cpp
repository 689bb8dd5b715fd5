#include "tests/measure/boards/pass_recorder.h"

#include "base/gl/gl.h"
#include "gles_shaders/shaders.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace mfar::boards {
namespace {

PassRecorder* recorder = nullptr;

struct ShaderText {
    std::string name, defines;
};
std::map<GLuint, ShaderText> shaderTexts;
std::map<GLuint, std::vector<ShaderText>> programShaders;

/// Finds name and defines of a shader in its text. The text begins with gpu::shaderPreamble().
ShaderText textOf(const std::string& whole) {
    ShaderText out;
    const std::size_t head = whole.find('\n') + 1, end = whole.find("precision highp float;");
    if (end == std::string::npos) return out;
    out.defines = whole.substr(head, end - head);
    while (!out.defines.empty() && out.defines.back() == '\n')
        out.defines.pop_back();
    std::ranges::replace(out.defines, '\n', ' ');
    const auto all = shaders::all();
    const auto found =
        std::ranges::find_if(all, [&](const auto& source) { return whole.ends_with(source.text); });
    if (found != all.end()) out.name = found->name;
    return out;
}

GLint integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

GLint indexed(GLenum name, GLuint index) {
    GLint value = 0;
    glGetIntegeri_v(name, index, &value);
    return value;
}

std::int64_t bytesOfTexel(GLint format) {
    switch (format) {
    case GL_R8: return 1;
    case GL_RG8:
    case GL_R16I: return 2;
    case GL_RGBA8:
    case GL_R32F:
    case GL_R32UI:
    case GL_DEPTH_COMPONENT24:
    case GL_DEPTH_COMPONENT32F: return 4;
    case GL_RGBA16F:
    case GL_RGBA16I:
    case GL_RG32F: return 8;
    case GL_RGBA32F:
    case GL_RGBA32UI: return 16;
    default: throw std::runtime_error("texture of unknown format " + std::to_string(format));
    }
}

std::int64_t bytesOfBoundTexture() {
    GLint width = 0, height = 0, format = 0;
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &height);
    if (width == 0) return 0;
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    return bytesOfTexel(format) * width * height;
}

std::int64_t bytesOfTexture(GLuint id) {
    const GLint before = integer(GL_TEXTURE_BINDING_2D);
    glBindTexture(GL_TEXTURE_2D, id);
    const std::int64_t bytes = bytesOfBoundTexture();
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before));
    return bytes;
}

template <class T>
std::vector<T> contentOf(GLuint buffer, std::size_t offset, std::size_t count) {
    std::vector<T> out(count);
    const GLint before = integer(GL_COPY_READ_BUFFER_BINDING);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    glBindBuffer(GL_COPY_READ_BUFFER, buffer);
    const void* data =
        glMapBufferRange(GL_COPY_READ_BUFFER, static_cast<GLintptr>(offset),
                         static_cast<GLsizeiptr>(count * sizeof(T)), GL_MAP_READ_BIT);
    if (data != nullptr) std::memcpy(out.data(), data, count * sizeof(T));
    glUnmapBuffer(GL_COPY_READ_BUFFER);
    glBindBuffer(GL_COPY_READ_BUFFER, static_cast<GLuint>(before));
    return out;
}

std::int64_t bytesOfBuffer(GLuint buffer) {
    const GLint before = integer(GL_COPY_READ_BUFFER_BINDING);
    GLint64 bytes = 0;
    glBindBuffer(GL_COPY_READ_BUFFER, buffer);
    glGetBufferParameteri64v(GL_COPY_READ_BUFFER, GL_BUFFER_SIZE, &bytes);
    glBindBuffer(GL_COPY_READ_BUFFER, static_cast<GLuint>(before));
    return bytes;
}

struct Resource {
    std::string name;
    GLint type = 0, location = -1, block = -1, offset = 0;
};

std::vector<Resource> uniformsOf(GLuint program) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    std::vector<Resource> out;
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
        const std::array<GLenum, 4> wanted{GL_TYPE, GL_LOCATION, GL_BLOCK_INDEX, GL_OFFSET};
        std::array<GLint, 4> got{};
        std::array<char, 256> name{};
        glGetProgramResourceiv(program, GL_UNIFORM, i, 4, wanted.data(), 4, nullptr, got.data());
        glGetProgramResourceName(program, GL_UNIFORM, i, name.size(), nullptr, name.data());
        out.push_back({name.data(), got[0], got[1], got[2], got[3]});
    }
    return out;
}

GLint unitOf(GLuint program, const Resource& uniform) {
    GLint unit = 0;
    glGetUniformiv(program, uniform.location, &unit);
    return unit;
}

bool isImage(GLint type) {
    return type == GL_IMAGE_2D || type == GL_INT_IMAGE_2D || type == GL_UNSIGNED_INT_IMAGE_2D;
}

std::int64_t bytesSampledFrom(GLint unit) {
    const GLint before = integer(GL_ACTIVE_TEXTURE);
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    const std::int64_t bytes = bytesOfBoundTexture();
    glActiveTexture(static_cast<GLenum>(before));
    return bytes;
}

/// Bytes of the program's storage blocks. All bytes count as read, because searches and filters
/// write little to these blocks.
std::int64_t bytesOfStorage(GLuint program) {
    GLint count = 0;
    std::int64_t bytes = 0;
    glGetProgramInterfaceiv(program, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
        const GLenum wanted = GL_BUFFER_BINDING;
        GLint binding = 0;
        glGetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, i, 1, &wanted, 1, nullptr,
                               &binding);
        const GLint buffer =
            indexed(GL_SHADER_STORAGE_BUFFER_BINDING, static_cast<GLuint>(binding));
        bytes += bytesOfBuffer(static_cast<GLuint>(buffer));
    }
    return bytes;
}

/// Parameters of the current program, and the bytes that it accesses if it reads and writes its
/// textures and buffers once.
PassWork usedNow() {
    PassWork out;
    const auto program = static_cast<GLuint>(integer(GL_CURRENT_PROGRAM));
    for (const ShaderText& text : programShaders[program])
        if (!text.name.ends_with(".vert")) {
            out.shader = text.name;
            out.defines = text.defines;
        }
    const auto block = static_cast<GLuint>(indexed(GL_UNIFORM_BUFFER_BINDING, 0));
    for (const Resource& uniform : uniformsOf(program)) {
        if (uniform.type == GL_SAMPLER_2D || uniform.type == GL_INT_SAMPLER_2D ||
            uniform.type == GL_UNSIGNED_INT_SAMPLER_2D)
            out.bytesRead += bytesSampledFrom(unitOf(program, uniform));
        else if (isImage(uniform.type))
            out.bytesWritten += bytesOfTexture(static_cast<GLuint>(
                indexed(GL_IMAGE_BINDING_NAME, static_cast<GLuint>(unitOf(program, uniform)))));
        else if (uniform.block >= 0 && uniform.type == GL_INT)
            out.params[uniform.name.substr(uniform.name.rfind('.') + 1)] =
                contentOf<GLint>(block, static_cast<std::size_t>(uniform.offset), 1)[0];
    }
    out.bytesRead += bytesOfStorage(program);
    return out;
}

void recordDispatch(std::int64_t groups) {
    if (groups == 0) return;
    PassWork work = usedNow();
    std::array<GLint, 3> size{};
    glGetProgramiv(static_cast<GLuint>(integer(GL_CURRENT_PROGRAM)), GL_COMPUTE_WORK_GROUP_SIZE,
                   size.data());
    work.invocations = groups * size[0] * size[1] * size[2];
    recorder->add(std::move(work));
}

std::int64_t pixelsOfTarget() {
    std::array<GLint, 4> viewport{}, scissor{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    if (glIsEnabled(GL_SCISSOR_TEST) == GL_FALSE)
        return static_cast<std::int64_t>(viewport[2]) * viewport[3];
    glGetIntegerv(GL_SCISSOR_BOX, scissor.data());
    return static_cast<std::int64_t>(scissor[2]) * scissor[3];
}

std::int64_t bytesOfTargetPixel() {
    std::int64_t bytes = 0;
    for (GLuint i = 0; i < 4; ++i) {
        const GLenum at = GL_COLOR_ATTACHMENT0 + i;
        GLint type = 0, id = 0, format = 0;
        glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, at,
                                              GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
        if (type != GL_TEXTURE) continue;
        glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, at,
                                              GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &id);
        const GLint before = integer(GL_TEXTURE_BINDING_2D);
        glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(id));
        glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
        glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before));
        bytes += bytesOfTexel(format);
    }
    return bytes;
}

void recordDraw(std::int64_t vertices, std::int64_t pixels) {
    if (vertices == 0) return;
    PassWork work = usedNow();
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    const double share = std::min(1.0, static_cast<double>(pixels) /
                                           (static_cast<double>(viewport[2]) * viewport[3]));
    work.invocations = pixels;
    work.vertices = vertices;
    work.bytesRead = static_cast<std::int64_t>(static_cast<double>(work.bytesRead) * share);
    work.bytesWritten = bytesOfTargetPixel() * pixels;
    recorder->add(std::move(work));
}

/// Number of pixels of the render target per video tile. The render target can have another
/// resolution than the video.
std::int64_t pixelsOfTile(const PassWork& work) {
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    const auto columns = work.params.find("videoWidth"), rows = work.params.find("videoHeight");
    if (columns == work.params.end() || rows == work.params.end()) return 0;
    constexpr double kTile = 16;
    return static_cast<std::int64_t>(kTile * viewport[2] / columns->second * kTile * viewport[3] /
                                     rows->second);
}

}  // namespace

PassRecorder::PassRecorder() {
    recorder = this;
}
PassRecorder::~PassRecorder() {
    recorder = nullptr;
}

nlohmann::json jsonOf(const PassWork& work) {
    return {
        {"shader", work.shader},     {"defines", work.defines}, {"invocations", work.invocations},
        {"vertices", work.vertices}, {"read", work.bytesRead},  {"written", work.bytesWritten},
        {"params", work.params}};
}

}  // namespace mfar::boards

// The linker's option --wrap redirects the pipeline's GL calls to these functions.
using namespace mfar::boards;
extern "C" {

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): the linker's names
decltype(glShaderSource) __real_glShaderSource;
decltype(glAttachShader) __real_glAttachShader;
decltype(glDeleteProgram) __real_glDeleteProgram;
decltype(glDispatchCompute) __real_glDispatchCompute;
decltype(glDispatchComputeIndirect) __real_glDispatchComputeIndirect;
decltype(glDrawArrays) __real_glDrawArrays;
decltype(glDrawArraysIndirect) __real_glDrawArraysIndirect;

void __wrap_glShaderSource(GLuint shader, GLsizei count, const GLchar* const* text,
                           const GLint* length) {
    std::string whole;
    for (GLsizei i = 0; i < count; ++i)
        whole += length == nullptr ? std::string(text[i])
                                   : std::string(text[i], static_cast<std::size_t>(length[i]));
    shaderTexts[shader] = textOf(whole);
    __real_glShaderSource(shader, count, text, length);
}

void __wrap_glAttachShader(GLuint program, GLuint shader) {
    programShaders[program].push_back(shaderTexts[shader]);
    __real_glAttachShader(program, shader);
}

void __wrap_glDeleteProgram(GLuint program) {
    programShaders.erase(program);
    __real_glDeleteProgram(program);
}

void __wrap_glDispatchCompute(GLuint x, GLuint y, GLuint z) {
    if (recorder != nullptr) recordDispatch(static_cast<std::int64_t>(x) * y * z);
    __real_glDispatchCompute(x, y, z);
}

void __wrap_glDispatchComputeIndirect(GLintptr offset) {
    if (recorder != nullptr) {
        const auto groups =
            contentOf<GLuint>(static_cast<GLuint>(integer(GL_DISPATCH_INDIRECT_BUFFER_BINDING)),
                              static_cast<std::size_t>(offset), 3);
        recordDispatch(static_cast<std::int64_t>(groups[0]) * groups[1] * groups[2]);
    }
    __real_glDispatchComputeIndirect(offset);
}

void __wrap_glDrawArrays(GLenum mode, GLint first, GLsizei count) {
    if (recorder != nullptr) recordDraw(count, pixelsOfTarget());
    __real_glDrawArrays(mode, first, count);
}

void __wrap_glDrawArraysIndirect(GLenum mode, const void* indirect) {
    if (recorder != nullptr) {
        const auto command =
            contentOf<GLuint>(static_cast<GLuint>(integer(GL_DRAW_INDIRECT_BUFFER_BINDING)),
                              reinterpret_cast<std::size_t>(indirect), 2);
        const std::int64_t tiles = command[1];
        recordDraw(tiles * command[0], std::min(pixelsOfTarget(), tiles * pixelsOfTile(usedNow())));
    }
    __real_glDrawArraysIndirect(mode, indirect);
}

// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
}  // extern "C"
