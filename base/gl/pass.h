#pragma once

#include "base/gl/buffer.h"
#include "base/gl/texture.h"

#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace mfar::gpu {

/// A resource that is bound to a binding point of a shader.
struct Binding {
    enum class Kind { Sampler, ImageWrite, Storage, Uniform };
    Kind kind;
    GLuint index;
    GLuint id;
    GLenum format = 0;
};

inline Binding sampler(GLuint unit, const Texture& t) {
    return {Binding::Kind::Sampler, unit, t.id()};
}
inline Binding imageWrite(GLuint unit, const Texture& t) {
    return {Binding::Kind::ImageWrite, unit, t.id(), static_cast<GLenum>(t.format())};
}
inline Binding storage(GLuint index, const Buffer& b) {
    return {Binding::Kind::Storage, index, b.id()};
}

using Bindings = std::initializer_list<Binding>;

class Program;
class ProgramCache;
class Validation;
namespace detail {
/// The program cache of this thread; null: the thread does not share programs.
inline constinit thread_local ProgramCache* programs = nullptr;
/// The Validation that this thread uses; null: the thread's passes are not validated.
inline constinit thread_local Validation* validation = nullptr;
void validate(const Program& program, Bindings bindings, const Framebuffer* target);
inline void ran(const Program& program, Bindings bindings, const Framebuffer* target = nullptr) {
    if (validation != nullptr) validate(program, bindings, target);
}
}  // namespace detail

struct Groups {
    GLuint x = 1, y = 1, z = 1;
};
[[nodiscard]] constexpr GLuint groupsFor(int items, int perGroup) {
    return static_cast<GLuint>((items + perGroup - 1) / perGroup);
}

/// Returns the text that precedes every shader: the version, `defines`, and highp as the default
/// precision.
[[nodiscard]] std::string shaderPreamble(std::string_view defines);

class LinkedProgram;

/// Compiled programs that several passes share. While a ProgramCache::Use exists, its thread
/// compiles each shader text once; all passes created with the same text share the program. A cache
/// belongs to one GL context. That context must be current when the cache is destroyed.
class ProgramCache {
public:
    ProgramCache() = default;
    ProgramCache(const ProgramCache&) = delete;
    ProgramCache& operator=(const ProgramCache&) = delete;
    ~ProgramCache();

    class Use {
    public:
        explicit Use(ProgramCache& cache);
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;
        ~Use();
    };

private:
    friend class Program;
    std::map<std::string, std::shared_ptr<const LinkedProgram>> linked_;
};

/// A linked program with its uniform block `Params` (binding 0). ComputePass and DrawPass are typed
/// wrappers of it. The constructors throw GlError, e.g. with the shader's name and the compiler's
/// message, or if the block does not have `paramsBytes` bytes.
class Program {
public:
    /// `defines`: lines that are inserted after #version, e.g. "#define TWO_WAY 1\n".
    Program(std::string_view computeShader, std::string_view defines, std::size_t paramsBytes);
    Program(std::string_view vertexShader, std::string_view fragmentShader,
            std::string_view defines, std::size_t paramsBytes);

    void use(const void* params, std::size_t bytes, Bindings bindings);
    [[nodiscard]] GLuint id() const;
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    using Shader = std::pair<GLenum, std::string_view>;
    void link(std::initializer_list<Shader> shaders, std::string_view defines,
              std::size_t paramsBytes);

    std::shared_ptr<const LinkedProgram> linked_;
    std::string name_;
    Buffer params_;
};

/// A list of tiles, for an instanced draw with one quad per tile. A compute pass writes the list.
struct InstanceList {
    const Buffer& commands;  ///< contains one DrawArraysIndirect command at `commandOffset` [bytes]
    std::size_t commandOffset;
    /// One uint per instance, read as vertex attribute 0. The first is at `instanceOffset` [bytes].
    const Buffer& instances;
    std::size_t instanceOffset = 0;
};

struct Mesh {
    const Buffer& vertices;  ///< MeshVertex, attribute locations 0 (position), 1 (normal), 2 (uv)
    const Buffer& indices;   ///< three uints per triangle
    int indexCount;
};
struct MeshVertex {
    float position[3], normal[3], uv[2];
};

namespace detail {
void drawMesh(const Mesh& mesh);
void drawFullScreen();
void drawTiles(const InstanceList& tiles);
}  // namespace detail

/// A compute shader with its parameter block. `P` has the layout of the shader's std140 block
/// `Params`; the constructor checks that both have the same size. run() and runIndirect() issue the
/// memory barriers that later readers of the outputs need.
template <class P>
class ComputePass {
    static_assert(std::is_trivially_copyable_v<P> && sizeof(P) % 16 == 0, "std140 block");

public:
    explicit ComputePass(std::string_view shader, std::string_view defines = {})
        : program_(shader, defines, sizeof(P)) {}

    void run(const P& params, Bindings bindings, Groups groups) {
        program_.use(&params, sizeof(P), bindings);
        glDispatchCompute(groups.x, groups.y, groups.z);
        glMemoryBarrier(kBarriers);
        detail::ran(program_, bindings);
    }
    /// Runs the shader. The GPU reads the numbers of workgroups in x, y and z from `commands`:
    /// three uints at `offset` [bytes].
    void runIndirect(const P& params, Bindings bindings, const Buffer& commands,
                     std::size_t offset) {
        program_.use(&params, sizeof(P), bindings);
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, commands.id());
        glDispatchComputeIndirect(static_cast<GLintptr>(offset));
        glMemoryBarrier(kBarriers);
        detail::ran(program_, bindings);
    }

private:
    static constexpr GLbitfield kBarriers =
        GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
        GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
        GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT;
    Program program_;
};

/// A fragment shader that draws over the whole target, a list of tiles, or a mesh.
template <class P>
class DrawPass {
    static_assert(std::is_trivially_copyable_v<P> && sizeof(P) % 16 == 0, "std140 block");

public:
    explicit DrawPass(std::string_view fragment, std::string_view defines = {})
        : DrawPass("fullscreen.vert", fragment, defines) {}
    DrawPass(std::string_view vertex, std::string_view fragment, std::string_view defines)
        : program_(vertex, fragment, defines, sizeof(P)) {}

    void run(const P& params, Bindings bindings, const Framebuffer& target) {
        target.bind();
        program_.use(&params, sizeof(P), bindings);
        detail::drawFullScreen();
        detail::ran(program_, bindings, &target);
    }
    void runTiles(const P& params, Bindings bindings, const Framebuffer& target,
                  const InstanceList& tiles) {
        target.bind();
        program_.use(&params, sizeof(P), bindings);
        detail::drawTiles(tiles);
        detail::ran(program_, bindings, &target);
    }
    void runMesh(const P& params, Bindings bindings, const Framebuffer& target, const Mesh& mesh) {
        target.bind();
        program_.use(&params, sizeof(P), bindings);
        detail::drawMesh(mesh);
        detail::ran(program_, bindings, &target);
    }

private:
    Program program_;
};

}  // namespace mfar::gpu
