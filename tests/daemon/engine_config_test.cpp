#include "daemon/config.h"
#include "daemon/engine_memory.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

namespace mfar {
namespace {

EngineChoice matchingOnSimd() {
    EngineChoice choice = EngineChoice::all(EngineKind::Gles);
    choice.pyramid = choice.flow = choice.weigh = EngineKind::Simd;
    return choice;
}

TEST(EngineConfig, WithoutConfiguredEnginesTheGivenEnginesAreKept) {
    EXPECT_EQ(withWishes({}, matchingOnSimd()), matchingOnSimd());
    EXPECT_FALSE(EngineConfig{}.needsGles());
    EXPECT_FALSE(EngineConfig{}.isSimdAlone());
}

TEST(EngineConfig, TheEngineOfAStepOverridesTheEngineOfAllSteps) {
    const Config config = parseConfig("[engine]\nuse = \"simd\"\ndetail = \"gles\"\n", "test");
    EngineChoice wanted = EngineChoice::all(EngineKind::Simd);
    wanted.detail = EngineKind::Gles;
    EXPECT_EQ(withWishes(config.engine, EngineChoice::all(EngineKind::Gles)), wanted);
    EXPECT_TRUE(config.engine.needsGles());
    EXPECT_FALSE(config.engine.isSimdAlone());
}

TEST(EngineConfig, AnUnknownEngineIsRefusedWithLineAndColumn) {
    try {
        (void)parseConfig("[engine]\nflow = \"cuda\"\n", "test");
        FAIL() << "the unknown engine was accepted";
    } catch (const ConfigError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("test:2:8"));
        EXPECT_THAT(error.what(), testing::HasSubstr("\"auto\", \"gles\", \"simd\""));
    }
}

TEST(EngineConfig, EnginesWrittenAsTextAreReadBackUnchanged) {
    EXPECT_EQ(describe(EngineChoice::all(EngineKind::Simd)), "simd");
    EXPECT_EQ(parseEngineChoice(describe(matchingOnSimd())), matchingOnSimd());
    EXPECT_EQ(parseEngineChoice("gles"), EngineChoice::all(EngineKind::Gles));
    EXPECT_EQ(parseEngineChoice("still gles"), std::nullopt);
}

TEST(EngineMemory, RemembersTheEnginesOfEachDriverAndIgnoresADamagedFile) {
    const test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "engines.json";
    EXPECT_EQ(rememberedEngines(file, "a driver"), std::nullopt);
    ASSERT_TRUE(rememberEngines(file, "a driver", matchingOnSimd()));
    ASSERT_TRUE(rememberEngines(file, "another", EngineChoice::all(EngineKind::Gles)));
    EXPECT_EQ(rememberedEngines(file, "a driver"), matchingOnSimd());
    EXPECT_EQ(rememberedEngines(file, "another"), EngineChoice::all(EngineKind::Gles));
    std::ofstream(file) << "{\"a driver\": 7, \"another\"";
    EXPECT_EQ(rememberedEngines(file, "a driver"), std::nullopt);
    EXPECT_FALSE(rememberEngines("", "a driver", matchingOnSimd()));
}

}  // namespace
}  // namespace mfar
