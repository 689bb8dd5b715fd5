// Compiles every shader of the program, in every variant, with the driver that mfard would use.
// Before each shader it prints a line "shader: NAME DEFINES", so that statistics that the driver
// prints can be assigned to the shader. The driver V3D prints them with
//   V3D_DEBUG=shaderdb mfar-compile-shaders 2>&1
// and the driver for Mali with BIFROST_MESA_DEBUG=shaderdb. Usage:
//   mfar-compile-shaders [--link-only] [--new-contexts] [FILE...]
// --link-only: draws and dispatches nothing. This is enough for the driver Panfrost, which compiles
// a shader when it is linked. On machines without its GPU (with Mesa's drm-shim), Panfrost crashes
// at dispatches and at shaders that spill registers. --new-contexts: compiles each shader in a new
// context, because V3D prints no statistics of a shader that the same context has already compiled,
// such as the vertex shader that a fragment shader was linked with. Not for Adreno: its driver also
// compiles its own shaders in each context, and their statistics would be taken for the shader's.
// FILE: a shader to be compiled instead, in the format of gles_shaders/, but with every #include
// resolved.
// Exit status 1: a shader did not compile.

#include "base/gl/buffer.h"
#include "base/gl/pass.h"
#include "base/gl/texture.h"
#include "gles_shaders/shaders.h"
#include "hal/gl_context.h"
#include "tests/engine/gles/shader_budget.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <regex>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {
namespace {

struct Shader {
    std::string name, text, defines;
};

class LinkedProgram {
public:
    explicit LinkedProgram(const std::vector<Shader>& shaders) : id_(glCreateProgram()) {
        for (const Shader& shader : shaders)
            attach(shader);
        glLinkProgram(id_);
        GLint ok = GL_FALSE;
        glGetProgramiv(id_, GL_LINK_STATUS, &ok);
        if (ok == GL_TRUE) return;
        std::array<char, 2048> text{};
        glGetProgramInfoLog(id_, text.size(), nullptr, text.data());
        log_ = log_.empty() ? text.data() : log_;
    }
    LinkedProgram(const LinkedProgram&) = delete;
    LinkedProgram& operator=(const LinkedProgram&) = delete;
    ~LinkedProgram() { glDeleteProgram(id_); }

    [[nodiscard]] GLuint id() const { return id_; }
    [[nodiscard]] const std::string& log() const { return log_; }

private:
    void attach(const Shader& shader) {
        const bool compute = shader.name.ends_with(".comp");
        const bool vertex = shader.name.ends_with(".vert");
        const GLuint id = glCreateShader(compute  ? GL_COMPUTE_SHADER
                                         : vertex ? GL_VERTEX_SHADER
                                                  : GL_FRAGMENT_SHADER);
        const std::string all = gpu::shaderPreamble(shader.defines) + shader.text;
        const char* source = all.c_str();
        glShaderSource(id, 1, &source, nullptr);
        glCompileShader(id);
        GLint ok = GL_FALSE;
        glGetShaderiv(id, GL_COMPILE_STATUS, &ok);
        if (ok != GL_TRUE) {
            std::array<char, 2048> text{};
            glGetShaderInfoLog(id, text.size(), nullptr, text.data());
            log_ = std::string("the shader does not compile: ") + text.data();
        }
        glAttachShader(id_, id);
        glDeleteShader(id);
    }

