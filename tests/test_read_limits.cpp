/// Texts that are too large, too deep or cut off: an error in short time, never a crash.
#include "test_read_support.h"

#include <chrono>
#include <filesystem>
#include <fmt/format.h>

namespace clucida::scene::test {
namespace {

const std::string head = "clucida 1\nobserver { eye [0,-6,2]; look [0,0,0] }\n";
const std::string unit = "sphere([0,0,0],1)";

std::string repeated(const std::string& text, std::size_t count)
{
    std::string all;
    all.reserve(text.size() * count);
    for (std::size_t i = 0; i < count; ++i) all += text;
    return all;
}

void expect_message(const std::string& text, const std::string& part, Format format = Format::clucida)
{
    const auto start = std::chrono::steady_clock::now();
    const std::optional<Error> error = error_of(text, format);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    ASSERT_TRUE(error.has_value()) << "it reads";
    EXPECT_NE(std::string(error->what()).find(part), std::string::npos) << error->what();
    EXPECT_GT(error->at.line, 0U);
    EXPECT_LT(time.count(), 20) << "seconds";
}

std::string nested(const std::string& open, std::size_t depth)
{
    return fmt::format("{}solid a = {}{}", head, repeated(open, depth), unit);
}

/// Solids that double in size with every definition.
std::string doubling(std::size_t definitions)
{
    std::string text = head + "solid s0 = " + unit + "\n";
    for (std::size_t i = 1; i <= definitions; ++i) {
        text += fmt::format("solid s{0} = s{1} | s{1}\n", i, i - 1);
    }
    return text;
}

TEST(ReadLimits, ASolidMayHave65536PrimitivesAndNoMore)
{
    EXPECT_NO_THROW(read(doubling(16)));
    expect_message(doubling(17), "more than 65536 primitives");
    expect_message(doubling(1000), "more than 65536 primitives");
    EXPECT_NO_THROW(read(head + "solid a = " + unit + repeated(" & " + unit, 65535)));
    expect_message(head + "solid a = " + unit + repeated(" & " + unit, 65536), "more than 65536 primitives");
    expect_message(head + "solid a = " + unit + repeated(" | " + unit, 65536), "more than 65536 primitives");
}

TEST(ReadLimits, NestingEndsAt256WhateverItIsMadeOf)
{
    EXPECT_NO_THROW(read(head + "solid a = " + repeated("!", 255) + unit));
    for (const char* open : {"!", "(", "scale(2, ", "move([0,0,0], ", "(sphere([0,0,0],1)|"}) {
        expect_message(nested(open, 257), "nested more than 256 deep");
        expect_message(nested(open, 1'000'000), "nested more than 256 deep");
    }
    expect_message(head + "solid a = " + unit + repeated(" - " + unit, 1000), "nested more than 256 deep");
}

TEST(ReadLimits, NestingCountsThroughNames)
{
    std::string text = head + "solid s0 = " + unit + "\n";
    for (std::size_t i = 1; i <= 300; ++i) {
        text += "solid s" + std::to_string(i) + " = !s" + std::to_string(i - 1) + "\n";
    }
    expect_message(text, "nested more than 256 deep");
}

TEST(ReadLimits, EqualDeepSharedSolidsAreComparedInShortTime)
{
    const std::string text = doubling(16) + "object { solid s16; optics { } }\n";
    EXPECT_EQ(read(text), read(text));
    // By hand, past what a reader lets through: 2^200 primitives.
    SolidPtr a = make_solid(Sphere{{0, 0, 0}, 1});
    SolidPtr b = make_solid(Sphere{{0, 0, 0}, 1});
    for (int i = 0; i < 200; ++i) {
        a = make_solid(Union{{a, a}});
        b = make_solid(Union{{b, b}});
    }
    EXPECT_TRUE(*a == *b);
    EXPECT_FALSE(*a == *make_solid(Union{{a, b, a}}));
}

TEST(ReadLimits, CountsThatNoTextCanHoldAreRefusedAtOnce)
{
    expect_message("0 -4 1 0 0 0 1 0 0 0 0 -1\n1000000000 0 0\n", "within 1 and 4000000", Format::gun);
    // Below the limit the text's end is what stops it.
    expect_message("0 -4 1 0 0 0 1 0 0 0 0 -1\n4000000 0 0\n", "the end of the text", Format::gun);
    expect_message("0 -4 1 0 0 0 1 0 0\n4000000\n", "the end of the text", Format::rayt);
    expect_message("0 -4 1 0 0 0 1 0 0\n1 x 65536 sphere 0 0 0 1", "the end of the text", Format::rayt);
    expect_message("0 -4 1 0 0 0 1 0 0 0 rgb 65536", "the end of the text", Format::rayt);
}

TEST(ReadLimits, LightsAndTexturesAreBounded)
{
    const std::string light = "light { point [0,0,0] }\n";
    EXPECT_EQ(read(head + repeated(light, 65536)).lights.size(), 65536U);
    expect_message(head + repeated(light, 65537), "too many lights; expected 65536 at most");
    std::string textures = head;
    for (int i = 0; i < 1025; ++i) {
        textures +=
            "texture t" + std::to_string(i) + " { photograph \"quad.ppm\"; mapping directional { n [0,0,1] } }\n";
    }
    expect_message(textures, "too many textures; expected 1024 at most");
}

TEST(ReadLimits, LongWordsExpressionsAndPathsAreErrors)
{
    const std::string name(65, 'a');
    EXPECT_NO_THROW(read(head + "let " + name.substr(1) + " = 1"));
    expect_message(head + "let " + name + " = 1", "expected 64 at most");
    expect_message(head + "let a = 1" + repeated("+1", 2048), "more than 4096 characters");
    expect_message(head + "let a = " + repeated("(", 1'000'000), "more than 4096 characters");
    expect_message(head + "let a = " + repeated("(", 4000), "never closed");
    expect_message(head + "let a = " + repeated("-", 4000), "expected");
    expect_message(head + "sky photograph \"" + repeated("a/", 4000) + "\"", "too long");
}

TEST(ReadLimits, TextsOfMoreThan256MiBAreRefused)
{
    const std::string text((std::size_t{256} << 20) + 1, ' ');
    EXPECT_THROW(read(text), Error);
}

TEST(ReadLimits, ANulByteAnywhereIsAnError)
{
    for (const Format format : {Format::clucida, Format::gun, Format::rayt}) {
        const std::optional<Error> error = error_of(std::string("1 2\n3 \0 4", 9), format);
        ASSERT_TRUE(error.has_value());
        EXPECT_NE(std::string(error->what()).find("scene:2:3: error: a NUL byte"), std::string::npos) << error->what();
    }
}

class Truncated : public testing::TestWithParam<const char*> {};

TEST_P(Truncated, EveryPrefixReadsOrHasAnErrorWithAPlace)
{
    const Format format = format_of(GetParam());
    const std::string text = data_text(GetParam());
    std::size_t reads = 0;
    for (std::size_t size = 0; size < text.size(); ++size) {
        const std::optional<Error> error = error_of(text.substr(0, size), format);
        if (!error.has_value()) {
            ++reads;
            continue;
        }
        EXPECT_GT(error->at.line, 0U) << error->what();
        EXPECT_GT(error->at.column, 0U) << error->what();
        EXPECT_TRUE(std::string(error->what()).starts_with("scene:")) << error->what();
    }
    EXPECT_LT(reads, format == Format::clucida ? text.size() / 2 : 8);
}

TEST_P(Truncated, EveryLostOrChangedByteReadsOrHasAnErrorWithAPlace)
{
    const Format format = format_of(GetParam());
    const std::string text = data_text(GetParam());
    for (std::size_t i = 0; i < text.size(); ++i) {
        for (const char c : {'\0', '(', '{', '"', '-', '9', 'x', '\n', '\xFF'}) {
            std::string changed = text;
            if (c == '\0') {
                changed.erase(i, 1);
            } else {
                changed[i] = c;
            }
            const std::optional<Error> error = error_of(changed, format);
            EXPECT_TRUE(!error.has_value() || error->at.line > 0) << error->what();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(OfEachLanguage, Truncated, testing::Values("full.clucida", "full.gun", "full.rayt"),
                         [](const auto& info) { return std::string(info.param).substr(5); });

TEST(ReadFiles, AFileThatIsMissingOrAFolderIsAnErrorThatNamesIt)
{
    for (const std::string& file : {data_folder().string(), (data_folder() / "none.gun").string()}) {
        try {
            read_scene_file(file);
            ADD_FAILURE() << file;
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(file + ": error: ")) << error.what();
        }
    }
}

class ReadPhotographs : public testing::Test {
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(folder / "scene" / "inner");
        std::filesystem::create_directories(folder / "other");
        for (const char* name : {"scene/inner/a.ppm", "other/b.ppm"}) {
            std::filesystem::copy_file(data_folder() / "quad.ppm", folder / name,
                                       std::filesystem::copy_options::overwrite_existing);
        }
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string find(const std::string& path, const ReadOptions& options = {}) const
    {
        const Scene scene =
            read_scene(head + "sky photograph \"" + path + "\"", "scene", Format::clucida, folder / "scene", options);
        return std::get<SkyPhotograph>(scene.sky).photograph.file;
    }
    void expect_refused(const std::string& path, const ReadOptions& options = {}) const
    {
        try {
            find(path, options);
            ADD_FAILURE() << path << " was found";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("leads out of the scene's folder"), std::string::npos)
                << error.what();
            EXPECT_EQ(error.at.line, 3U);
        }
    }

    const std::filesystem::path folder =
        std::filesystem::canonical(std::filesystem::temp_directory_path()) /
        ("clucida_test_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(ReadPhotographs, LieBeneathTheScenesFolder)
{
    EXPECT_EQ(find("inner/a.ppm"), folder / "scene" / "inner" / "a.ppm");
    EXPECT_EQ(find("./inner/../inner/a.ppm"), folder / "scene" / "inner" / "a.ppm");
}

TEST_F(ReadPhotographs, DoNotLeaveItByNameWhetherTheyExistOrNot)
{
    expect_refused("../other/b.ppm");
    expect_refused("../other/none.ppm");
    expect_refused("inner/../../other/b.ppm");
    expect_refused((folder / "other" / "b.ppm").string());
    expect_refused("../scene2/b.ppm");
}

TEST_F(ReadPhotographs, DoNotLeaveItBySymbolicLinks)
{
    std::filesystem::create_symlink(folder / "other" / "b.ppm", folder / "scene" / "link.ppm");
    std::filesystem::create_directory_symlink(folder / "other", folder / "scene" / "links");
    std::filesystem::create_symlink("inner/a.ppm", folder / "scene" / "good.ppm");
    expect_refused("link.ppm");
    expect_refused("links/b.ppm");
    EXPECT_EQ(find("good.ppm"), folder / "scene" / "inner" / "a.ppm");
}

TEST_F(ReadPhotographs, MayLieBeneathTheFolderAllowedBesides)
{
    const ReadOptions allowed{std::nullopt, folder / "other"};
    EXPECT_EQ(find("../other/b.ppm", allowed), folder / "other" / "b.ppm");
    EXPECT_EQ(find("b.ppm", allowed), folder / "other" / "b.ppm");
    EXPECT_EQ(find((folder / "other" / "b.ppm").string(), allowed), folder / "other" / "b.ppm");
    EXPECT_EQ(find("inner/a.ppm", allowed), folder / "scene" / "inner" / "a.ppm");
    expect_refused("../../x.ppm", allowed);
}

} // namespace
} // namespace clucida::scene::test
