#include "base/gl/pass_outputs.h"

#include <array>
#include <cstdlib>
#include <set>

namespace mfar::gpu {
namespace {

struct ValueType {
    bool isFloat;
    int components;  // 0: values of this type are not checked
};

ValueType valueTypeOf(GLint type) {
    switch (type) {
    case GL_FLOAT: return {true, 1};
    case GL_FLOAT_VEC2: return {true, 2};
    case GL_FLOAT_VEC3: return {true, 3};
    case GL_FLOAT_VEC4: return {true, 4};
    case GL_UNSIGNED_INT: return {false, 1};
    case GL_UNSIGNED_INT_VEC2: return {false, 2};
    case GL_UNSIGNED_INT_VEC3: return {false, 3};
    case GL_UNSIGNED_INT_VEC4: return {false, 4};
    default: return {false, 0};
    }
}

GLint activeCount(GLuint program, GLenum interface) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    return count;
}

template <std::size_t N>
std::array<GLint, N> propertiesOf(GLuint program, GLenum interface, GLuint index,
                                  const std::array<GLenum, N>& names) {
    std::array<GLint, N> out{};
    glGetProgramResourceiv(program, interface, index, N, names.data(), N, nullptr, out.data());
    return out;
}

/// Returns a variable's name without the block name, the array index and other parts that drivers
/// add.
std::string nameOf(GLuint program, GLenum interface, GLuint index) {
    std::array<char, 128> raw{};
    glGetProgramResourceName(program, interface, index, raw.size(), nullptr, raw.data());
    std::string name = raw.data();
    name = name.substr(0, name.find('['));
    const auto dot = name.rfind('.');
    return dot == std::string::npos ? name : name.substr(dot + 1);
}

std::set<GLint> readonlyBindings(std::string_view text) {
    constexpr std::string_view kReadonly = "readonly buffer", kBinding = "binding = ";
    std::set<GLint> out;
    for (auto at = text.find(kReadonly); at != std::string_view::npos;
         at = text.find(kReadonly, at + 1)) {
        const auto binding = text.rfind(kBinding, at);
        if (binding != std::string_view::npos)
            out.insert(std::atoi(text.data() + binding + kBinding.size()));
    }
    return out;
}

void addStorage(GLuint program, std::string_view text, std::vector<PassOutput>& out) {
    const std::set<GLint> readonly = readonlyBindings(text);
    const GLint variables = activeCount(program, GL_BUFFER_VARIABLE);
    for (GLint v = 0; v < variables; ++v) {
        const auto [type, offset, size, stride, block] =
            propertiesOf<5>(program, GL_BUFFER_VARIABLE, v,
                            {GL_TYPE, GL_OFFSET, GL_ARRAY_SIZE, GL_ARRAY_STRIDE, GL_BLOCK_INDEX});
        const GLint binding =
            propertiesOf<1>(program, GL_SHADER_STORAGE_BLOCK, block, {GL_BUFFER_BINDING})[0];
        const ValueType is = valueTypeOf(type);
        if (readonly.contains(binding) || is.components == 0) continue;
        PassOutput one{PassOutput::Kind::Storage,
                       nameOf(program, GL_BUFFER_VARIABLE, v),
                       static_cast<GLuint>(binding),
                       {},
                       is.isFloat,
                       is.components};
        one.offset = offset;
        one.stride = stride > 0 ? stride : 4 * is.components;
        one.count = size;
        out.push_back(std::move(one));
    }
}

void addImages(GLuint program, std::vector<PassOutput>& out) {
    const GLint uniforms = activeCount(program, GL_UNIFORM);
    for (GLint u = 0; u < uniforms; ++u) {
        const auto [type, location] =
            propertiesOf<2>(program, GL_UNIFORM, u, {GL_TYPE, GL_LOCATION});
        if (type != GL_IMAGE_2D) continue;
        GLint unit = 0;
        glGetUniformiv(program, location, &unit);
        out.push_back({PassOutput::Kind::Image,
                       nameOf(program, GL_UNIFORM, u),
                       static_cast<GLuint>(unit),
                       {}});
    }
}

void addColours(GLuint program, std::vector<PassOutput>& out) {
    const GLint colours = activeCount(program, GL_PROGRAM_OUTPUT);
    for (GLint c = 0; c < colours; ++c) {
        const auto [type, location] =
            propertiesOf<2>(program, GL_PROGRAM_OUTPUT, c, {GL_TYPE, GL_LOCATION});
        const ValueType is = valueTypeOf(type);
        if (location < 0 || !is.isFloat) continue;
        out.push_back({PassOutput::Kind::Colour,
                       nameOf(program, GL_PROGRAM_OUTPUT, c),
                       static_cast<GLuint>(location),
                       {},
                       true,
                       is.components});
    }
}

}  // namespace

std::vector<ValueRange> statedRanges(std::string_view text, std::string_view name) {
    const std::string wanted = "// Range: " + std::string(name) + " ";
    const auto at = text.find(wanted);
    std::vector<ValueRange> out;
    if (at == std::string_view::npos) return out;
    const std::string line(text.substr(at, text.find('\n', at) - at));
    for (std::size_t from = wanted.size(); from < line.size();) {
        const std::size_t dots = line.find("..", from), end = line.find(',', from);
        if (dots == std::string::npos || dots > end) break;
        out.push_back({std::strtod(line.substr(from, dots - from).c_str(), nullptr),
                       std::strtod(line.c_str() + dots + 2, nullptr)});
        from = end == std::string::npos ? line.size() : end + 1;
    }
    return out;
}

std::vector<PassOutput> outputsOf(GLuint program, std::string_view text) {
    std::vector<PassOutput> out;
    addStorage(program, text, out);
    addImages(program, out);
    addColours(program, out);
    for (PassOutput& one : out)
        one.ranges = statedRanges(text, one.name);
    return out;
}

}  // namespace mfar::gpu
