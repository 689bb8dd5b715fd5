#include "base/gl/pass.h"

#include "base/gl/validation.h"
#include "gles_shaders/shaders.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

namespace mfar::gpu {
namespace {

GLuint compile(GLenum stage, std::string_view name, std::string_view defines) {
    const std::string body(shaders::source(name));
    const std::string head = shaderPreamble(defines);
    const std::array<const char*, 2> parts{head.c_str(), body.c_str()};
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 2, parts.data(), nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    std::array<char, 4096> log{};
    glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
    glDeleteShader(shader);
    throw GlError("shader " + std::string(name) + " does not compile: " + log.data());
}

}  // namespace

std::string shaderPreamble(std::string_view defines) {
    return "#version 310 es\n" + std::string(defines) +
           "precision highp float;\nprecision highp int;\n"
           "precision highp sampler2D;\nprecision highp usampler2D;\n"
           "precision highp isampler2D;\nprecision highp image2D;\n"
           "precision highp uimage2D;\nprecision highp iimage2D;\n#line 1\n";
}

class LinkedProgram {
public:
    LinkedProgram() : id_(glCreateProgram()) {}
    LinkedProgram(const LinkedProgram&) = delete;
    LinkedProgram& operator=(const LinkedProgram&) = delete;
    ~LinkedProgram() { glDeleteProgram(id_); }

    [[nodiscard]] GLuint id() const { return id_; }

private:
    GLuint id_;
};

namespace {

void finishLink(GLuint program, const std::string& name, std::size_t paramsBytes) {
    glLinkProgram(program);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok != GL_TRUE) {
        std::array<char, 4096> log{};
        glGetProgramInfoLog(program, log.size(), nullptr, log.data());
        throw GlError("shader " + name + " does not link: " + log.data());
    }
    const GLuint block = glGetUniformBlockIndex(program, "Params");
    if (block == GL_INVALID_INDEX)
        throw GlError("shader " + name + " has no active uniform block Params");
    GLint bytes = 0;
    glGetActiveUniformBlockiv(program, block, GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
    // Both sizes are compared as multiples of 16 bytes, because only some drivers count the padding
    // after the last member.
    if ((static_cast<std::size_t>(bytes) + 15) / 16 * 16 != paramsBytes)
        throw GlError("shader " + name + ": the shader's block Params has " +
                      std::to_string(bytes) + " bytes, but the program expects " +
                      std::to_string(paramsBytes));
    glUniformBlockBinding(program, block, 0);
}

}  // namespace

ProgramCache::~ProgramCache() = default;

ProgramCache::Use::Use(ProgramCache& cache) {
    detail::programs = &cache;
}
ProgramCache::Use::~Use() {
    detail::programs = nullptr;
}

Program::Program(std::string_view computeShader, std::string_view defines, std::size_t paramsBytes)
    : name_(computeShader) {
    link({{GL_COMPUTE_SHADER, computeShader}}, defines, paramsBytes);
}

Program::Program(std::string_view vertexShader, std::string_view fragmentShader,
                 std::string_view defines, std::size_t paramsBytes)
    : name_(fragmentShader) {
    link({{GL_VERTEX_SHADER, vertexShader}, {GL_FRAGMENT_SHADER, fragmentShader}}, defines,
         paramsBytes);
}

void Program::link(std::initializer_list<Shader> shaders, std::string_view defines,
                   std::size_t paramsBytes) {
    std::string text(defines);
    for (const auto& [stage, name] : shaders)
        text.append(name) += '\n';
    std::shared_ptr<const LinkedProgram> made;
    auto& linked = detail::programs != nullptr ? detail::programs->linked_[text] : made;
    if (linked == nullptr) {
        auto program = std::make_shared<const LinkedProgram>();
        for (const auto& [stage, name] : shaders) {
            const GLuint shader = compile(stage, name, defines);
            glAttachShader(program->id(), shader);
            glDeleteShader(shader);
        }
        finishLink(program->id(), name_, paramsBytes);
        linked = std::move(program);
    }
    linked_ = linked;
    params_ = Buffer(paramsBytes);
    checkErrors("Program");
}

GLuint Program::id() const {
    return linked_->id();
}

void Program::use(const void* params, std::size_t bytes, Bindings bindings) {
    if (detail::validation != nullptr) detail::validation->beforePass(*this, bindings);
    glUseProgram(linked_->id());
    params_.write(std::span(static_cast<const std::byte*>(params), bytes));
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, params_.id());
    for (const Binding& b : bindings) {
        switch (b.kind) {
        case Binding::Kind::Sampler:
            glActiveTexture(GL_TEXTURE0 + b.index);
            glBindTexture(GL_TEXTURE_2D, b.id);
            break;
        case Binding::Kind::ImageWrite:
            glBindImageTexture(b.index, b.id, 0, GL_FALSE, 0, GL_WRITE_ONLY, b.format);
            break;
        case Binding::Kind::Storage:
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, b.index, b.id);
            break;
        case Binding::Kind::Uniform: glBindBufferBase(GL_UNIFORM_BUFFER, b.index, b.id); break;
        }
    }
}

namespace detail {

void validate(const Program& program, Bindings bindings, const Framebuffer* target) {
    validation->check(program, bindings, target);
}

void drawFullScreen() {
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void drawTiles(const InstanceList& tiles) {
    glBindBuffer(GL_ARRAY_BUFFER, tiles.instances.id());
    glEnableVertexAttribArray(0);
    glVertexAttribIPointer(0, 1, GL_UNSIGNED_INT, sizeof(GLuint),
                           reinterpret_cast<const void*>(tiles.instanceOffset));
    glVertexAttribDivisor(0, 1);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, tiles.commands.id());
    glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(tiles.commandOffset));
    glDisableVertexAttribArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void drawMesh(const Mesh& mesh) {
    constexpr std::array<GLint, 3> kComponents{3, 3, 2};
    constexpr std::array<std::size_t, 3> kOffsets{
        offsetof(MeshVertex, position), offsetof(MeshVertex, normal), offsetof(MeshVertex, uv)};
    glBindBuffer(GL_ARRAY_BUFFER, mesh.vertices.id());
    for (GLuint i = 0; i < kComponents.size(); ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, kComponents[i], GL_FLOAT, GL_FALSE, sizeof(MeshVertex),
                              reinterpret_cast<const void*>(kOffsets[i]));
        glVertexAttribDivisor(i, 0);
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.indices.id());
    glDrawElements(GL_TRIANGLES, mesh.indexCount, GL_UNSIGNED_INT, nullptr);
    for (GLuint i = 0; i < kComponents.size(); ++i)
        glDisableVertexAttribArray(i);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

}  // namespace detail
}  // namespace mfar::gpu
