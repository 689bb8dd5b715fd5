#include "hal/device/gl_libraries.h"
#include "tests/device/error_of.h"
#include "tests/device/fake_gl.h"

#include <EGL/egl.h>
#include <GLES3/gl31.h>

#include <dlfcn.h>
#include <gmock/gmock.h>

namespace mfar {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kAdvice = "; install libegl1 and libgles2, or use the SIMD engine";

FakeGl& fake() {
    void* library = dlopen(MFAR_FAKE_GL, RTLD_NOW);
    return *reinterpret_cast<FakeGl* (*)()>(dlsym(library, "fakeGl"))();
}

std::string loading(const std::string& egl, const std::string& gles) {
    return test::errorOf([&] { loadGlLibraries({egl, gles}); });
}

TEST(GlLibraries, FunctionsDoNothingBeforeTheyAreLoaded) {
    EXPECT_EQ(eglGetCurrentDisplay(), EGL_NO_DISPLAY);
    EXPECT_EQ(eglGetProcAddress("glClear"), nullptr);
    EXPECT_EQ(glGetString(GL_RENDERER), nullptr);
    GLint unchanged = 17;
    glGetIntegerv(GL_VIEWPORT, &unchanged);
    EXPECT_EQ(unchanged, 17);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(GlLibraries, AMissingLibraryIsNamedWithItsPackage) {
    EXPECT_EQ(loading("libno-such-egl.so.1", MFAR_FAKE_GL),
              std::string("libno-such-egl.so.1 cannot be loaded: cannot open shared object file: "
                          "No such file or directory") +
                  kAdvice);
    EXPECT_THAT(loading(MFAR_FAKE_GL, "libno-such-gles.so.2"),
                AllOf(StartsWith("libno-such-gles.so.2 cannot be loaded: "), EndsWith(kAdvice)));
    EXPECT_EQ(glCreateShader(GL_VERTEX_SHADER), 0U)
        << "functions must do nothing if only one library was loaded";
}

TEST(GlLibraries, AnUnrelatedLibraryIsRefused) {
    EXPECT_EQ(loading("libm.so.6", MFAR_FAKE_GL),
              std::string("libm.so.6 has no eglGetProcAddress") + kAdvice);
}

TEST(GlLibraries, AnOldLibraryIsRefused) {
    fake().unknown = "glDispatchCompute";
    EXPECT_THAT(loading(MFAR_FAKE_GL, MFAR_FAKE_GL),
                AllOf(HasSubstr(" has no glDispatchCompute: "), HasSubstr("OpenGL ES 3.1"),
                      EndsWith(kAdvice)));
    fake().unknown.clear();
    EXPECT_EQ(loading(MFAR_FAKE_GL, MFAR_FAKE_GL), "no error");
}

TEST(GlLibraries, ArgumentsAndResultsAreForwarded) {
    loadGlLibraries({MFAR_FAKE_GL, MFAR_FAKE_GL});
    glClearDepthf(0.25F);
    EXPECT_EQ(fake().depth, 0.25F);
    EXPECT_EQ(glCreateShader(41), 42U);
    const char pixels = 0;
    glTexSubImage3D(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, &pixels);
    EXPECT_THAT(fake().integers, testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
    EXPECT_EQ(fake().pixels, &pixels);
}

TEST(GlLibraries, EglProvidesFunctionsThatTheLibraryDoesNotExport) {
    loadGlLibraries({MFAR_FAKE_GL, MFAR_FAKE_GL});
    const int before = fake().others;
    glFlush();
    glDispatchCompute(1, 1, 1);
    EXPECT_EQ(fake().others, before + 2);
}

}  // namespace
}  // namespace mfar
