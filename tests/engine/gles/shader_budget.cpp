#include "tests/engine/gles/shader_budget.h"

#include "base/gl/pass.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <regex>
#include <set>

namespace mfar {
namespace {

using Faults = std::vector<std::string>;

std::string withoutComments(std::string_view text) {
    static const std::regex kComment(R"(//[^\n]*|/\*[^*]*\*+(?:[^/*][^*]*\*+)*/)");
    return std::regex_replace(std::string(text), kComment, " ");
}

bool found(const std::string& code, const char* pattern) {
    return std::regex_search(code, std::regex(pattern));
}

long mainFunctions(std::string_view text) {
    const std::string code = withoutComments(text);
    static const std::regex kMain(R"(\bvoid\s+main\s*\()");
    return std::distance(std::sregex_iterator(code.begin(), code.end(), kMain),
                         std::sregex_iterator());
}

void checkImages(const std::string& code, Faults& faults) {
    static const std::regex kImage(R"([^;{}]*\b[iu]?image(?:2D|3D|Cube|2DArray)\s+(\w+)\s*[;\[])");
    for (std::sregex_iterator it(code.begin(), code.end(), kImage), end; it != end; ++it) {
        const std::string declaration = it->str();
        if (!found(declaration, R"(\buniform\b)")) continue;
        if (found(declaration, R"(\b(readonly|writeonly)\b)")) continue;
        faults.push_back("image " + it->str(1) + " is neither readonly nor writeonly");
        if (found(declaration, R"(\brgba16f\b)"))
            faults.push_back("image " + it->str(1) +
                             " is rgba16f, which OpenGL ES 3.1 cannot both read and write");
    }
}

void checkVariantsAreNamed(std::string_view text, const std::string& code, Faults& faults) {
    static const std::regex kTested(R"(#\s*ifn?def\s+(\w+)|\bdefined\s*\(?\s*(\w+))");
    std::string named;
    for (const std::string& variant : shaderVariants(text))
        named += variant;
    for (std::sregex_iterator it(code.begin(), code.end(), kTested), end; it != end; ++it) {
        const std::string macro = (*it)[1].matched ? it->str(1) : it->str(2);
        if (!found(named, ("\\b" + macro + "\\b").c_str()))
            faults.push_back("macro " + macro + " has no '// Variant:' line");
    }
}

class LinkedShader {
public:
    LinkedShader(std::string_view name, std::string_view text, std::string_view defines) {
        const std::string all = gpu::shaderPreamble(defines) + std::string(text);
        const char* source = all.c_str();
        id_ = glCreateShaderProgramv(stageOf(name), 1, &source);
    }
    LinkedShader(const LinkedShader&) = delete;
    LinkedShader& operator=(const LinkedShader&) = delete;
    ~LinkedShader() { glDeleteProgram(id_); }

    [[nodiscard]] GLuint id() const { return id_; }
    [[nodiscard]] bool linked() const {
        GLint ok = GL_FALSE;
        glGetProgramiv(id_, GL_LINK_STATUS, &ok);
        return ok == GL_TRUE;
    }
    [[nodiscard]] std::string log() const {
        std::array<char, 2048> log{};
        glGetProgramInfoLog(id_, log.size(), nullptr, log.data());
        return log.data();
    }
    [[nodiscard]] GLint count(GLenum interface) const {
        GLint n = 0;
        glGetProgramInterfaceiv(id_, interface, GL_ACTIVE_RESOURCES, &n);
        return n;
    }
    [[nodiscard]] GLint property(GLenum interface, GLint index, GLenum what) const {
        GLint value = 0;
        glGetProgramResourceiv(id_, interface, static_cast<GLuint>(index), 1, &what, 1, nullptr,
                               &value);
        return value;
    }
    [[nodiscard]] std::string resource(GLenum interface, GLint index) const {
        std::array<char, 256> name{};
        glGetProgramResourceName(id_, interface, static_cast<GLuint>(index), name.size(), nullptr,
                                 name.data());
        return name.data();
    }

private:
    static GLenum stageOf(std::string_view name) {
        if (name.ends_with(".comp")) return GL_COMPUTE_SHADER;
        return name.ends_with(".vert") ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER;
    }