    GLuint id_;
    std::string log_;
};

struct ImageFormat {
    std::string_view name;
    gpu::TexelFormat format;
};

constexpr std::array kImageFormats{
    ImageFormat{"rgba8", gpu::TexelFormat::Rgba8},
    ImageFormat{"r32f", gpu::TexelFormat::R32F},
    ImageFormat{"rgba16f", gpu::TexelFormat::Rgba16F},
    ImageFormat{"rgba16i", gpu::TexelFormat::Rgba16I},
    ImageFormat{"rgba32f", gpu::TexelFormat::Rgba32F},
};

/// Creates a one-pixel image for each image binding of the shader. Without images a driver may
/// abort or hang while it generates the final code.
std::vector<gpu::Texture> boundImages(const std::string& text) {
    static const std::regex declared("layout\\(([^)]*)\\)[^;]*\\b[iu]?image2D\\b");
    static const std::regex binding("binding = ([0-9]+)");
    std::vector<gpu::Texture> images;
    for (std::sregex_iterator i(text.begin(), text.end(), declared), end; i != end; ++i) {
        const std::string layout = (*i)[1];
        std::smatch unit;
        const auto* known = std::ranges::find_if(kImageFormats, [&](const ImageFormat& f) {
            return std::regex_search(layout, std::regex("\\b" + std::string(f.name) + "\\b"));
        });
        if (known == kImageFormats.end() || !std::regex_search(layout, unit, binding))
            throw std::runtime_error("an image of unknown format or binding: " + layout);
        images.emplace_back(Size{1, 1}, known->format);
        glBindImageTexture(static_cast<GLuint>(std::stoi(unit[1])), images.back().id(), 0, GL_FALSE,
                           0, GL_WRITE_ONLY, static_cast<GLenum>(known->format));
    }
    return images;
}

/// Runs a shader once, on buffers of zeros and one-pixel targets, because drivers generate the
/// final code of a shader when it is first used.
class Use {
public:
    explicit Use(bool runs) : runs_(runs) {
        const std::array<const gpu::Texture*, 3> targets{&targets_[0], &targets_[1], &targets_[2]};
        target_ = gpu::Framebuffer(targets);
        target_.bind();
        for (GLuint i = 0; i < ShaderBudget::kStorageBlocks; ++i) {
            glBindBufferBase(GL_UNIFORM_BUFFER, i, zeros_.id());
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, zeros_.id());
        }
    }
    void compute(const LinkedProgram& program, const std::string& text) {
        if (!runs_) return;
        const std::vector<gpu::Texture> images = boundImages(text);
        glUseProgram(program.id());
        glDispatchCompute(1, 1, 1);
        gpu::checkErrors("dispatch");
    }
    void draw(const LinkedProgram& program) {
        if (!runs_) return;
        glUseProgram(program.id());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        gpu::checkErrors("draw");
    }

private:
    static constexpr Size kPixel{1, 1};
    bool runs_;
    gpu::Buffer zeros_{65536};
    std::array<gpu::Texture, 3> targets_{gpu::Texture(kPixel, gpu::TexelFormat::Rgba8),
                                         gpu::Texture(kPixel, gpu::TexelFormat::Rgba8),
                                         gpu::Texture(kPixel, gpu::TexelFormat::Rgba8)};
    gpu::Framebuffer target_;
};

/// Draws with a fragment or vertex shader and the first shader of the other kind that links with
/// it. Returns the message if the shader does not compile or link.
std::string drawn(const Shader& shader, Use& use) {
    const bool vertex = shader.name.ends_with(".vert");
    std::string log = "no shader of the other stage links with it";
    for (const shaders::Source& s : shaders::all()) {
        if (!s.name.ends_with(vertex ? ".frag" : ".vert")) continue;
        const LinkedProgram program(
            {shader, {std::string(s.name), std::string(s.text), shader.defines}});
        log = program.log();
        if (!log.empty()) continue;
        use.draw(program);
        break;
    }
    return log;
}

bool compiles(const Shader& shader, Use& use) {
    const std::string defines = shader.defines.empty() ? "\n" : " " + shader.defines;
    std::printf("shader: %s%s", shader.name.c_str(), defines.c_str());
    std::fflush(stdout);
    std::string log;
    if (shader.name.ends_with(".comp")) {
        const LinkedProgram program({shader});
        log = program.log();
        if (log.empty()) use.compute(program, shader.text);
    } else {
        log = drawn(shader, use);
    }
    glFinish();
    if (!log.empty()) std::fprintf(stderr, "%s: %s\n", shader.name.c_str(), log.c_str());
    return log.empty();
}

void addVariants(std::string_view name, const std::string& text, std::vector<Shader>& out) {
    for (const std::string& defines : shaderVariants(text))
        out.push_back({std::string(name), text, defines});
}

std::vector<Shader> wanted(const std::vector<std::string>& files) {
    std::vector<Shader> out;
    for (const std::string& path : files) {
        std::ifstream file(path, std::ios::binary);
        if (!file) throw std::runtime_error(path + " cannot be read");
        addVariants(path, {std::istreambuf_iterator<char>(file), {}}, out);
    }
    if (!files.empty()) return out;
    for (const shaders::Source& s : shaders::all())
        addVariants(s.name, std::string(s.text), out);
    return out;
}

/// Compiles the shaders in one context. Returns how many did not compile.
std::size_t failures(std::span<const Shader> shaders, bool runs) {
    const std::unique_ptr<GlContext> context = createGlContext();
    std::printf("%s\n", context->description().c_str());
    Use use(runs);
    std::size_t failed = 0;
    for (const Shader& shader : shaders)
        failed += compiles(shader, use) ? 0U : 1U;
    return failed;
}

int compileAll(std::span<const Shader> shaders, bool runs, bool newContexts) {
    const std::size_t step = newContexts ? 1 : shaders.size();
    std::size_t failed = 0;
    for (std::size_t i = 0; i < shaders.size(); i += step)
        failed += failures(shaders.subspan(i, step), runs);
    std::printf("%zu compiled, %zu failed\n", shaders.size() - failed, failed);
    return failed == 0 && !shaders.empty() ? 0 : 1;
}

}  // namespace
}  // namespace mfar

int main(int argc, char** argv) {
    try {
        std::vector<std::string> files(argv + 1, argv + argc);
        const bool runs = std::erase(files, "--link-only") == 0;
        const bool newContexts = std::erase(files, "--new-contexts") > 0;
        return mfar::compileAll(mfar::wanted(files), runs, newContexts);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "mfar-compile-shaders: %s\n", error.what());
        return 1;
    }
}
