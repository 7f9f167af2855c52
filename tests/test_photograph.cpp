#include "scene/error.h"
#include "scene/photograph.h"

#include <gtest/gtest.h>
#include <string>

namespace clucida::scene {
namespace {

Photograph photograph(const std::string& name)
{
    Photograph p;
    p.path = name;
    p.file = std::string(CLUCIDA_TEST_DATA) + "/scenes/" + name;
    p.at = {3, 7};
    return p;
}

void expect_refused(const std::string& name, const std::string& part)
{
    try {
        load_photograph(photograph(name));
        ADD_FAILURE() << name << " was read";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        EXPECT_EQ(error.at.line, 3U);
        EXPECT_EQ(error.at.column, 7U);
    }
}

TEST(LoadPhotograph, TexelsComeRowByRowFromTheTopWithRedLowest)
{
    const Texels texels = load_photograph(photograph("quad.ppm"));
    EXPECT_EQ(texels.width, 2U);
    EXPECT_EQ(texels.height, 2U);
    EXPECT_EQ(texels.rgb, (std::vector<std::uint32_t>{0x0000FF, 0x00FF00, 0xFF0000, 0x1E140A}));
}

TEST(LoadPhotograph, GreyBecomesThreeEqualChannels)
{
    EXPECT_EQ(load_photograph(photograph("grey.pgm")).rgb, (std::vector<std::uint32_t>{0, 0x808080, 0xFFFFFF}));
}

TEST(LoadPhotograph, SixteenBitsOfPgmAndPpmBecomeEight)
{
    EXPECT_EQ(load_photograph(photograph("grey16.pgm")).rgb, (std::vector<std::uint32_t>{0, 0x808080, 0xFFFFFF}));
    EXPECT_EQ(load_photograph(photograph("color16.ppm")).rgb, (std::vector<std::uint32_t>{0x0180FF}));
}

TEST(LoadPhotograph, TheLargestValueOfAPgmIsWhite)
{
    EXPECT_EQ(load_photograph(photograph("grey15.pgm")).rgb, (std::vector<std::uint32_t>{0, 0x555555, 0xFFFFFF}));
}

TEST(LoadPhotograph, PngIsReadAsWell)
{
    const Texels texels = load_photograph(photograph("five.png"));
    EXPECT_EQ(texels.width, 5U);
    EXPECT_EQ(texels.rgb, std::vector<std::uint32_t>(5, 0x030201));
}

TEST(LoadPhotograph, WhatIsMissingBrokenOrTooLargeIsAnErrorAtItsPlace)
{
    expect_refused("none.ppm", "cannot be opened");
    expect_refused("no-picture.ppm", "no photograph that can be read");
    expect_refused("wide.png", "expected 16384 at most");
}

TEST(LoadPhotograph, APictureThatIsCutOffIsAnErrorAtItsPlace)
{
    expect_refused("broken.png", "no photograph that can be read");
    expect_refused("short.ppm", "the PPM is cut short");
}

// The next three are what stb_image 2.27 stumbles over: it writes past its table, takes a GiB of memory, waits for
// ever.
TEST(LoadPhotograph, AJpegWithMoreHuffmanCodesThanThereAreBytesIsAnErrorAtItsPlace)
{
    expect_refused("huffman.jpg", "a table of the JPEG is too long");
}

TEST(LoadPhotograph, APngWithAChunkThatClaimsMoreThanTheFileIsAnErrorAtItsPlace)
{
    expect_refused("chunk.png", "the PNG is cut short");
}

TEST(LoadPhotograph, ARadiancePictureThatEndsWithinARunIsAnErrorAtItsPlace)
{
    expect_refused("cut.hdr", "the Radiance picture is cut short");
}

TEST(LoadPhotograph, ARadiancePictureWithARowTooFewIsAnErrorAtItsPlace)
{
    expect_refused("short.hdr", "the Radiance picture is cut short");
}

TEST(LoadPhotograph, AWholeRadiancePictureInRunsIsRead)
{
    const Texels texels = load_photograph(photograph("runs.hdr"));
    EXPECT_EQ(texels.width, 8U);
    EXPECT_EQ(texels.height, 2U);
    EXPECT_EQ(texels.rgb.size(), 16U);
}

} // namespace
} // namespace clucida::scene