    GLuint id_ = 0;
};

void checkStorage(const LinkedShader& shader, bool vertex, Faults& faults) {
    const GLint blocks = shader.count(GL_SHADER_STORAGE_BLOCK);
    if (vertex && blocks > 0) faults.push_back("a vertex shader must not use storage blocks");
    if (blocks > ShaderBudget::kStorageBlocks)
        faults.push_back(std::to_string(blocks) + " storage blocks; 4 are guaranteed");
    for (GLint i = 0; i < blocks; ++i) {
        const GLint binding = shader.property(GL_SHADER_STORAGE_BLOCK, i, GL_BUFFER_BINDING);
        if (binding >= ShaderBudget::kStorageBlocks)
            faults.push_back("storage block " + shader.resource(GL_SHADER_STORAGE_BLOCK, i) +
                             " at binding " + std::to_string(binding) +
                             "; bindings must be below 4");
    }
}

bool isImage(GLint type) {
    constexpr std::array<GLint, 12> kTypes{GL_IMAGE_2D,
                                           GL_IMAGE_3D,
                                           GL_IMAGE_CUBE,
                                           GL_IMAGE_2D_ARRAY,
                                           GL_INT_IMAGE_2D,
                                           GL_INT_IMAGE_3D,
                                           GL_INT_IMAGE_CUBE,
                                           GL_INT_IMAGE_2D_ARRAY,
                                           GL_UNSIGNED_INT_IMAGE_2D,
                                           GL_UNSIGNED_INT_IMAGE_3D,
                                           GL_UNSIGNED_INT_IMAGE_CUBE,
                                           GL_UNSIGNED_INT_IMAGE_2D_ARRAY};
    return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

void checkImageCount(const LinkedShader& shader, bool vertex, Faults& faults) {
    GLint images = 0;
    for (GLint i = 0; i < shader.count(GL_UNIFORM); ++i) {
        if (!isImage(shader.property(GL_UNIFORM, i, GL_TYPE))) continue;
        const GLint elements = shader.property(GL_UNIFORM, i, GL_ARRAY_SIZE);
        images += elements;
        const std::string name = shader.resource(GL_UNIFORM, i);
        GLint binding = 0;
        glGetUniformiv(shader.id(), glGetUniformLocation(shader.id(), name.c_str()), &binding);
        if (binding + elements > ShaderBudget::kImages)
            faults.push_back("image " + name + " at binding " + std::to_string(binding) +
                             "; bindings must be below 4");
    }
    if (vertex && images > 0) faults.push_back("a vertex shader must not use images");
    if (images > ShaderBudget::kImages)
        faults.push_back(std::to_string(images) + " images; 4 are guaranteed");
}

void checkGroup(const LinkedShader& shader, Faults& faults) {
    std::array<GLint, 3> size{};
    glGetProgramiv(shader.id(), GL_COMPUTE_WORK_GROUP_SIZE, size.data());
    const GLint invocations = size[0] * size[1] * size[2];
    if (invocations > ShaderBudget::kInvocations)
        faults.push_back(std::to_string(invocations) +
                         " invocations in a work group; 128 are guaranteed");
}

// OpenGL ES does not report the size of shared variables. So this function moves them into storage
// blocks, whose size can be queried. The compiler then evaluates the array lengths.
void checkShared(std::string_view name, std::string_view text, std::string_view defines,
                 Faults& faults) {
    std::string code = withoutComments(text);
    static const std::regex kShared(R"(\bshared\s+([^;]+;))");
    for (int n = 0; std::regex_search(code, kShared); ++n) {
        const std::string block =
            "layout(std430) buffer SharedProbe" + std::to_string(n) + " { $1 };";
        code = std::regex_replace(code, kShared, block, std::regex_constants::format_first_only);
    }
    const LinkedShader shader(name, code, defines);
    if (!shader.linked()) {
        faults.push_back("shared memory cannot be measured: " + shader.log());
        return;
    }
    GLint bytes = 0;
    for (GLint i = 0; i < shader.count(GL_SHADER_STORAGE_BLOCK); ++i)
        if (shader.resource(GL_SHADER_STORAGE_BLOCK, i).starts_with("SharedProbe"))
            bytes += shader.property(GL_SHADER_STORAGE_BLOCK, i, GL_BUFFER_DATA_SIZE);
    if (bytes > ShaderBudget::kSharedBytes)
        faults.push_back(std::to_string(bytes) + " bytes of shared memory; 16384 are guaranteed");
}

}  // namespace

std::vector<std::string> shaderVariants(std::string_view text) {
    std::vector<std::string> variants{""};
    const std::string all(text);
    static const std::regex kVariant(R"(//\s*Variant:\s*(#define[^\n]*))");
    for (std::sregex_iterator it(all.begin(), all.end(), kVariant), end; it != end; ++it)
        variants.push_back(it->str(1) + "\n");
    return variants;
}

std::vector<std::string> shaderFileFaults(std::string_view name, std::string_view text) {
    Faults faults;
    const bool shared = name.ends_with(".glsl");
    if (!found(std::string(name), "^[a-z0-9]+(_[a-z0-9]+)*\\.(comp|frag|vert|glsl)$"))
        faults.emplace_back("the name is not <stage>_<step>.comp, .frag, .vert or .glsl");
    if (!text.starts_with("//")) faults.emplace_back("no header comment");
    if (std::count(text.begin(), text.end(), '\n') > ShaderBudget::kFileLines)
        faults.push_back("more than " + std::to_string(ShaderBudget::kFileLines) + " lines");
    if (mainFunctions(text) != (shared ? 0 : 1))
        faults.emplace_back(shared ? "main() in a shared file" : "not exactly one main()");
    return faults;
}

std::vector<std::string> shaderTextFaults(std::string_view text) {
    Faults faults;
    const std::string code = withoutComments(text);
    if (found(code, R"(\b(mediump|lowp)\b)")) faults.emplace_back("precision below highp");
    if (found(code, R"(\b(double|dvec[234]|dmat[234])\b)")) faults.emplace_back("uses fp64");
    if (found(code, R"(\bfma\s*\()")) faults.emplace_back("uses fma()");
    if (found(code, R"(#\s*extension\b)")) faults.emplace_back("uses #extension");
    if (found(code, R"(#\s*version\b)")) faults.emplace_back("has #version, as the preamble does");
    if (found(code, R"(#\s*include\b)"))
        faults.emplace_back("has an #include that was not resolved");
    checkImages(code, faults);
    checkVariantsAreNamed(text, code, faults);
    return faults;
}

std::vector<std::string> shaderProgramFaults(std::string_view name, std::string_view text,
                                             std::string_view defines) {
    Faults faults;
    const LinkedShader shader(name, text, defines);
    if (!shader.linked()) return {"does not compile: " + shader.log()};
    const bool vertex = name.ends_with(".vert");
    checkStorage(shader, vertex, faults);
    checkImageCount(shader, vertex, faults);
    if (name.ends_with(".comp")) {
        checkGroup(shader, faults);
        checkShared(name, text, defines, faults);
    }
    return faults;
}

}  // namespace mfar
