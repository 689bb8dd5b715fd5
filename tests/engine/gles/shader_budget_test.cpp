#include "gles_shaders/shaders.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/gles/shader_budget.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace mfar {
namespace {

namespace fs = std::filesystem;

using ShaderBudgetGl = GlTest;

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

bool isShader(const fs::path& path) {
    const std::set<std::string> endings{".comp", ".frag", ".vert", ".glsl"};
    return endings.contains(path.extension().string());
}

void expectFault(const std::vector<std::string>& faults, const std::string& words) {
    for (const std::string& fault : faults)
        if (fault.find(words) != std::string::npos) return;
    ADD_FAILURE() << "no fault contains: " << words << " in " << testing::PrintToString(faults);
}

std::string compute(const std::string& globals, const std::string& body,
                    const std::string& size = "local_size_x = 64") {
    return "// A test.\nlayout(" + size + ") in;\n" + globals + "void main() {" + body + "}\n";
}

TEST(ShaderBudget, FilesFollowTheConventions) {
    int files = 0;
    for (const auto& entry : fs::directory_iterator(MFAR_SHADER_DIR)) {
        if (!isShader(entry.path())) continue;
        ++files;
        const std::string name = entry.path().filename();
        for (const std::string& fault : shaderFileFaults(name, readFile(entry.path())))
            ADD_FAILURE() << name << ": " << fault;
    }
    EXPECT_GT(files, 0);
}

TEST(ShaderBudget, EveryShaderFileIsEmbedded) {
    std::set<std::string> embedded;
    for (const shaders::Source& s : shaders::all())
        embedded.emplace(s.name);
    for (const auto& entry : fs::directory_iterator(MFAR_SHADER_DIR)) {
        const bool program = isShader(entry.path()) && entry.path().extension() != ".glsl";
        if (program) {
            EXPECT_TRUE(embedded.contains(entry.path().filename())) << entry.path();
        }
    }
}

TEST(ShaderBudget, TextsStayWithinThePortableFloor) {
    for (const shaders::Source& s : shaders::all())
        for (const std::string& fault : shaderTextFaults(s.text))
            ADD_FAILURE() << s.name << ": " << fault;
}

TEST_F(ShaderBudgetGl, EveryVariantStaysWithinThePortableFloor) {
    ASSERT_FALSE(shaders::all().empty());
    for (const shaders::Source& s : shaders::all())
        for (const std::string& defines : shaderVariants(s.text))
            for (const std::string& fault : shaderProgramFaults(s.name, s.text, defines))
                ADD_FAILURE() << s.name << " " << defines << ": " << fault;
}

TEST(ShaderBudgetChecker, FindsFaultsOfNameHeaderAndLengthOfFiles) {
    const std::string good = "// Fills.\nvoid main() {\n}\n";
    EXPECT_TRUE(shaderFileFaults("test_fill.comp", good).empty());
    EXPECT_TRUE(shaderFileFaults("test_shared.glsl", "// Shared.\n").empty());
    expectFault(shaderFileFaults("Test-Fill.comp", good), "the name");
    expectFault(shaderFileFaults("test.comp", "void main() {}"), "no header comment");
    expectFault(shaderFileFaults("test.comp", good + std::string(150, '\n')), "more than 150");
    expectFault(shaderFileFaults("test.comp", good + good), "not exactly one main()");
    expectFault(shaderFileFaults("test.comp", "// void main() {}\n"), "not exactly one main()");
    expectFault(shaderFileFaults("test.glsl", good), "main() in a shared file");
}

TEST(ShaderBudgetChecker, FindsForbiddenWords) {
    EXPECT_TRUE(shaderTextFaults("// mediump, fma(), double\nfloat doubled = fmax_(1.0);").empty());
    expectFault(shaderTextFaults("mediump float x;"), "precision below highp");
    expectFault(shaderTextFaults("precision lowp float;"), "precision below highp");
    expectFault(shaderTextFaults("dvec3 x;"), "fp64");
    expectFault(shaderTextFaults("float x = fma (a, b, c);"), "fma()");
    expectFault(shaderTextFaults("#extension GL_EXT_x : require\n"), "#extension");
    expectFault(shaderTextFaults("# version 320 es\n"), "#version");
    expectFault(shaderTextFaults("#include \"a.glsl\"\n"), "#include");
}

TEST(ShaderBudgetChecker, FindsImagesWithoutAnAccessQualifier) {
    const std::string format = "layout(binding = 0, rgba16f) ";
    EXPECT_TRUE(shaderTextFaults(format + "readonly uniform image2D a;").empty());
    EXPECT_TRUE(shaderTextFaults(format + "uniform writeonly image2D a;").empty());
    expectFault(shaderTextFaults(format + "uniform image2D a;"), "image a is rgba16f, which");
    expectFault(shaderTextFaults("layout(r32ui) uniform uimage2D a;"),
                "image a is neither readonly nor writeonly");
}

TEST(ShaderBudgetChecker, FindsMacrosThatNoVariantLineDeclares) {
    const std::string text = "#ifdef TWO_WAY\n#endif\n";
    EXPECT_TRUE(shaderTextFaults("// Variant: #define TWO_WAY 1\n" + text).empty());
    expectFault(shaderTextFaults(text), "macro TWO_WAY");
    expectFault(shaderTextFaults("#if defined(FAST)\n#endif\n"), "macro FAST");
    const std::vector<std::string> variants = shaderVariants("// Variant: #define A 1\n" + text);
    EXPECT_EQ(variants, (std::vector<std::string>{"", "#define A 1\n"}));
}

TEST_F(ShaderBudgetGl, CheckerFindsShadersThatDoNotCompile) {
    expectFault(shaderProgramFaults("t.comp", compute("", "int x = 1.0;"), ""), "does not compile");
    const std::string needs = compute("", "int x = WIDTH;");
    expectFault(shaderProgramFaults("t.comp", needs, ""), "does not compile");
    EXPECT_TRUE(shaderProgramFaults("t.comp", needs, "#define WIDTH 3\n").empty());
}

TEST_F(ShaderBudgetGl, CheckerCountsStorageBlocks) {
    std::string blocks, uses;
    for (const char* n : {"0", "1", "2", "3"}) {
        blocks += std::string("layout(std430, binding = ") + n + ") buffer B" + n + "{ uint b" + n +
                  "[]; };\n";
        uses += std::string("b") + n + "[gl_LocalInvocationIndex] = 1u;";
    }
    EXPECT_TRUE(shaderProgramFaults("t.comp", compute(blocks, uses), "").empty());
    blocks += "layout(std430, binding = 4) buffer B4 { uint b4[]; };\n";
    const auto faults = shaderProgramFaults("t.comp", compute(blocks, uses + "b4[0] = 1u;"), "");
    expectFault(faults, "5 storage blocks");
    expectFault(faults, "storage block B4 at binding 4");
    expectFault(shaderProgramFaults("t.vert",
                                    "layout(std430, binding = 0) readonly buffer B { vec4 b[]; };\n"
                                    "void main() { gl_Position = b[gl_VertexID]; }",
                                    ""),
                "a vertex shader must not use storage blocks");
}

TEST_F(ShaderBudgetGl, CheckerCountsImages) {
    std::string images, uses;
    for (const char* n : {"0", "1", "2", "3"}) {
        images += std::string("layout(rgba8, binding = ") + n + ") writeonly uniform image2D i" +
                  n + ";\n";
        uses += std::string("imageStore(i") + n + ", ivec2(0), vec4(1.0));";
    }
    EXPECT_TRUE(shaderProgramFaults("t.comp", compute(images, uses), "").empty());
    images += "layout(rgba8, binding = 4) writeonly uniform image2D i4;\n";
    uses += "imageStore(i4, ivec2(0), vec4(1.0));";
    const auto faults = shaderProgramFaults("t.comp", compute(images, uses), "");
    expectFault(faults, "5 images");
    expectFault(faults, "image i4 at binding 4");
}

TEST_F(ShaderBudgetGl, CheckerMeasuresWorkGroupsAndSharedMemory) {
    const std::string block = "layout(std430, binding = 0) buffer B { float b[]; };\n";
    const std::string use = "s[gl_LocalInvocationIndex] = 1.0; barrier(); b[0] = s[3];";
    const std::string fits = block + "const int N = 64;\nshared float s[N * 64];\n";
    const std::string large = block + "const int N = 64;\nshared float s[N * 64 + 4];\n";
    EXPECT_TRUE(shaderProgramFaults("t.comp", compute(fits, use), "").empty());
    expectFault(shaderProgramFaults("t.comp", compute(large, use), ""),
                "16400 bytes of shared memory");
    const std::string group = "local_size_x = 16, local_size_y = 9";
    expectFault(shaderProgramFaults("t.comp", compute(block, "b[0] = 1.0;", group), ""),
                "144 invocations");
}

}  // namespace
}  // namespace mfar
