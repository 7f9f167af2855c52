// Frames, shards, names, films and pairs of eyes: what needs no device.
#include "host/errors.h"
#include "host/film.h"
#include "host/fingerprint.h"
#include "host/frames.h"
#include "host/picture_file.h"
#include "host/stereo.h"
#include "host/work_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace clucida::host {
namespace {

using Frames = std::vector<unsigned>;

TEST(Frames, AListNamesThem)
{
    EXPECT_EQ(parse_frames("7"), (Frames{7}));
    EXPECT_EQ(parse_frames("1-4"), (Frames{1, 2, 3, 4}));
    EXPECT_EQ(parse_frames("1..4"), (Frames{1, 2, 3, 4}));
    EXPECT_EQ(parse_frames("4-1"), (Frames{4, 3, 2, 1}));
    EXPECT_EQ(parse_frames("10-1x4"), (Frames{10, 6, 2}));
    EXPECT_EQ(parse_frames("1-3,20-40x10,7"), (Frames{1, 2, 3, 20, 30, 40, 7}));
    EXPECT_EQ(parse_frames("1-1000000").size(), 1000000U);
}

TEST(Frames, WhatIsNamedTwiceIsRenderedOnce)
{
    unsigned repeated = 0;
    EXPECT_EQ(parse_frames("1-4,3-6,4", &repeated), (Frames{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(repeated, 3U);
}

TEST(Frames, SenselessListsSayWhatIsWrong)
{
    for (const char* list : {"", ",", "1,", "1,,2", "a", "1-", "-1", "1-b", "0", "1-0", "1-10x0", "1-10x", "1-10xa",
                             "1000001", "1-99999999999", "1 2", "1-2-3", "1.5", "0x10"}) {
        try {
            parse_frames(list);
            ADD_FAILURE() << "'" << list << "' was taken";
        } catch (const UsageError& e) {
            EXPECT_NE(std::string(e.what()).find("--frames"), std::string::npos) << e.what();
            EXPECT_NE(std::string(e.what()).find("1-10,20-100x5,7"), std::string::npos) << e.what();
        }
    }
}

TEST(Frames, ShardsShareThemAllAndNoneTwice)
{
    const Frames all = parse_frames("1-20x3,100-110");
    for (unsigned count : {1U, 2U, 3U, 7U, 50U}) {
        Frames together;
        for (unsigned i = 1; i <= count; ++i)
            for (const unsigned frame : shard_of(all, {i, count})) together.push_back(frame);
        std::ranges::sort(together);
        EXPECT_EQ(together, all) << count;
    }
    EXPECT_EQ(parse_shard("2/3").index, 2U);
    EXPECT_EQ(parse_shard("2/3").count, 3U);
    for (const char* text : {"", "1", "0/3", "4/3", "1/0", "a/b", "1/", "/2", "-1/2", "1/2/3"})
        EXPECT_THROW(parse_shard(text), UsageError) << text;
}

TEST(Frames, NamesHaveAPlaceForTheNumber)
{
    EXPECT_EQ(FramePattern("a_%04d.png").file(7), "a_0007.png");
    EXPECT_EQ(FramePattern("a_####.png").file(7), "a_0007.png");
    EXPECT_EQ(FramePattern("a_##.png").file(12345), "a_12345.png");
    EXPECT_EQ(FramePattern("%d/a.png").file(12), "12/a.png");
    EXPECT_EQ(FramePattern("50%%_%03d.png").file(1), "50%_001.png");
    EXPECT_FALSE(FramePattern("a.png").has_number());
    EXPECT_EQ(FramePattern("a.png").file(3), "a.png");
    for (const char* pattern : {"%", "%4d.png", "%s.png", "%04x", "%d%d.png", "##_##.png", "%d_#.png", "%099999d"})
        EXPECT_THROW(FramePattern{pattern}, UsageError) << pattern;
}

TEST(Films, RatesAreWholeNumbers)
{
    const auto text = [](double fps) {
        const Rate r = rate_of(fps);
        return std::to_string(r.frames) + "/" + std::to_string(r.seconds);
    };
    EXPECT_EQ(text(24), "24/1");
    EXPECT_EQ(text(12.5), "25/2");
    EXPECT_EQ(text(23.976), "24000/1001");
    EXPECT_EQ(text(29.97), "30000/1001");
    EXPECT_EQ(text(0.25), "1/4");
}

TEST(Films, Y4mHoldsWhatWasAdded)
{
    const std::string file = (std::filesystem::path(testing::TempDir()) / "film.y4m").string();
    {
        Film film(file, FilmFormat::y4m, {2, 1}, 24);
        const std::vector<std::uint8_t> one{255, 255, 255, 0, 0, 0}, other{255, 0, 0, 0, 0, 255};
        film.add(one);
        film.add(other);
        EXPECT_FALSE(std::filesystem::exists(file)) << "before it was whole";
        film.finish();
    }
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    const std::string bytes = text.str(), header = bytes.substr(0, bytes.find('\n') + 1);
    EXPECT_EQ(header, "YUV4MPEG2 W2 H1 F24:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n");
    // White, black; then red and blue: Rec. ITU-R BT.709-6, 3.2 to 3.4.
    const std::string frames = "FRAME\n\xEB\x10\x80\x80\x80\x80"
                               "FRAME\n\x3F\x20\x66\xF0\xF0\x76";
    EXPECT_EQ(bytes.substr(header.size()), frames);
    std::filesystem::remove(file);
}

TEST(Films, WhatIsNotFinishedLeavesNoFile)
{
    const auto folder = std::filesystem::path(testing::TempDir()) / "films";
    std::filesystem::create_directory(folder);
    for (const FilmFormat format : {FilmFormat::rgb, FilmFormat::mp4}) {
        Film film((folder / "film").string(), format, {16, 16}, 24);
        film.add(std::vector<std::uint8_t>(16 * 16 * 3));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder));
    std::filesystem::remove_all(folder);
}

TEST(Films, OddSizesAreRefusedWhereTheFormatHalvesThem)
{
    EXPECT_THROW(require_filmable({15, 16}, FilmFormat::mp4), UsageError);
    EXPECT_THROW(require_filmable({16, 15}, FilmFormat::webm), UsageError);
    EXPECT_NO_THROW(require_filmable({15, 15}, FilmFormat::gif));
    EXPECT_NO_THROW(require_filmable({15, 15}, FilmFormat::y4m));
}

Picture filled(unsigned width, unsigned height, float value)
{
    Picture p = make_picture(width, height);
    for (std::size_t i = 0; i < p.rgb.size(); ++i) p.rgb[i] = value + static_cast<float>(i);
    return p;
}

TEST(Stereo, PicturesAreComposed)
{
    const Picture left = filled(2, 2, 0), right = filled(2, 2, 100);
    const Picture beside = compose(StereoLayout::side_by_side, {left, right});
    EXPECT_EQ(beside.width, 4U);
    EXPECT_EQ(beside.rgb, (std::vector<float>{0, 1, 2, 3, 4,  5,  100, 101, 102, 103, 104, 105,
                                              6, 7, 8, 9, 10, 11, 106, 107, 108, 109, 110, 111}));
    const Picture above = compose(StereoLayout::top_bottom, {left, right});
    EXPECT_EQ(above.height, 4U);
    EXPECT_TRUE(std::equal(left.rgb.begin(), left.rgb.end(), above.rgb.begin()));
    EXPECT_TRUE(std::equal(right.rgb.begin(), right.rgb.end(), above.rgb.begin() + 12));
    const Picture glasses = compose(StereoLayout::anaglyph, {left, right});
    EXPECT_EQ(glasses.rgb, (std::vector<float>{0, 101, 102, 3, 104, 105, 6, 107, 108, 9, 110, 111}));
}

TEST(Stereo, EyesOfAPairHaveFilesOfTheirOwn)
{
    EXPECT_EQ(eye_file("a.png", 0), "a_L.png");
    EXPECT_EQ(eye_file("b.c/a", 1), "b.c/a_R");
    EXPECT_EQ(eye_file("b/a.0001.png", 1), "b/a.0001_R.png");
}

TEST(Fingerprints, AreKeptByEveryFormatWithRoomForThem)
{
    const std::string digest(64, 'a');
    const Picture picture = filled(9, 5, 0);
    for (const FileFormat format : {FileFormat::png, FileFormat::ppm, FileFormat::jpeg, FileFormat::hdr}) {
        EncodeOptions options;
        options.metadata = {{"Software", "Fingerprints"}, {fingerprint_keyword, digest}};
        const std::string bytes = encode(picture, format, options);
        EXPECT_EQ(fingerprint_in(bytes), digest) << static_cast<int>(format);
        const Picture back = decode(bytes, "picture");
        EXPECT_EQ(back.width, 9U);
        EXPECT_EQ(fingerprint_in(encode(picture, format, {})), "");
    }
}

TEST(Fingerprints, OnlyWholeFilesAreTrusted)
{
    const std::string digest(64, 'b'), file = (std::filesystem::path(testing::TempDir()) / "kept").string();
    const auto put = [&](std::string_view bytes) { std::ofstream(file, std::ios::binary) << bytes; };
    for (const FileFormat format : {FileFormat::png, FileFormat::ppm, FileFormat::jpeg, FileFormat::hdr}) {
        EncodeOptions options;
        options.metadata = {{fingerprint_keyword, digest}};
        const std::string bytes = encode(filled(40, 30, 0), format, options);
        put(bytes);
        EXPECT_TRUE(is_same_picture(file, digest)) << static_cast<int>(format);
        EXPECT_FALSE(is_same_picture(file, std::string(64, 'c')));
        for (const std::size_t lost : {std::size_t{1}, std::size_t{5}, bytes.size() / 2}) {
            put(std::string_view(bytes).substr(0, bytes.size() - lost));
            EXPECT_FALSE(is_same_picture(file, digest)) << static_cast<int>(format) << " without " << lost;
        }
    }
    put("");
    EXPECT_FALSE(is_same_picture(file, digest));
    std::filesystem::remove(file);
    EXPECT_FALSE(is_same_picture(file, digest));
}

TEST(WorkQueue, DoesJobsInOrder)
{
    for (const std::size_t most : {0U, 1U, 3U}) {
        std::vector<int> done;
        WorkQueue queue(most);
        for (int i = 0; i < 100; ++i) queue.push([&done, i] { done.push_back(i); });
        queue.finish();
        ASSERT_EQ(done.size(), 100U);
        EXPECT_TRUE(std::ranges::is_sorted(done));
    }
}

TEST(WorkQueue, AFailureEndsIt)
{
    std::atomic<int> done{0};
    WorkQueue queue(2);
    const auto push_all = [&] {
        queue.push([] { throw Failure("the disk is full"); });
        for (int i = 0; i < 100; ++i) queue.push([&] { ++done; });
        queue.finish();
    };
    EXPECT_THROW(push_all(), Failure);
    EXPECT_THROW(queue.finish(), Failure);
    EXPECT_EQ(done, 0);
}

} // namespace
} // namespace clucida::host
